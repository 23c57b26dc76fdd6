#include "run/GreyPicture.h"

#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>

#include "base/Errors.h"
#include "files/InputFile.h"
#include "run/PictureFile.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam::run {
namespace {

constexpr const char* kPictureExpected = "expected a picture of a map (PGM or PNG)";
constexpr size_t kMostPictureBytes =
    4 * kMostCells + 4096;  // of a plain PGM: three digits and a space a pixel

std::string pictureBytes(const std::string& file) {
  files::expectFile(file, kPictureExpected);
  const auto size = std::filesystem::file_size(file);
  if (size > kMostPictureBytes) throw InputError("picture too large", file, "expected at most 2^28 pixels");
  std::string bytes(size, '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw InputError("cannot read", file, kPictureExpected);
  return bytes;
}

GreyPicture decode(const std::string& bytes) {
  if (bytes.compare(0, 2, "P2") == 0 || bytes.compare(0, 2, "P5") == 0) return decodePgm(bytes);
  if (bytes.compare(0, 8, "\x89PNG\r\n\x1a\n") == 0) return decodePng(bytes);
  throw std::runtime_error("neither PGM nor PNG");
}

}  // namespace

void checkSize(size_t width, size_t height) {
  constexpr size_t kLongestSide = 1 << 20;
  if (width == 0 || height == 0) throw std::runtime_error("no pixels");
  if (width > kLongestSide || height > kLongestSide)
    throw std::runtime_error("more than 2^20 pixels on a side");
  if (width * height > kMostCells) throw std::runtime_error("more than 2^28 pixels");
}

GreyPicture readGreyPicture(const std::string& file) {
  const std::string bytes = pictureBytes(file);
  try {
    return decode(bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError("not a readable picture (" + messageOf(e) + ")", file, kPictureExpected);
  }
}

}  // namespace hybrid_slam::run
