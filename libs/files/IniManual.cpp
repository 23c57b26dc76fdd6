/// @file IniManual.cpp
/// @brief The manual of INI files.
#include "base/Terminal.h"
#include "files/IniFile.h"

namespace hybrid_slam::files {
namespace {

/// Writes indented lines of at most 80 characters.
void writeWrapped(const std::string& text, std::ostream& out) {
  constexpr size_t kWidth = 80;
  const std::string indent(6, ' ');
  for (const std::string& line : wrapped(text, kWidth - indent.size())) out << indent << line << '\n';
}

}  // namespace

void writeManual(const Sections& sections, std::ostream& out) {
  for (const auto& [name, options] : sections) {
    out << "\n## [" << name << "]\n\n| key | default | unit | range | meaning |\n|---|---|---|---|---|\n";
    for (const Option& option : options->table()) {
      std::string range = option.range;
      for (size_t at = 0; (at = range.find('|', at)) != std::string::npos; at += 4)
        range.replace(at, 1, "&#124;"), at += 2;
      out << "| `" << option.key << "` | " << option.get() << " | " << option.unit << " | " << range << " | "
          << option.why << " |\n";
    }
  }
}

void writePlainManual(const Sections& sections, std::ostream& out) {
  for (const auto& [name, options] : sections) {
    out << "\n[" << name << "]\n";
    const auto all = options->table();
    size_t longest = 0;
    for (const Option& option : all) longest = std::max(longest, option.key.size());
    for (const Option& option : all) {
      const std::string unit = option.unit.empty() ? "" : " " + option.unit;
      out << "  " << option.key << std::string(longest - option.key.size(), ' ') << " = " << option.get()
          << unit << "  (" << option.range << unit << ")\n";
      writeWrapped(option.why, out);
    }
  }
}

}  // namespace hybrid_slam::files
