/// @file kernels.cpp
/// @brief The kernels of an update, timed by Google Benchmark, and their lower bounds on this machine.
///
/// A kernel's lower bound is the greater of two times: its operations divided by the measured addition rate,
/// and its bytes divided by the measured bandwidth of the cache that holds them. Operations are counted by
/// hand in the source. Every floating-point operation of the inner loop counts as one, an instruction on four
/// floats as two. Integer operations count as halves in loops that consist mainly of them (traversal,
/// insertion, penetration weight), since four start in the time of two additions of doubles; elsewhere they
/// run in parallel and are not counted. Table look-ups count as bytes.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>

#include "Machine.h"
#include "slam/filter/HybridMapBuilder.h"
#include "slam/grid/PenetrationModel.h"
#include "slam/grid/RaySamples.h"
#include "testing/MappedRoom.h"

namespace hybrid_slam::bench {
namespace {

using mrpt::math::TPose2D;

/// One run of a kernel: number of items, and the minimum work per item.
struct Kernel {
  std::string name, item;
  double items;
  double operations, bytes;  ///< per item
  bool isVector;             ///< its operations are independent, so that one SSE instruction performs two
  std::function<void()> run;
  std::string why;
};

/// A particle that has mapped a room of 11 m x 8.5 m, and a scan of 181 beams seen there.
struct Scene {
  RandomStream random{1, 0, 0};
  Particle particle = test::particleAt(test::room(), {});
  PreparedScan scan = test::prepared(test::room(), {0.1, 0.1, 0.1}, random);
  TPose2D pose{0.1, 0.1, 0.1};
  FilterConfiguration options;
};

/// Follows each beam in steps of one cell, to `beyond` (m) behind its reading, and calls visit(cellX, cellY)
/// at each step.
template <class Visit>
void forEachStep(const Scene& s, const ScanBeams& beams, double beyond, const Visit& visit) {
  const double cell = s.particle.grid.resolution();
  const GridPose frame(s.pose, beams, cell);
  for (const auto& ray : beams.rays) {
    RaySamples place(frame.origin(ray).x, frame.origin(ray).y, frame.dirX(ray), frame.dirY(ray));
    const int last = static_cast<int>((ray.range + beyond) / cell);
    for (int i = 0; i <= last; ++i, place.advance()) visit(place.cellX(), place.cellY());
  }
}

/// Number of columns (rows for steep beams) that the beams cross. Insertion updates one or two cells in each.
double crossedColumns(const Scene& s) {
  double count = 0;
  const GridPose frame(s.pose, s.scan.beams, s.particle.grid.resolution());
  for (const auto& ray : s.scan.beams.rays)
    count += 1 + std::floor(ray.range / s.particle.grid.resolution() *
                            std::max(std::abs(frame.dirX(ray)), std::abs(frame.dirY(ray))));
  return count;
}

std::vector<Kernel> kernelsOf(Scene& s) {
  using benchmark::DoNotOptimize;
  std::vector<Kernel> all;
  const double beams = static_cast<double>(s.scan.beams.rays.size());

  // Two integer additions, two shifts, the loop counter: 5 halves.
  constexpr double kStep = 2.5;
  double steps = 0;
  forEachStep(s, s.scan.beams, 0, [&](int, int) { ++steps; });
  all.push_back({"beam traversal", "step", steps, kStep, 0, false,
                 [&s] {
                   int sum = 0;
                   forEachStep(s, s.scan.beams, 0, [&](int x, int y) { sum += x ^ y; });
                   DoNotOptimize(sum);
                 },
                 "the sum that the benchmark computes"});
  // Next position 1, next column 1, loop counter 1, entry and exit of the beam 4, addresses of two counts 4,
  // comparison 1, two additions 2: 14 halves. Two counts are read and written.
  all.push_back(
      {"insertion", "column", crossedColumns(s), 7, 4, false,
       [&s] { s.particle.grid.insert(s.scan.beams, s.pose, s.options.grid); },
       "each count is read, changed and written back before the next; iteration over the scan's tiles"});
  static const PenetrationModel model(s.options.gridWeight, s.particle.grid.resolution());
  // A free block of 8 steps: last position 4, tiles of both ends 6, tile look-up 3, squares 4, flags of four
  // squares 16, their combination and comparison 5, next block 6: 44 halves. Any other step: address of the
  // cell 4 halves; product, difference, sum, product and sum 5 operations; one cell and two numbers are read.
  // Work done once per wall is not counted.
  const double beyond = 3 * s.options.gridWeight.sigma;
  double weighed = 0, met = 0;
  forEachStep(s, s.scan.weighedBeams, beyond, [&](int x, int y) {
    ++weighed;
    met += s.particle.grid.tiles().at({x, y}) >= 0;
  });
  all.push_back(
      {"penetration weight", "step", weighed, ((weighed - met) / 8 * 22 + met * (kStep + 2 + 5)) / weighed,
       ((weighed - met) / 8 * 8 + met * 17) / weighed, false,
       [&s] { DoNotOptimize(model.meanLogLikelihood(s.scan.weighedBeams, s.pose, s.particle.grid)); },
       "free cells near others are traversed one by one; each product depends on the previous one; the ends "
       "of free squares are sometimes mispredicted"});
  // End of the beam 12, floors 4, residual 3; on four floats weights 12, columns 7, row 4. The patch of 16
  // floats is cached between calls.
  static const ScanMatcher matcher(s.options.matcher);
  const double matched = static_cast<double>(s.scan.matchedBeams.rays.size());
  static ScanLikelihood likelihood = matcher.likelihood(s.scan.matchedBeams, s.particle.grid);
  constexpr double kValue = 19 + 2 * 23, kPatch = 16 * 4 + 12;
  all.push_back({"logLikelihoodValue", "beam", matched, kValue, kPatch, true,
                 [&s] { DoNotOptimize(likelihood.value(s.pose)); },
                 "packing and unpacking of single numbers in vectors of four"});
  // With slopes, on four floats: weights 8 more, columns 7, rows 8; products for gradient and information 30.
  constexpr double kSlope = kValue + 2 * 23 + 30;
  all.push_back({"logLikelihood", "beam", matched, kSlope, kPatch, true,
                 [&s] { DoNotOptimize(likelihood(s.pose)); },
                 "as above; ten sums carried from beam to beam"});
  const TPose2D start = s.pose + TPose2D(0.03, 0.02, 0.01);
  double evaluations = -1;  // the prior is evaluated one more time at the end
  const auto match = [&s, start](const Prior& prior) {
    DoNotOptimize(matcher.match(s.scan.matchedBeams, start, s.particle.grid, prior));
  };
  match([&](const TPose2D&) { return ++evaluations, LogDensity(); });
  // Each step evaluates logLikelihood once, the curvature six times; the fit evaluates the value once.
  all.push_back({"match", "beam", matched, kSlope * (evaluations + 6) + kValue, kPatch * (evaluations + 7),
                 true, [match] { match([](const TPose2D&) { return LogDensity(); }); },
                 "as logLikelihood; cells around the end points are read again where a step changes them"});
  // The bytes that a copy reads and writes; the map itself is shared.
  all.push_back(
      {"particle copy", "copy", 1, 0, 2 * sizeof(Particle) + 4 * 2 * 8, false,
       [&s] {
         const Particle copy(s.particle);
         DoNotOptimize(&copy);
       },
       "atomic reference counts of shared tiles (some 20 cycles each, up and down); allocation of the window "
       "of blocks"});
  // Each beam votes once per angle: rho 4, then rounding, abs, comparison, index and count; segmentation and
  // fits 60.
  const auto& hough = s.options.lineExtraction.hough;
  const double angles = 2 * std::round(hough.thetaWindow / hough.thetaResolution) + 1;
  all.push_back(
      {"line extraction", "beam", beams, 60 + 9 * angles, 16 + 24 * angles, false,
       [&s] { DoNotOptimize(extractLines(s.scan.scans.front(), s.options.lineExtraction)); },
       "votes are written to memory one by one; std::round is a call without SSE4.1; fits are repeated for "
       "every split"});
  return all;
}

/// Google Benchmark's console reporter, which also keeps the shortest time of each benchmark (ns on one
/// core).
class Keeper : public benchmark::ConsoleReporter {
 public:
  Keeper() : ConsoleReporter(OO_Tabular) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration) continue;
      double& best = shortest.try_emplace(run.run_name.function_name, 1e300).first->second;
      best = std::min(best, run.GetAdjustedCPUTime());
    }
    ConsoleReporter::ReportRuns(runs);
  }
  std::map<std::string, double> shortest;
};

