#include "io/Configuration.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/Errors.h"

namespace hybrid_slam {
namespace {

std::string readText(const std::string& file) {
  const std::string expected = "expected a readable INI file";
  if (!std::filesystem::exists(file)) throw InputError("no such file", file, expected);
  if (!std::filesystem::is_regular_file(file)) throw InputError("not a file", file, expected);
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  if (!in) throw InputError("cannot read", file, expected);
  if (text.str().find('\0') != std::string::npos) throw InputError("not a text file", file, expected);
  return text.str();
}

/// An InputError that names the file too.
[[noreturn]] void rethrowIn(const std::string& file, const InputError& error) {
  std::string text = error.what();
  const auto where = text.find(": section [");
  if (where != std::string::npos) text.insert(where + 2, file + ", ");
  const auto end = text.rfind("; ");
  const auto colon = text.find(": ");
  throw InputError(text.substr(0, colon), text.substr(colon + 2, end - colon - 2), text.substr(end + 2));
}

void applySetting(mrpt::config::CConfigFileMemory& source, const std::string& setting) {
  const auto equals = setting.find('='), dot = setting.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals)
    throw InputError("wrong setting `" + setting + "`", "--set", "expected SECTION.KEY=VALUE");
  source.write(setting.substr(0, dot), setting.substr(dot + 1, equals - dot - 1), setting.substr(equals + 1));
}

}  // namespace

void RunOptions::describe(OptionTable& t) {
  t.add("method", method,
        {{Method::hybrid, "hybrid"}, {Method::general, "general"}, {Method::stock, "stock"}},
        "hybrid: the paper's; general: the same filter without lines; stock: MRPT's CMetricMapBuilderRBPF");
  t.add("rawlog", rawlog, "log to replay, where the command line names none");
  t.add("output", output, "folder for the results, where the command line names none");
}

Configuration::Configuration(const std::string& file, const std::vector<std::string>& settings) {
  source.setContent(readText(file));
  for (const std::string& setting : settings) applySetting(source, setting);

  std::vector<std::string> present, ours;
  source.getAllSections(present);
  for (const auto& [name, options] : sections()) ours.push_back(name);
  const auto isOurs = [&ours](const std::string& s) {
    return std::find(ours.begin(), ours.end(), s) != ours.end();
  };
  if (std::none_of(present.begin(), present.end(), isOurs) && !source.sectionExists(kStockSection))
    throw InputError("missing section", file,
                     "expected at least one of the sections in doc/configuration.md, such as [run] or "
                     "[particle_filter]");
  for (const std::string& section : present) {
    const std::string nearest = nearestName(section, ours);
    if (!isOurs(section) && editDistance(section, nearest) <= 2)
      throw InputError("unknown section [" + section + "]", file,
                       "the nearest known section is [" + nearest + "]");
  }
  try {
    for (const auto& [name, options] : sections()) options->loadFromConfigFile(source, name);
  } catch (const InputError& error) {
    rethrowIn(file, error);
  }
  filter.useLines = run.method == RunOptions::Method::hybrid;
}

std::vector<std::pair<std::string, Options*>> Configuration::sections() {
  std::vector<std::pair<std::string, Options*>> all{{"run", &run}, {"input", &input}};
  for (const auto& section : filter.sections()) all.push_back(section);
  return all;
}

std::string Configuration::text() {
  std::ostringstream out;
  for (const auto& [name, options] : sections()) {
    out << "[" << name << "]\n";
    for (const Option& option : options->table()) out << option.key << " = " << option.get() << "\n";
    out << "\n";
  }
  return out.str();
}

std::string configurationManual() {
  std::ostringstream out;
  out << "# Configuration\n\n"
         "Made from the code by `hybrid-slam --help-config`; a test keeps this page equal to it.\n"
         "Keys left out keep their default. An unknown key in one of these sections is an error; sections\n"
         "that are not listed here are left alone.\n";
  Configuration defaults;
  for (const auto& [name, options] : defaults.sections()) {
    out << "\n## [" << name << "]\n\n| key | default | unit | range | what for |\n|---|---|---|---|---|\n";
    for (const Option& option : options->table()) {
      std::string range = option.range;
      for (size_t at = 0; (at = range.find('|', at)) != std::string::npos; at += 4)
        range.replace(at, 1, "&#124;"), at += 2;
      out << "| `" << option.key << "` | " << option.get() << " | " << option.unit << " | " << range << " | "
          << option.why << " |\n";
    }
  }
  return out.str();
}

}  // namespace hybrid_slam
