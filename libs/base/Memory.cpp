#include "base/Memory.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <limits>
#include <new>

namespace hybrid_slam {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
std::atomic<double> limit{kNone};

}  // namespace

void expectMemory(size_t bytes) {
  constexpr size_t kMargin = 1 << 20;
  ::operator delete(::operator new(bytes + kMargin));
}

void resizeScan(mrpt::obs::CObservation2DRangeScan& scan, size_t beams) {
  constexpr size_t kBeamBytes = 9;  // range, intensity and validity
  expectMemory(kBeamBytes * beams);
  scan.resizeScan(beams);
}

double residentBytes() {
  std::ifstream pages("/proc/self/statm");
  double all = 0, resident = 0;
  pages >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

ResidentLimit::ResidentLimit(double bytes) { limit = bytes; }

ResidentLimit::~ResidentLimit() { limit = kNone; }

void expectBelowLimit(size_t more) {
  if (const double most = limit; most < kNone && residentBytes() + static_cast<double>(more) > most)
    throw std::bad_alloc();
}

}  // namespace hybrid_slam
