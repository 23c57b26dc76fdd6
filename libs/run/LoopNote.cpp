#include "run/LoopNote.h"

#include <mrpt/core/bits_math.h>

#include "base/Numbers.h"

namespace hybrid_slam::run {

std::string loopNote(const LoopClosure& loop, const std::vector<double>& times, bool isRefinement) {
  return std::string("loop closed") + (isRefinement ? " in the refinement" : "") + " at (" +
         fixedText(loop.place.x, 1) + ", " + fixedText(loop.place.y, 1) + ") m between " +
         (loop.earlier ? fixedText(times.at(*loop.earlier), 1) + " s" : "the earlier map") + " and " +
         fixedText(times.at(loop.later), 1) + " s: path moved by up to " + fixedText(loop.shift, 2) +
         " m and " + fixedText(mrpt::RAD2DEG(loop.turn), 1) + " deg; " + std::to_string(loop.matches) +
         " matches agree, at least " + fixedText(100 * loop.fit, 0) +
         " % of their walls fit, other places score " + fixedText(100 * loop.second, 0) + " % of theirs";
}

}  // namespace hybrid_slam::run
