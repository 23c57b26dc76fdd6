#include "run/Fingerprint.h"

#include <zlib.h>

#include "base/DeskewedScan.h"

namespace hybrid_slam::run {

uint32_t fingerprintAfter(uint32_t before, const readings::Reading& reading) {
  uLong sum = before;
  const auto add = [&sum](const auto& value) {
    sum = crc32(sum, reinterpret_cast<const Bytef*>(&value), sizeof value);
  };
  add(reading.timestamp);
  for (const auto& scan : reading.scans) {
    if (const auto* deskewed = dynamic_cast<const DeskewedScan*>(scan.get())) {
      for (const float range : deskewed->measured) add(range);
      continue;
    }
    for (size_t i = 0; i < scan->getScanSize(); ++i) add(scan->getScanRange(i));
  }
  return static_cast<uint32_t>(sum);
}

}  // namespace hybrid_slam::run
