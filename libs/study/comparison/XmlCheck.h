/// @file XmlCheck.h
/// @brief For tests: whether a text is well-formed XML, as far as the reports go.
#pragma once

#include <cctype>
#include <string>
#include <vector>

namespace hybrid_slam::comparison {

/// Empty if every tag is closed in order, every attribute is quoted and given once, and no bare `<` or `&`
/// stands in text or attributes; else what is wrong. Knows no comments, CDATA or processing instructions.
inline std::string xmlDefect(const std::string& xml) {
  std::vector<std::string> open;
  const auto isName = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == ':';
  };
  const auto textDefect = [&](const std::string& text) -> std::string {
    for (size_t i = 0; (i = text.find('&', i)) != std::string::npos; ++i) {
      size_t end = i + 1;
      while (end < text.size() && (isName(text[end]) || text[end] == '#')) ++end;
      if (end == i + 1 || end == text.size() || text[end] != ';')
        return "bare & in `" + text.substr(i, 20) + "`";
    }
    return {};
  };
  size_t at = xml.rfind("<!DOCTYPE html>", 0) == 0 ? 15 : 0;
  while (at < xml.size()) {
    const size_t tag = xml.find('<', at);
    const std::string text = xml.substr(at, tag - at);
    if (const std::string defect = textDefect(text); !defect.empty()) return defect;
    if (open.empty() && text.find_first_not_of(" \n") != std::string::npos) return "text outside of the root";
    if (tag == std::string::npos) break;
    size_t i = tag + 1;
    const bool isEnd = xml[i] == '/';
    i += isEnd;
    std::string name;
    while (i < xml.size() && isName(xml[i])) name += xml[i++];
    if (name.empty()) return "bare < before `" + xml.substr(tag, 20) + "`";
    std::vector<std::string> attributes;
    while (i < xml.size() && std::isspace(static_cast<unsigned char>(xml[i]))) {
      while (i < xml.size() && std::isspace(static_cast<unsigned char>(xml[i]))) ++i;
      std::string attribute;
      while (i < xml.size() && isName(xml[i])) attribute += xml[i++];
      if (attribute.empty()) break;
      for (const std::string& other : attributes)
        if (other == attribute) return "attribute " + attribute + " twice in <" + name + ">";
      attributes.push_back(attribute);
      if (xml.compare(i, 2, "=\"") != 0) return "attribute " + attribute + " of <" + name + "> is not quoted";
      const size_t end = xml.find('"', i + 2);
      if (end == std::string::npos) return "attribute " + attribute + " does not end";
      const std::string value = xml.substr(i + 2, end - i - 2);
      if (value.find('<') != std::string::npos) return "< in attribute " + attribute;
      if (const std::string defect = textDefect(value); !defect.empty()) return defect;
      i = end + 1;
    }
    const bool isEmpty = i < xml.size() && xml[i] == '/';
    i += isEmpty;
    if (i >= xml.size() || xml[i] != '>') return "<" + name + "> does not end";
    at = i + 1;
    if (isEnd) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
    } else if (!isEmpty) {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

}  // namespace hybrid_slam::comparison
