#include "bags/Rosbag2Database.h"

#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "bags/ByteCursor.h"
#include "base/Errors.h"
#include "files/CompressedFile.h"

namespace hybrid_slam::bags {
namespace {

constexpr const char* kExpected = "expected a ROS 2 recording with the tables topics and messages";
constexpr std::array kPending{"-wal", "-journal"};  // files of changes that are not in the database yet
constexpr uint64_t kMostUnpackedBytes = uint64_t{16} << 30;
constexpr int kLongestStatement = 1 << 20;  // bytes, in the file or ours with the numbers of all topics

/// Decompresses a database to a temporary file, which is removed with the object.
class Unpacked {
 public:
  explicit Unpacked(const std::string& path) {
    files::CompressedFile in(path, "expected a readable log");
    if (!in.compression()) {
      path_ = path;
      return;
    }
    path_ = std::filesystem::temp_directory_path() / "hybrid-slam-XXXXXX";
    descriptor_ = ::mkstemp(path_.data());
    if (descriptor_ < 0) fail(errno);
    std::array<char, 1 << 16> block{};
    uint64_t total = 0;
    while (const size_t count = in.read(block.data(), block.size())) {
      total += count;
      if (total > kMostUnpackedBytes) {
        remove();
        throw InputError("too large", path, "expected a database of at most 16 GiB");
      }
      const ssize_t written = ::write(descriptor_, block.data(), count);
      if (written != static_cast<ssize_t>(count)) fail(written < 0 ? errno : ENOSPC);
    }
    if (in.defect().empty()) return;
    remove();
    throw InputError(in.defect(), path, "expected a whole file");
  }
  ~Unpacked() { remove(); }
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void fail(int error) {
    remove();
    throw InputError("cannot unpack the database", path_,
                     std::string("expected free space for temporary files: ") + std::strerror(error));
  }
  void remove() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    ::unlink(path_.c_str());
    descriptor_ = -1;
  }
  std::string path_;
  int descriptor_ = -1;
};

/// Returns SQLite's name of the file. A file without pending changes is said not to change: for one in WAL
/// mode, as rosbag2 wrote at first, SQLite would else create two more beside it, and fail where it may not.
std::string uriOf(const std::string& path) {
  std::string uri = "file://";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    constexpr const char* kDigits = "0123456789ABCDEF";
    if (std::isalnum(byte) || c == '/' || c == '.' || c == '-' || c == '_')
      uri += c;
    else
      uri += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  const bool hasChanges = std::any_of(kPending.begin(), kPending.end(), [&path](const char* suffix) {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(path + suffix, ignored);
    return !ignored && size > 0;
  });
  return hasChanges ? uri : uri + "?immutable=1";
}

/// Returns whether SQLite should stop: the pages of a schema may refer to each other.
int stopsOpening(void* steps) {
  constexpr int kMostSteps = 1'000'000;  // of SQLite's machine; 10,000 topics need fewer than 100,000
  return ++*static_cast<int*>(steps) > kMostSteps;
}

std::string textAt(sqlite3_stmt* row, int column) {
  const unsigned char* const text = sqlite3_column_text(row, column);
  return text ? std::string(reinterpret_cast<const char*>(text)).substr(0, kMostNameBytes) : std::string();
}

}  // namespace

