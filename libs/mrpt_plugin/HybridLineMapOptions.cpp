#include "mrpt_plugin/HybridLineMapOptions.h"

#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>

#include "base/Errors.h"

namespace hybrid_slam::mrpt_maps {

void LikelihoodOptions::describe(OptionTable& table) {
  table.add("exponent", exponent, 0, 1e6, "",
            "exponent of the line weight; 1 / powFactor cancels the powFactor of MRPT's filter");
}

std::vector<std::pair<std::string, Options*>> HybridLineMapOptions::sections() {
  return {{"line_extraction", &extraction},   {"segmentation", &extraction.segmentation},
          {"line_fit", &extraction.fit},      {"hough", &extraction.hough},
          {"line_association", &association}, {"line_database", &database},
          {"line_weight", &weight},           {"likelihoodOpts", &likelihood}};
}

void HybridLineMapOptions::load(const mrpt::config::CConfigFileBase& source, const std::string& prefix) {
  std::vector<std::string> known = {"creationOpts"};  // MRPT's own, of any map
  for (const auto& [section, options] : sections()) {
    known.push_back(section);
    options->loadFromConfigFile(source, prefix + "_" + section);
  }
  std::vector<std::string> all;
  source.getAllSections(all);
  for (const std::string& section : all) {
    if (section.rfind(prefix + "_", 0) != 0) continue;
    const std::string end = section.substr(prefix.size() + 1);
    if (std::find(known.begin(), known.end(), end) == known.end())
      throw InputError("unknown section", "[" + section + "]",
                       "the nearest known section is [" + prefix + "_" + nearestName(end, known) + "]");
  }
}

}  // namespace hybrid_slam::mrpt_maps
