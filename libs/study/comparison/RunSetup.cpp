#include "study/comparison/RunSetup.h"

#include <filesystem>

#include "files/InstalledFiles.h"

namespace hybrid_slam::comparison {

RunSetup setupOf(const CommonSetup& common, const Group& group, int seed) {
  const std::string& own = group.variant.iniFile;
  RunSetup setup{own.empty() ? common.config : files::inputFile(own), common.settings};
  std::vector<std::string>& settings = setup.settings;
  settings.insert(settings.end(), group.variant.settings.begin(), group.variant.settings.end());
  const auto set = [&](const std::string& key, const std::string& value) {
    settings.push_back(key + "=" + value);
  };
  const std::string particles = std::to_string(group.particles);
  set("run.rawlog", std::filesystem::weakly_canonical(std::filesystem::absolute(common.log)).string());
  set("run.method", group.method);
  set("particle_filter.particles", particles);
  set("particle_filter.seed", std::to_string(seed));
  set("particle_filter.threads", "1");
  // A repeated run has another number of particles, and maybe the next run's seed.
  if (group.particles == 0) set("run.retry_particles", "0");
  // MRPT's filter reads its own section, if there is one, with its own key for the number of particles.
  if (group.method == "stock" && setup.configuration().source.sectionExists(run::kStockSection))
    if (group.particles > 0) set(std::string(run::kStockSection) + ".sampleSize", particles);
  return setup;
}

}  // namespace hybrid_slam::comparison
