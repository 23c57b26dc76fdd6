#include "io/MotionModelText.h"

#include <cstdio>
#include <cstdlib>

namespace hybrid_slam {
namespace {

std::string textOf(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string motionModelSection(const MotionModelOptions& model, const std::vector<std::string>& comments) {
  std::string text;
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  text += "[motion_model]\n";
  for (const Option& option : model.table())
    text += option.key + " = " + textOf("%.6g", std::strtod(option.get().c_str(), nullptr)) + "  // " +
            option.unit + ": " + option.why + "\n";
  return text;
}

std::string motionModelTableHead() {
  const auto group = [](const char* name) {
    char text[64];
    std::snprintf(text, sizeof text, " | %-39s", name);
    return std::string(text);
  };
  std::string head =
      "          log-likeli-" + group("distance (m)") + group("drift (m)") + group("turn (rad)");
  head.erase(head.find_last_not_of(' ') + 1);
  head += "\niteration hood/update";
  for (int term = 0; term < 3; ++term) head += " |  mean_d   mean_t     var_d     var_t";
  return head + "\n";
}

std::string motionModelTableRow(int iteration, double logLikelihood, const MotionModelOptions& model) {
  std::string row = textOf("%9.0f", iteration) + textOf(" %11.4f", logLikelihood);
  for (const MotionTerm* term : {&model.distance, &model.drift, &model.turn})
    row += " |" + textOf(" %7.4f", term->meanD) + textOf("  %7.4f", term->meanT) +
           textOf("  %8.2e", term->varianceD) + textOf("  %8.2e", term->varianceT);
  return row + "\n";
}

}  // namespace hybrid_slam
