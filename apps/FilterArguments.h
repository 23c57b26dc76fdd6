/// @file FilterArguments.h
/// @brief Command-line options of the filter.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "SettingArguments.h"

namespace hybrid_slam {

/// Groups of options, which each program adds in the order of its --help. Their values become settings and
/// are checked as such.
struct FilterArguments {
  std::string method, proposal;
  int particles = 0, seed = -1, threads = -1;

  /// Adds -m and -p.
  void addMethod(CLI::App& app) {
    app.add_option("-m,--method", method,
                   "hybrid, general (without lines), linemap (lines alone), ortho (lines at right angles) or "
                   "stock (MRPT's own RBPF)");
    app.add_option("-p,--proposal", proposal,
                   "improved (default), standard (the paper's), auxiliary_standard or auxiliary_optimal");
  }
  /// Adds -n, -s and -j.
  void addParticles(CLI::App& app,
                    const std::string& seedMeans = "random seed; same seed: identical results") {
    app.add_option("-n,--particles", particles, "number of particles (default: adaptive)")->type_name("N");
    app.add_option("-s,--seed", seed, seedMeans)->type_name("N");
    app.add_option("-j,--threads", threads, "number of threads (default: 1); 0: all cores")->type_name("N");
  }
  /// Appends the given options to the settings.
  void addTo(std::vector<std::string>& settings, const CLI::App& app) const {
    if (!method.empty()) set(settings, "run.method", method);
    if (!proposal.empty()) set(settings, "particle_filter.proposal", proposal);
    if (app.count("--particles")) set(settings, "particle_filter.particles", std::to_string(particles));
    if (app.count("--seed")) set(settings, "particle_filter.seed", std::to_string(seed));
    if (app.count("--threads")) set(settings, "particle_filter.threads", std::to_string(threads));
  }
};

}  // namespace hybrid_slam
