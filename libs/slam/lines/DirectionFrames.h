/// @file DirectionFrames.h
/// @brief The directions of a building, modulo 90 deg, that its lines support: one for each of its wings.
#pragma once

#include <vector>

namespace hybrid_slam {

struct DatabaseLine;

/// A direction that several walls share.
struct DirectionFrame {
  double direction = 0;  ///< rad in [-pi/4, pi/4], modulo 90 deg, map frame
  double evidence = 0;   ///< m, of its lines (LineDatabase.h)
  int lines = 0;

  template <class State>
  void visit(State& state) {
    state(direction, evidence, lines);
  }
};

/// The frames that the evidence supports, those with most evidence first.
///
/// The directions of the lines are a mixture of normal densities, one for each frame, with sigma = 0.5 deg
/// and of a uniform one for lines that belong to none. Lines whose DatabaseLine::direction differ by
/// less than sigma are one frame if that shortens the description of all n directions: n_k lines save
/// n_k (ln(90 deg / (sigma sqrt(2 pi e))) + ln(n_k / n)), and the frame's direction, to a precision of
/// sigma / sqrt(n_k), costs ln(90 deg sqrt(n_k) / sigma) (Rissanen 1978). Two parallel walls are a frame
/// where nothing else is seen; a few of many lines at scattered angles are not.
std::vector<DirectionFrame> directionFrames(const std::vector<DatabaseLine>& lines);

}  // namespace hybrid_slam
