/// @file FileDrag.h
/// @brief Drags a file to a window, as a file manager does.
#pragma once

#include <memory>
#include <string>

namespace hybrid_slam::test {

/// The source of a drag with the messages of XDND 5, on a connection of its own to the X server. No mouse is
/// needed: the messages say where the pointer is. Each message waits for the window's answer to the one
/// before. A window that has just opened may refuse the first positions, as it does not know its own yet.
class FileDrag {
 public:
  /// Begins a drag over the middle of the window that has the keyboard.
  /// @throws std::runtime_error if that does not know XDND
  explicit FileDrag(const std::string& file);
  ~FileDrag();
  FileDrag(const FileDrag&) = delete;
  FileDrag& operator=(const FileDrag&) = delete;

  /// Answers what the window has sent; does not wait. To be called until the drag is over.
  /// @return whether it is: the window has dealt with the file; never where it takes no drops
  bool isOver();
  /// Returns whether the window has taken the file, once the drag is over.
  bool isTaken() const;

 private:
  struct Drag;
  std::unique_ptr<Drag> drag_;
};

}  // namespace hybrid_slam::test