Rosbag2Database::Rosbag2Database(const std::string& path)
    : database_(nullptr, sqlite3_close), messages_(nullptr, sqlite3_finalize) {
  const Unpacked file(path);  // SQLite keeps it open after its name has gone
  sqlite3* opened = nullptr;
  const int state =
      sqlite3_open_v2(uriOf(file.path()).c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(opened);
  if (state != SQLITE_OK) throw InputError("cannot read", path, kExpected);
  for (const int off :
       {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER})
    sqlite3_db_config(opened, off, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_drop_modules(opened, nullptr);  // of virtual tables
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(kMostChunkBytes));
  sqlite3_limit(opened, SQLITE_LIMIT_SQL_LENGTH, kLongestStatement);
  int steps = 0;  // counted here, because SQLite restarts its own count at each row
  sqlite3_progress_handler(opened, 1, stopsOpening, &steps);
  sqlite3_exec(opened, "PRAGMA cell_size_check=ON; PRAGMA mmap_size=0", nullptr, nullptr, nullptr);
  checkTable("topics", path);
  checkTable("messages", path);
  readTopics(path);
  const auto size = query("SELECT page_count * page_size FROM pragma_page_count, pragma_page_size");
  if (size && sqlite3_step(size.get()) == SQLITE_ROW) bytesLeft_ = sqlite3_column_int64(size.get(), 0);
  // Only what is read is loaded: a recording may hold gigabytes of pictures. Without an index, the rows come
  // in their order; ORDER BY rowid would sort them in temporary files if a column had that name.
  std::string read = "-1";
  for (const auto& [id, topic] : ids_)
    if (topics_[topic].messageType) read += "," + std::to_string(id);
  messages_ = query("SELECT topic_id, timestamp, CASE WHEN topic_id IN (" + read +
                    ") THEN data END FROM messages NOT INDEXED");
  if (!messages_) throw InputError("not a recording", path, kExpected);
  sqlite3_progress_handler(opened, 0, nullptr, nullptr);  // a recording may be long
}

Rosbag2Database::~Rosbag2Database() = default;

std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> Rosbag2Database::query(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr);
  return {statement, sqlite3_finalize};
}

void Rosbag2Database::checkTable(const std::string& name, const std::string& path) {
  const auto columns = query("SELECT hidden FROM pragma_table_xinfo('" + name + "')");
  int state = columns ? SQLITE_ROW : sqlite3_errcode(database_.get());
  while (state == SQLITE_ROW && (state = sqlite3_step(columns.get())) == SQLITE_ROW)
    if (sqlite3_column_int(columns.get(), 0) != 0)
      throw InputError("computed columns in table " + name, path, kExpected);
  if (state == SQLITE_CORRUPT)
    throw InputError("damaged database, or cut off: " + std::string(sqlite3_errmsg(database_.get())), path,
                     "expected a whole file; SQLite's `.recover` may restore it");
  if (state != SQLITE_DONE) throw InputError("not a recording", path, kExpected);
}

void Rosbag2Database::readTopics(const std::string& path) {
  const auto rows = query("SELECT id, name, type, serialization_format FROM topics");
  if (!rows) throw InputError("not a recording", path, kExpected);
  int state = SQLITE_ROW;
  try {
    for (size_t count = 1; (state = sqlite3_step(rows.get())) == SQLITE_ROW; ++count) {
      if (count > kMostTopics) throw BrokenBytes("it has over 10,000 topics");
      const std::string format = textAt(rows.get(), 3);
      const std::string type = textAt(rows.get(), 2) + (format == "cdr" ? "" : " (" + format + ")");
      ids_[sqlite3_column_int64(rows.get(), 0)] = topicOf(textAt(rows.get(), 1), type, Encoding::cdr);
    }
  } catch (const BrokenBytes& broken) {
    throw InputError("not readable", path, broken.what());
  }
  if (state != SQLITE_DONE)
    throw InputError(std::string("damaged database (") + sqlite3_errmsg(database_.get()) + ")", path,
                     kExpected);
}

std::optional<StoredMessage> Rosbag2Database::next() {
  while (defect_.empty() && messages_) {
    const int state = sqlite3_step(messages_.get());
    if (state == SQLITE_ROW) {
      const auto count = static_cast<size_t>(sqlite3_column_bytes(messages_.get(), 2));
      bytesLeft_ -= 1 + static_cast<int64_t>(count);
      if (bytesLeft_ < 0) {
        defect_ = "damaged database (more messages than bytes)";
        messages_.reset();
        break;
      }
      const auto topic = ids_.find(sqlite3_column_int64(messages_.get(), 0));
      if (topic == ids_.end()) continue;
      const double time = 1e-9 * static_cast<double>(sqlite3_column_int64(messages_.get(), 1));
      const auto* const data = static_cast<const char*>(sqlite3_column_blob(messages_.get(), 2));
      return StoredMessage{topic->second, time, data ? std::string_view(data, count) : std::string_view()};
    }
    if (state != SQLITE_DONE)
      defect_ = std::string("damaged database (") + sqlite3_errmsg(database_.get()) + ")";
    messages_.reset();
  }
  return std::nullopt;
}

}  // namespace hybrid_slam::bags
