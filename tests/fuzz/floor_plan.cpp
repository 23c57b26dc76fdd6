/// @file floor_plan.cpp
/// @brief Floor plans, movable things and routes of simul-floorplan.

#include "MemoryFile.h"
#include "base/Errors.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/MovableThings.h"
#include "study/simulation/Route.h"

using namespace hybrid_slam;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::MemoryFile file(data, size);
  try {
    const simulation::BuildingPlan plan = simulation::BuildingPlan::load(file.path());
    plan.castRay({0.1, 0.2}, 0.3, 20);
    plan.distanceToNearestWall({1, 2});
  } catch (const InputError&) {
  }
  try {
    const simulation::BuildingPlan room({simulation::Wall::straight({0, 0}, {8, 0})});
    simulation::MovableThings::load(file.path(), room).inSession(1, 2);
  } catch (const InputError&) {
  }
  try {
    simulation::Route::load(file.path());
  } catch (const InputError&) {
  }
  return 0;
}
