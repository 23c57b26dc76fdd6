/// @file plan.cpp
/// @brief Floor plans given as a prior: DXF, GeoJSON, SVG.

#include <string>

#include "base/Errors.h"
#include "run/PlanFiles.h"

using namespace hybrid_slam;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(data, data + size);
  for (const char* name : {"plan.dxf", "plan.geojson", "plan.svg"}) try {
      run::planOf(text, name);
    } catch (const InputError&) {
    }
  return 0;
}
