#include <iostream>

#include "readings/RawlogSource.h"
#include "slam/filter/HybridFilter.h"

using namespace hybrid_slam;

int main(int, char** argv) {
  const readings::InputOptions input;
  readings::RawlogSource log(argv[1], input, readings::summarise(argv[1], input));

  FilterConfiguration configuration;  // the defaults of doc/configuration.md
  configuration.filter.particles = 20;
  HybridFilter filter(configuration);
  while (const auto reading = log.next()) filter.process(reading->motion, reading->scans);

  std::cout << "pose " << filter.bestPath().back() << ", " << filter.bestLines().size() << " lines\n";
}
