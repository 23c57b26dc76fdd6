#include "bags/ChunkedFile.h"

namespace hybrid_slam::bags {

std::optional<StoredMessage> ChunkedFile::next() {
  try {
    while (defect_.empty()) {
      if (inChunk_.left() == 0 && isAtEnd_) break;
      if (auto message = inChunk_.left() > 0 ? nextInChunk() : nextRecord()) return message;
    }
  } catch (const BrokenBytes& broken) {
    defect_ = broken.what();
  } catch (const files::Damaged& damage) {
    defect_ = std::string("damaged chunk (") + damage.what() + ")";
  }
  inChunk_ = ByteCursor({});
  return std::nullopt;
}

void ChunkedFile::openChunk(std::optional<files::Compression> compression, std::string_view bytes,
                            uint64_t size) {
  if (size > kMostChunkBytes) throw BrokenBytes("a chunk is over 256 MiB");
  chunk_ = compression ? files::decoded(*compression, bytes, size) : std::string(bytes);
  inChunk_ = ByteCursor(chunk_);
}

}  // namespace hybrid_slam::bags
