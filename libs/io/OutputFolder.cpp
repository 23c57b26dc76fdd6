#include "io/OutputFolder.h"

#include <stdexcept>
#include <system_error>

#include "base/Errors.h"

namespace hybrid_slam {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannotWrite(const std::string& file) {
  throw std::runtime_error("cannot write: " + file + "; is the disk full?");
}

}  // namespace

OutputFolder::OutputFolder(const std::string& folder) : folder_(folder) {
  const std::string expected = "expected a folder that can be made and written to";
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!fs::is_directory(folder_)) throw InputError("no such folder, and it cannot be made", folder, expected);
  const std::string probe = path(".probe.partial");
  const bool isWritable = static_cast<bool>(std::ofstream(probe));
  fs::remove(probe, error);
  if (!isWritable) throw InputError("output folder not writable", folder, expected);
}

void OutputFolder::write(const std::string& name, const std::function<void(std::ostream&)>& fill) const {
  GrowingFile file(*this, name);
  fill(file.stream());
  file.finish();
}

void OutputFolder::writeFile(const std::string& name,
                             const std::function<bool(const std::string&)>& fill) const {
  const std::string partial = path(".partial." + name);
  std::error_code error;
  bool isWritten = false;
  try {
    isWritten = fill(partial);
  } catch (...) {
    fs::remove(partial, error);
    throw;
  }
  if (isWritten) fs::rename(partial, path(name), error);
  if (!isWritten || error) {
    fs::remove(partial, error);
    cannotWrite(path(name));
  }
}

GrowingFile::GrowingFile(const OutputFolder& folder, const std::string& name)
    : partial_(folder.path(".partial." + name)), final_(folder.path(name)), out_(partial_) {
  if (!out_) cannotWrite(final_);
}

GrowingFile::~GrowingFile() {
  if (partial_.empty()) return;
  std::error_code error;
  fs::remove(partial_, error);
}

void GrowingFile::finish() {
  out_.close();
  std::error_code error;
  if (out_) fs::rename(partial_, final_, error);
  if (!out_ || error) cannotWrite(final_);
  partial_.clear();
}

}  // namespace hybrid_slam
