/// @file State.h
/// @brief Serialisation: one description of a class's members serves writing and reading.
#pragma once

#include <mrpt/core/reverse_bytes.h>
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <vector>

namespace hybrid_slam {

/// Thrown for bytes that no StateWriter can have written.
struct StateError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Largest distance (m) of a pose from the origin of its map.
constexpr double kFarthest = 1e6;

template <class T>
constexpr bool isNumber = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T, class State, class = void>
struct HasVisit : std::false_type {};
template <class T, class State>
struct HasVisit<T, State, std::void_t<decltype(std::declval<T&>().visit(std::declval<State&>()))>>
    : std::true_type {};

/// Writes or reads numbers, texts, containers, poses, and classes with
///
///     template <class State> void visit(State& state) { state(member, ...); }
///
/// as little-endian numbers. Other classes have a free function `visit(state, value)`. A
/// value that several shared_ptrs own is written once. Reading trusts nothing: memory grows with the bytes
/// present, a pose is within kFarthest, NaN is an error. `visit` checks other conditions with
/// `state.check`.
///
/// Common base of writer and reader, which define `number` and `bytes`.
template <class Derived>
class State {
 public:
  template <class... T>
  void operator()(T&... values) {
    (one(values), ...);
  }
  /// Checks a condition on values that were read. @throws StateError
  static void check(bool holds, const char* what) {
    if (Derived::kIsReading && !holds) throw StateError(what);
  }

 private:
  Derived& self() { return static_cast<Derived&>(*this); }

  template <class T>
  void one(T& value) {
    if constexpr (isNumber<T>)
      self().number(value);
    else if constexpr (HasVisit<T, Derived>::value)
      value.visit(self());
    else
      visit(self(), value);
  }
  void one(std::string& text) {
    size_t count = text.size();
    self().number(count);
    if (Derived::kIsReading) text.assign(self().available(count), 0);
    self().bytes(text.data(), count);
  }
  template <class T>
  void one(std::vector<T>& values) {
    sequence(values);
  }
  template <class T>
  void one(std::deque<T>& values) {
    sequence(values);
  }
  template <class T, size_t N>
  void one(std::array<T, N>& values) {
    for (T& value : values) one(value);
  }
  template <class T>
  void one(std::optional<T>& value) {
    bool has = value.has_value();
    one(has);
    if (Derived::kIsReading) value = has ? std::make_optional<T>() : std::nullopt;
    if (has) one(*value);
  }
  template <class T>
  void one(std::shared_ptr<T>& value) {
    self().shared(value);
  }
  void one(mrpt::math::TPoint2D& point) {
    (*this)(point.x, point.y);
    check(std::hypot(point.x, point.y) <= kFarthest, "a point is too far away");
  }
  void one(mrpt::math::TPose2D& pose) {
    (*this)(pose.x, pose.y, pose.phi);
    check(std::hypot(pose.x, pose.y) <= kFarthest && std::abs(pose.phi) <= 1e3, "a pose is too far away");
  }
  template <int Rows, int Columns>
  void one(Eigen::Matrix<double, Rows, Columns>& matrix) {
    for (int i = 0; i < Rows * Columns; ++i) one(matrix(i));
  }
  template <class Container>
  void sequence(Container& values) {
    size_t count = values.size();
    self().number(count);
    if (!Derived::kIsReading) {
      for (auto& value : values) one(value);
      return;
    }
    values.clear();  // grows with what is there, not by a count that the bytes only claim
    for (size_t i = 0; i < count; ++i) one(values.emplace_back());
  }
};

/// Writes members as bytes.
class StateWriter : public State<StateWriter> {
 public:
  static constexpr bool kIsReading = false;
  /// Appends to `bytes`, which must outlive the writer.
  /// @param most  bytes: more are a std::length_error
  explicit StateWriter(std::string& bytes, size_t most = std::numeric_limits<size_t>::max())
      : bytes_(bytes), most_(most) {}

  template <class T>
  void number(const T& value) {
    if constexpr (std::is_enum_v<T>) {
      number(static_cast<int32_t>(value));
    } else if constexpr (std::is_same_v<T, bool>) {
      number(static_cast<uint8_t>(value));
    } else {
      const T written = mrpt::toNativeEndianness(value);  // its own inverse
      bytes(&written, sizeof written);
    }
  }
  void bytes(const void* from, size_t count) {
    if (count > most_ || bytes_.size() > most_ - count) throw std::length_error("the state is too large");
    bytes_.append(static_cast<const char*>(from), count);
  }
  static size_t available(size_t count) { return count; }

  /// Returns the number of a shared value, from 1; 0 if it has not been written.
  template <class T>
  uint32_t numberOf(const T* value) {
    const auto& known = numbers_[typeid(T)];
    const auto at = known.find(value);
    return at == known.end() ? 0 : at->second;
  }
  template <class T>
  uint32_t add(const T* value) {
    auto& known = numbers_[typeid(T)];
    const auto next = static_cast<uint32_t>(known.size() + 1);
    known.emplace(value, next);
    return next;
  }
  template <class T>
  void shared(std::shared_ptr<T>& value) {
    uint32_t id = value ? numberOf(value.get()) : 0;
    const bool isNew = value && id == 0;
    if (isNew) id = add(value.get());
    number(id);
    if (isNew) (*this)(*value);
  }

 private:
  std::string& bytes_;
  size_t most_;
  std::map<std::type_index, std::map<const void*, uint32_t>> numbers_;
};

/// Creates a shared value to read into; specialised where it is of a derived class.
template <class T>
std::shared_ptr<T> newShared() {
  return std::make_shared<T>();
}

/// Reads members from bytes that may be damaged, and checks them.
class StateReader : public State<StateReader> {
 public:
  static constexpr bool kIsReading = true;
  /// `bytes` must outlive the reader.
  explicit StateReader(std::string_view bytes) : bytes_(bytes) {}

  /// All of these throw StateError for bytes that no StateWriter can have written.
  template <class T>
  void number(T& value) {
    if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(read<int32_t>());
    } else if constexpr (std::is_same_v<T, bool>) {
      value = read<uint8_t>() != 0;
    } else {
      value = read<T>();
      if constexpr (std::is_floating_point_v<T>) check(!std::isnan(value), "a value is not a number");
    }
  }
  void bytes(void* to, size_t count) {
    bytes_.copy(static_cast<char*>(to), available(count));
    bytes_.remove_prefix(count);
  }
  size_t available(size_t count) const {
    check(count <= bytes_.size(), "it is cut");
    return count;
  }
  bool isAtEnd() const { return bytes_.empty(); }

  template <class T>
  std::shared_ptr<T> at(uint32_t number) {
    const auto& known = values_[typeid(T)];
    check(number >= 1 && number <= known.size(), "a shared value is missing");
    return std::static_pointer_cast<T>(known[number - 1]);
  }
  template <class T>
  void add(const std::shared_ptr<T>& value) {
    values_[typeid(T)].push_back(value);
  }
  template <class T>
  void shared(std::shared_ptr<T>& value) {
    value.reset();
    const auto number = read<uint32_t>();
    if (number == 0) return;
    if (number != values_[typeid(T)].size() + 1) return (void)(value = at<T>(number));
    value = newShared<T>();
    add(value);
    (*this)(*value);
  }

 private:
  template <class T>
  T read() {
    T value{};
    bytes(&value, sizeof value);
    return mrpt::toNativeEndianness(value);
  }

  std::string_view bytes_;
  std::map<std::type_index, std::vector<std::shared_ptr<void>>> values_;
};

}  // namespace hybrid_slam
