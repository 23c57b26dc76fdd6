/// @file PngPicture.cpp
/// @brief PNG pictures: their chunks are checked before OpenCV decodes them.

#include <zlib.h>

#include <array>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string_view>

#include "run/PictureFile.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam::run {
namespace {

uint32_t numberAt(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes[at + i]);
  return value;
}

/// A pass of an interlaced PNG: a reduced picture with every dx-th pixel from x0 on.
struct Pass {
  size_t x0, dx, y0, dy;
};
constexpr Pass kInterlaced[] = {{0, 8, 0, 8}, {4, 8, 0, 8}, {0, 4, 4, 8}, {2, 4, 0, 4},
                                {0, 2, 2, 4}, {1, 2, 0, 2}, {0, 1, 1, 2}};

/// Returns the bytes of the inflated pixels that the header claims: each row has an additional one for its
/// filter.
size_t pixelBytes(std::string_view header) {
  constexpr size_t kLength = 13, kMostDepth = 16, kMostKind = 6;
  if (header.size() != kLength) throw std::runtime_error("no PNG header");
  const auto depth = static_cast<uint8_t>(header[8]), kind = static_cast<uint8_t>(header[9]);
  if (depth > kMostDepth || kind > kMostKind) throw std::runtime_error("no PNG header");
  const size_t bits = static_cast<size_t>(depth) * (kind == 2 ? 3 : kind == 4 ? 2 : kind == 6 ? 4 : 1);
  const size_t width = numberAt(header, 0), height = numberAt(header, 4);
  checkSize(width, height);
  const auto bytesOf = [&](const Pass& pass) {
    if (width <= pass.x0 || height <= pass.y0) return size_t{0};
    const size_t columns = (width - pass.x0 + pass.dx - 1) / pass.dx;
    return ((columns * bits + 7) / 8 + 1) * ((height - pass.y0 + pass.dy - 1) / pass.dy);
  };
  size_t bytes = 0;
  if (header[12] == 0)
    bytes = bytesOf({0, 1, 0, 1});
  else
    for (const Pass& pass : kInterlaced) bytes += bytesOf(pass);
  if (bytes > 2 * kMostCells) throw std::runtime_error("pixels of more than 2^29 bytes");
  return bytes;
}

/// The chunks that make up the pixels.
struct Chunks {
  std::string picture = "\x89PNG\r\n\x1a\n";  ///< without other chunks, whose errors libpng would print
  size_t pixelBytes = 0;
  std::string deflated;
};

Chunks essentialChunks(std::string_view bytes) {
  constexpr size_t kFrame = 12;  // length, type and checksum
  Chunks chunks;
  std::string_view type;
  for (size_t at = chunks.picture.size(); type != "IEND";) {
    if (bytes.size() < at + kFrame || numberAt(bytes, at) > bytes.size() - at - kFrame)
      throw std::runtime_error("cut off");
    const size_t length = numberAt(bytes, at);
    type = bytes.substr(at + 4, 4);
    const std::string_view content = bytes.substr(at + 8, length);
    const auto* const checked = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    if (::crc32(0, checked, static_cast<uInt>(length + 4)) != numberAt(bytes, at + 8 + length))
      throw std::runtime_error("damaged: wrong checksum");
    if ((chunks.pixelBytes == 0) != (type == "IHDR")) throw std::runtime_error("no PNG header");
    if (type == "IHDR") chunks.pixelBytes = pixelBytes(content);
    if (type == "IDAT") chunks.deflated += content;
    if (type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" || type == "IEND")
      chunks.picture += bytes.substr(at, kFrame + length);
    at += kFrame + length;
  }
  return chunks;
}

/// Returns the size of an inflated zlib stream; stops beyond `most`.
/// @throws std::runtime_error if it is cut or damaged
size_t inflatedSize(const std::string& deflated, size_t most) {
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(deflated.data()));
  stream.avail_in = static_cast<uInt>(deflated.size());
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("damaged");
  std::array<Bytef, 1 << 16> buffer;
  int state = Z_OK;
  while (state == Z_OK && stream.total_out <= most) {
    stream.next_out = buffer.data(), stream.avail_out = buffer.size();
    state = inflate(&stream, Z_NO_FLUSH);
  }
  const size_t size = stream.total_out;
  inflateEnd(&stream);
  if (state == Z_BUF_ERROR) throw std::runtime_error("cut off");
  if (state != Z_STREAM_END && size <= most) throw std::runtime_error("damaged");
  return size;
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
  Chunks chunks = essentialChunks(bytes);
  const size_t size = inflatedSize(chunks.deflated, chunks.pixelBytes);
  if (size != chunks.pixelBytes) throw std::runtime_error(size < chunks.pixelBytes ? "cut off" : "damaged");
  const cv::Mat encoded(1, static_cast<int>(chunks.picture.size()), CV_8U, chunks.picture.data());
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
