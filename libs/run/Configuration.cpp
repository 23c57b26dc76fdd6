#include "run/Configuration.h"

#include <sstream>

namespace hybrid_slam::run {

void RunOptions::describe(OptionTable& t) {
  t.add("method", method,
        {{Method::hybrid, "hybrid"}, {Method::general, "general"}, {Method::stock, "stock"}},
        "hybrid: the paper's; general: the same filter without lines; stock: MRPT's CMetricMapBuilderRBPF");
  t.add("rawlog", rawlog, "log to replay, where the command line names none");
  t.add("output", output, "folder for the results, where the command line names none");
  t.add("particles_every", particlesEvery, 0, 1000000,
        "particles.csv takes all particles of each update whose number this divides; 0: no particles.csv");
  t.add("refine", refine, 0, 100,
        "after the run: so many times matches each scan against the final map and builds the map anew");
}

Configuration::Configuration(const std::string& file, const std::vector<std::string>& settings,
                             const files::Sections& more)
    : more_(more) {
  files::loadIni(
      source, file, settings, sections(), kStockSection,
      "expected at least one of the sections in doc/configuration.md, such as [run] or [particle_filter]");
  filter.useLines = run.method == RunOptions::Method::hybrid;
}

files::Sections Configuration::sections() {
  files::Sections all{{"run", &run}, {"input", &input}};
  for (const auto& section : filter.sections()) all.push_back(section);
  all.insert(all.end(), more_.begin(), more_.end());
  return all;
}

std::string Configuration::text() {
  mrpt::config::CConfigFileMemory all(source.getContent());  // its copies would share one content
  for (const auto& [name, options] : sections()) options->saveToConfigFile(all, name);
  return all.getContent();
}

std::string configurationManual() {
  std::ostringstream out;
  out << "# Configuration\n\n"
         "Made from the code by `hybrid-slam --help-config`; a test keeps this page equal to it.\n"
         "Keys left out keep their default. An unknown key in one of these sections is an error; sections\n"
         "that are not listed here are left alone.\n";
  Configuration defaults;
  files::writeManual(defaults.sections(), out);
  return out.str();
}

}  // namespace hybrid_slam::run
