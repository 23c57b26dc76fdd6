#include "study/comparison/ReportText.h"

#include "base/Numbers.h"

namespace hybrid_slam::comparison {

std::string escapeXml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t')
      out += '?';  // XML allows no other control characters
    else
      out += c;
  }
  return out;
}

std::string shortNumber(double value, int digits) {
  return numberText(value == 0 ? 0.0 : value, std::chars_format::general, digits);
}

}  // namespace hybrid_slam::comparison
