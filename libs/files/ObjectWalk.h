/// @file ObjectWalk.h
/// @brief Steps over the fields of a serialised MRPT object without building it.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/ObjectBytes.h"

namespace hybrid_slam::files {

/// Kinds of objects by where they may occur. They bound the nesting: no object may hold one of the same kind.
enum class ObjectKind {
  frame,
  actions,
  observation,
  action,
  pdf2D,
  pdf3D,
  pose2D,
  pose3D,
  matrixF,
  matrixD,
  gridMap,
  mapParameters,
};

struct ObjectLayout;

/// Thrown for bytes that are not an object MRPT may read.
struct ObjectError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Thrown if the bytes end within an object.
struct ObjectCut : ObjectError {
  using ObjectError::ObjectError;
};

/// Largest number of characters of a sensor's label: labels are kept, so that they must not fill the memory.
constexpr size_t kLongestLabel = 1000;

/// A walk through one object after another, within the limits that MRPT itself does not check.
class ObjectWalk {
 public:
  static constexpr size_t kMostBytes = size_t{1} << 26;  ///< of an object of a log

  /// @param passesOver  skip observations of unlisted classes instead of throwing
  /// @param mostBytes   of the object
  ObjectWalk(ObjectBytes& bytes, bool passesOver, size_t mostBytes = kMostBytes)
      : bytes_(bytes), passesOver_(passesOver), mostBytes_(mostBytes) {}

  /// Steps over an entry of a log. @throws ObjectError, ObjectCut
  void entry();
  /// Steps over one object.
  void object(ObjectKind kind);
  /// Steps over a count and that many observations.
  void observations();

  /// @name Fields
  /// @{
  void skip(size_t count);
  uint8_t byte();
  uint32_t number();
  float real();
  /// Reads a bool. Old logs hold other bytes than 0 and 1, which would be undefined behaviour in MRPT; they
  /// become 1.
  bool flag();
  /// Reads a number of elements of at least `size` bytes each, and checks that these bytes exist.
  size_t count(size_t size);
  /// Steps over a count and that many elements of `size` bytes.
  void array(size_t size) { skip(size * count(size)); }
  void text() { array(1); }
  /// Steps over the label of a sensor.
  void label();
  void flags();
  /// @}

  size_t at() const { return at_; }
  /// Classes of the observations that were passed over.
  const std::vector<std::string>& passedOver() const { return passedOver_; }
  /// Returns the object without the observations passed over; empty if the object itself was. Valid until the
  /// bytes or the walk change.
  std::string_view rest();

 private:
  struct Header {
    std::string_view name;  ///< valid until bytes are read
    const ObjectLayout* layout = nullptr;
    int version = 0;
    bool hasEndFlag = true;
  };
  Header header();
  void contents(const Header& header, std::initializer_list<ObjectKind> kinds);
  bool mayPassOver(const Header& header, bool isInFrame) const;
  template <class MayFollow>
  void passOver(const Header& header, MayFollow mayFollow);
  bool isStart(size_t at, bool isInFrame);
  bool isEnd(size_t at) { return !bytes_.has(at + 1); }
  void need(size_t count);

  ObjectBytes& bytes_;
  bool passesOver_;
  size_t mostBytes_;
  size_t at_ = 0;
  std::vector<std::string> passedOver_;
  std::vector<std::pair<size_t, size_t>> cuts_;  ///< [first, end)
  size_t countAt_ = 0;                           ///< of the observations of a frame
  std::string rest_;
};

}  // namespace hybrid_slam::files
