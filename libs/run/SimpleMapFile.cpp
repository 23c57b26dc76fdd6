#include "run/SimpleMapFile.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <exception>

#include "files/RawlogWriter.h"

namespace hybrid_slam::run {
namespace {

/// Serialises as a CSimpleMap, but creates its pairs one by one while writing.
class StreamedSimpleMap : public mrpt::maps::CSimpleMap {
 public:
  StreamedSimpleMap(LogAgain& log, const std::vector<bool>& isUpdate,
                    const std::vector<mrpt::math::TPose2D>& path, const ReadingVisitor& visit)
      : log_(&log), isUpdate_(&isUpdate), path_(&path), visit_(&visit) {}

  /// Writes scans and poses only. MRPT 2.5.8 reads this version and no later one; 2.14.7 reads both.
  uint8_t serializeGetVersion() const override { return 1; }
  void serializeTo(mrpt::serialization::CArchive& out) const override try {
    out.WriteAs<uint32_t>(std::count(isUpdate_->begin(), isUpdate_->end(), true));
    size_t written = 0;
    for (const bool isUpdate : *isUpdate_) {
      const readings::Reading reading = log_->next();
      const mrpt::math::TPose2D* const robot = isUpdate ? &(*path_)[written++] : nullptr;
      (*visit_)(reading, robot);
      if (!robot) continue;
      mrpt::obs::CSensoryFrame frame;
      for (const auto& scan : reading.scans) frame.insert(scan);
      const mrpt::poses::CPose3D pose{mrpt::poses::CPose2D(*robot)};
      out << mrpt::poses::CPose3DPDFGaussian(pose) << frame;
    }
  } catch (...) {
    failure_ = std::current_exception();  // MRPT would replace its type
  }

  /// @throws the error of writing, if any
  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  LogAgain* log_;
  const std::vector<bool>* isUpdate_;
  const std::vector<mrpt::math::TPose2D>* path_;
  const ReadingVisitor* visit_;
  mutable std::exception_ptr failure_;
};

}  // namespace

void saveSimpleMap(const files::OutputFolder& folder, LogAgain& log, const std::vector<bool>& isUpdate,
                   const std::vector<mrpt::math::TPose2D>& path, const ReadingVisitor& visit) {
  files::RawlogWriter file(folder.path("map.simplemap.gz"));
  const StreamedSimpleMap map(log, isUpdate, path, visit);
  file.write(map);
  map.check();
  file.finish();
}

}  // namespace hybrid_slam::run
