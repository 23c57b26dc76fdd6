/// @file Gnuplot.h
/// @brief Plots drawn by gnuplot (Debian package gnuplot-nox) as `<svg>` elements.
#pragma once

#include <string>
#include <vector>

namespace hybrid_slam::comparison {

/// A plot to draw.
struct Plot {
  std::string description;    ///< alternative text, and for scripts/report-figure.py
  int width = 0, height = 0;  ///< pixels
  std::string script;         ///< gnuplot commands; empty for no plot
};

/// A string literal for gnuplot.
std::string gnuplotText(const std::string& text);

/// Numbers for `plot $NAME`, a row per line; an empty row separates lines.
class DataBlock {
 public:
  explicit DataBlock(const std::string& name) : text_("$" + name + " << EOD\n") {}
  void add(const std::vector<double>& row);
  /// @returns the commands that define the block
  std::string script() const { return text_ + "EOD\n"; }

 private:
  std::string text_;
};

/// Runs gnuplot. The same plots give the same bytes for every locale and user setting.
class Gnuplot {
 public:
  /// @param program  searched in PATH if it has no slash
  explicit Gnuplot(std::string program = "gnuplot") : program_(std::move(program)) {}

  /// The plots with a script, one element after the other. Empty if there are none or gnuplot fails; after a
  /// failure it is not called again.
  std::string draw(const std::vector<Plot>& plots);

  /// Says in one line why plots are missing; empty if none are.
  const std::string& error() const { return error_; }

 private:
  std::string drawAll(const std::vector<Plot>& plots);

  std::string program_, error_;
  size_t drawn_ = 0;
};

}  // namespace hybrid_slam::comparison
