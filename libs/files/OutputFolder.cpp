#include "files/OutputFolder.h"

#include <unistd.h>

#include <cerrno>
#include <locale>
#include <system_error>

#include "base/Errors.h"

namespace hybrid_slam::files {

OutputFolder::OutputFolder(const std::string& folder) : folder_(folder) {
  const std::string expected = "expected a folder that can be created and written to";
  std::error_code error, ignored;
  std::filesystem::create_directories(folder_, error);
  if (isOfDisk(error.value())) failToWrite(folder, error.value());
  if (!std::filesystem::is_directory(folder_, ignored))
    throw InputError("no such folder, and it cannot be created", folder,
                     expected + (error ? ": " + error.message() : ""));
  if (::access(folder_.c_str(), W_OK | X_OK) != 0)
    throw InputError("output folder not writable", folder, expected);
}

void OutputFolder::write(const std::string& name, const std::function<void(std::ostream&)>& fill) const {
  GrowingFile file(path(name));
  fill(file.stream());
  file.finish();
}

GrowingFile::GrowingFile(const std::string& path) : file_(path) {
  out_.imbue(std::locale::classic());
  errno = 0;
  out_.open(file_.path(), std::ios::binary);
  if (!out_) file_.fail(errno);
}

void GrowingFile::finish() {
  errno = 0;
  out_.close();
  if (!out_) file_.fail(errno);
  file_.commit();
}

}  // namespace hybrid_slam::files
