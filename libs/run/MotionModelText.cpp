#include "run/MotionModelText.h"

#include <mrpt/core/format.h>

#include "base/Numbers.h"

namespace hybrid_slam::run {
namespace {

/// Returns a blank and the text, right-aligned in `width` characters.
std::string cell(const std::string& text, size_t width) {
  return std::string(width > text.size() ? width - text.size() + 1 : 1, ' ') + text;
}

}  // namespace

std::string motionModelSection(const MotionModelOptions& model, const std::vector<std::string>& comments) {
  std::string text;
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  text += "[motion_model]\n";
  for (const Option& option : model.table())
    text += option.key + " = " +
            numberText(parseNumber(option.get()).value(), std::chars_format::general, 6) + "  // " +
            option.unit + ": " + option.why + "\n";
  return text;
}

std::string motionModelTableHead() {
  const auto group = [](const char* name) { return mrpt::format(" | %-39s", name); };
  std::string head =
      "          log-likeli-" + group("distance (m)") + group("drift (m)") + group("turn (rad)");
  head.erase(head.find_last_not_of(' ') + 1);
  head += "\niteration hood/update";
  for (int term = 0; term < 3; ++term) head += " |  mean_d   mean_t     var_d     var_t";
  return head + "\n";
}

std::string motionModelTableRow(int iteration, double logLikelihood, const MotionModelOptions& model) {
  const auto variance = [](double value) {
    return " " + cell(numberText(value, std::chars_format::scientific, 2), 8);
  };
  std::string row = cell(std::to_string(iteration), 8) + cell(fixedText(logLikelihood, 4), 11);
  for (const MotionTerm* term : {&model.distance, &model.drift, &model.turn})
    row += " |" + cell(fixedText(term->meanD, 4), 7) + " " + cell(fixedText(term->meanT, 4), 7) +
           variance(term->varianceD) + variance(term->varianceT);
  return row + "\n";
}

}  // namespace hybrid_slam::run
