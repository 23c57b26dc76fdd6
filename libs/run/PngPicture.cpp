/// @file PngPicture.cpp
/// @brief PNG pictures: their chunks are checked before OpenCV decodes them.

#include <zlib.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string_view>

#include "run/PictureFile.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam::run {
namespace {

constexpr size_t kSignature = 8, kFrame = 12;  // bytes; of a chunk: length, type and checksum

uint32_t numberAt(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes[at + i]);
  return value;
}

/// What the header of a PNG file claims.
struct PngHeader {
  size_t width, height, bytes;  ///< bytes: of all pixels
};

PngHeader headerOf(std::string_view chunk) {
  constexpr size_t kLength = 13;
  if (chunk.size() != kLength) throw std::runtime_error("no PNG header");
  const auto depth = static_cast<uint8_t>(chunk[8]), colours = static_cast<uint8_t>(chunk[9]);
  if (depth > 16 || colours > 6) throw std::runtime_error("no PNG header");
  const size_t channels = colours == 2 ? 3 : colours == 4 ? 2 : colours == 6 ? 4 : 1;
  const size_t width = numberAt(chunk, 0), height = numberAt(chunk, 4);
  checkSize(width, height);
  return {width, height, (width * channels * depth + 7) / 8 * height};
}

/// The picture without the chunks that do not change its pixels: libpng prints what it finds wrong in them.
/// @throws std::runtime_error if the chunks cannot hold the pixels that the header claims
std::string essentialChunks(std::string_view bytes) {
  constexpr size_t kMostDeflated = 1032;  // bytes out of one: no stream of zlib has more
  std::string out(bytes.substr(0, kSignature));
  PngHeader header{};
  size_t deflated = 0;
  std::string_view type;
  for (size_t at = kSignature; type != "IEND";) {
    if (bytes.size() < at + kFrame || numberAt(bytes, at) > bytes.size() - at - kFrame)
      throw std::runtime_error("cut off");
    const size_t length = numberAt(bytes, at);
    type = bytes.substr(at + 4, 4);
    const std::string_view chunk = bytes.substr(at + 8, length);
    const auto* checked = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    if (::crc32(0, checked, static_cast<uInt>(length + 4)) != numberAt(bytes, at + 8 + length))
      throw std::runtime_error("damaged: wrong checksum");
    if ((header.width == 0) != (type == "IHDR")) throw std::runtime_error("no PNG header");
    if (type == "IHDR") header = headerOf(chunk);
    if (type == "IDAT") deflated += length;
    if (type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND")
      out += bytes.substr(at, kFrame + length);
    at += kFrame + length;
  }
  if (header.bytes > kMostCells) throw std::runtime_error("pixels of more than 2^28 bytes");
  if (header.bytes > kMostDeflated * deflated) throw std::runtime_error("cut off");
  return out;
}

/// Colours and opacity of a pixel, 0..255.
struct Pixel {
  unsigned grey;
  bool isTransparent;
};

template <class Sample>
Pixel pixelAt(const cv::Mat& image, int x, int y) {
  constexpr unsigned kToByte = sizeof(Sample) == 1 ? 1 : 257;
  const int channels = image.channels(), colours = channels < 3 ? 1 : 3;
  const Sample* const samples = image.ptr<Sample>(y) + static_cast<ptrdiff_t>(x) * channels;
  unsigned sum = 0;
  for (int i = 0; i < colours; ++i) sum += samples[i];
  const unsigned scale = static_cast<unsigned>(colours) * kToByte;
  return {(sum + scale / 2) / scale, channels > colours && samples[colours] < 255 * kToByte};
}

}  // namespace

GreyPicture decodePng(const std::string& bytes) {
  const std::string chunks = essentialChunks(bytes);
  const cv::Mat encoded(1, static_cast<int>(chunks.size()), CV_8U, const_cast<char*>(chunks.data()));
  const cv::Mat image = cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  if (image.empty() || (image.depth() != CV_8U && image.depth() != CV_16U))
    throw std::runtime_error("damaged");
  GreyPicture picture;
  picture.width = static_cast<size_t>(image.cols), picture.height = static_cast<size_t>(image.rows);
  picture.grey.resize(picture.width * picture.height);
  if (image.channels() == 4) picture.isTransparent.resize(picture.grey.size());
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const Pixel pixel =
          image.depth() == CV_8U ? pixelAt<uint8_t>(image, x, y) : pixelAt<uint16_t>(image, x, y);
      const size_t i = picture.index(static_cast<size_t>(x), static_cast<size_t>(y));
      picture.grey[i] = static_cast<uint8_t>(pixel.grey);
      if (!picture.isTransparent.empty()) picture.isTransparent[i] = pixel.isTransparent;
    }
  return picture;
}

}  // namespace hybrid_slam::run