/// Time (ns) per particle of a filter update with the standard proposal, all stages together.
void particleUpdate(benchmark::State& state) {
  FilterConfiguration c = test::roomConfiguration();
  c.filter.particles = static_cast<int>(state.range(0));
  const auto steps = test::drive(4);
  size_t updates = 0;
  while (state.KeepRunning()) {
    HybridMapBuilder builder(c);
    builder.rememberScans(false);
    for (const auto& step : steps) test::feed(builder, step);
    updates += builder.updates();
  }
  state.counters["ns/particle-update"] =
      benchmark::Counter(1e-9 * static_cast<double>(updates) * static_cast<double>(c.filter.particles),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void printTable(const Machine& m, const std::vector<Kernel>& kernels,
                const std::map<std::string, double>& ns) {
  std::printf("\n| this machine, one core | rate |\n|---|---|\n");
  std::printf("| additions of doubles, scalar | %.1f /ns |\n| the same, SSE2 | %.1f /ns |\n", m.scalar,
              m.sse);
  std::printf("| triad in L1, L2, L3, memory | %.0f, %.0f, %.0f, %.0f GB/s |\n", m.l1, m.l2, m.l3, m.memory);
  std::printf(
      "\n| kernel | per | measured (ns) | operations | bytes | lower bound (ns) | ratio | overhead |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const Kernel& k : kernels) {
    const auto found = ns.find(k.name);
    if (found == ns.end()) continue;  // left out by --benchmark_filter
    const double measured = found->second / k.items;
    const double bound = std::max(k.operations / (k.isVector ? m.sse : m.scalar), k.bytes / m.l1);
    std::printf("| %s | %s | %.2f | %.1f | %.0f | %.2f | %.1f | %s |\n", k.name.c_str(), k.item.c_str(),
                measured, k.operations, k.bytes, bound, measured / bound, k.why.c_str());
  }
  std::printf(
      "\nA room's tiles (about 200 kB) fit in L2, those along one beam in L1, so the bounds use L1.\n"
      "A particle: %zu B of its own; tiles of 1 kB and blocks are shared until written.\n",
      sizeof(Particle));
}

}  // namespace
}  // namespace hybrid_slam::bench

int main(int argc, char** argv) {
  using namespace hybrid_slam::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const Machine machine = measureMachine();
  Scene scene;
  const std::vector<Kernel> kernels = kernelsOf(scene);
  for (const Kernel& kernel : kernels)
    benchmark::RegisterBenchmark(
        kernel.name.c_str(),
        [&kernel](benchmark::State& state) {
          for (auto _ : state) kernel.run();
          const double items = kernel.items * static_cast<double>(state.iterations());
          state.counters["ns/" + kernel.item] =
              benchmark::Counter(1e-9 * items, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
        })
        ->MinTime(0.1)
        ->Repetitions(5);
  benchmark::RegisterBenchmark("filter update", particleUpdate)
      ->Arg(30)
      ->Arg(300)
      ->Unit(benchmark::kMillisecond);
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);
  printTable(machine, kernels, keeper.shortest);
}
