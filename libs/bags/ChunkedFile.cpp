#include "bags/ChunkedFile.h"

namespace hybrid_slam::bags {

std::optional<StoredMessage> ChunkedFile::next() {
  try {
    while (defect_.empty()) {
      if (inChunk_.left() == 0 && isCut_) throw CutOff();
      if (inChunk_.left() == 0 && isAtEnd_) break;
      if (auto message = inChunk_.left() > 0 ? nextInChunk() : nextRecord()) return message;
    }
  } catch (const BrokenBytes& broken) {
    defect_ = isCut_ ? CutOff().what() : broken.what();
  } catch (const files::Damaged& damage) {
    defect_ = std::string("damaged chunk (") + damage.what() + ")";
  }
  inChunk_ = ByteCursor({});
  return std::nullopt;
}

void ChunkedFile::takeRecord(uint64_t size, bool isChunk) {
  if (size > kMostChunkBytes) throw BrokenBytes("a record is over 256 MiB");
  record_ = stream_.takeUpTo(size);
  isCut_ = record_.size() < size;
  if (isCut_ && !isChunk) throw CutOff();
}

void ChunkedFile::openChunk(std::optional<files::Compression> compression, std::string_view bytes,
                            uint64_t size) {
  if (size > kMostChunkBytes) throw BrokenBytes("a chunk is over 256 MiB");
  if (!compression)
    chunk_ = bytes;
  else
    chunk_ =
        isCut_ ? files::decodedStart(*compression, bytes, size) : files::decoded(*compression, bytes, size);
  inChunk_ = ByteCursor(chunk_);
}

}  // namespace hybrid_slam::bags
