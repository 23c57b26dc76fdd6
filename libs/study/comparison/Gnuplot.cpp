#include "study/comparison/Gnuplot.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

#include "files/TemporaryFolder.h"
#include "study/comparison/ChildProcesses.h"
#include "study/comparison/ReportText.h"

namespace hybrid_slam::comparison {
namespace {

/// A thin grey frame at the left and below, a grid, and plain text: `_` and `^` are not markup.
const char* const kStyle = R"(set border 3 linecolor rgb '#888888'
set tics nomirror out scale 0.5 textcolor rgb '#333333' format '%g'
set grid linecolor rgb '#dddddd' linetype 1
set key noenhanced
)";

std::string settings(const Plot& plot, const std::string& file) {
  return "reset\nset encoding utf8\nset terminal svg noenhanced font 'sans-serif,12' size " +
         std::to_string(plot.width) + "," + std::to_string(plot.height) + "\nset output " +
         gnuplotText(file) + "\n" + kStyle;
}

/// gnuplot's drawing as one of several elements of a page: with a description, and with unique identifiers.
std::string embedded(const std::string& file, const Plot& plot, size_t number) {
  std::ifstream in(file, std::ios::binary);
  const std::string svg(std::istreambuf_iterator<char>(in), {});
  const size_t canvas = svg.find("<g id=\"gnuplot_canvas\">"), end = svg.rfind("</svg>");
  if (canvas == std::string::npos || end == std::string::npos) throw std::runtime_error("wrote no plot");
  static const std::regex curveName("<title>gnuplot_plot_[0-9]+[a-z]*</title>");
  static const std::regex identifier("(id=['\"]|#)(gp[A-Z]|gnuplot_|textbox|greybox)");
  std::string body = std::regex_replace(svg.substr(canvas, end - canvas), curveName, "");
  body = std::regex_replace(body, identifier, "$1p" + std::to_string(number) + "-$2");
  const std::string width = std::to_string(plot.width), height = std::to_string(plot.height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
         "role=\"img\" "
         "aria-label=\"" +
         escapeXml(plot.description) + "\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " +
         width + " " + height + "\">\n" + body + "</svg>\n";
}

}  // namespace

std::string gnuplotText(const std::string& text) {
  // Single quotes make backslashes and backquotes ordinary characters.
  std::string quoted = "'";
  for (const char c : text)
    quoted += c == '\'' ? "''" : static_cast<unsigned char>(c) < 32 ? " " : std::string(1, c);
  return quoted + "'";
}

void DataBlock::add(const std::vector<double>& row) {
  for (size_t i = 0; i < row.size(); ++i) text_ += (i ? " " : "") + shortNumber(row[i], 9);
  text_ += '\n';
}

std::string Gnuplot::draw(const std::vector<Plot>& plots) {
  std::vector<Plot> shown;
  std::copy_if(plots.begin(), plots.end(), std::back_inserter(shown),
               [](const Plot& plot) { return !plot.script.empty(); });
  if (shown.empty() || !error_.empty()) return {};
  try {
    return drawAll(shown);
  } catch (const std::exception& failure) {
    error_ = program_ + ": " + failure.what();
    if (error_.find("cannot be started") != std::string::npos)
      error_ += "; expected the Debian package gnuplot-nox";
    return {};
  }
}

std::string Gnuplot::drawAll(const std::vector<Plot>& plots) {
  const files::TemporaryFolder folder;
  const auto svgOf = [&](size_t i) { return folder.path(std::to_string(i) + ".svg"); };
  std::string script;
  for (size_t i = 0; i < plots.size(); ++i) script += settings(plots[i], svgOf(i)) + plots[i].script;
  const std::string file = folder.write("plots.gp", script + "unset output\n");

  std::string error;
  // Without -d it would read the user's own settings.
  runCommands(
      {{{program_, "-d", file}, folder.path("messages.txt")}}, 1, false, [](size_t) {},
      [&error](size_t, const std::string& end) { error = end; });
  if (!error.empty()) throw std::runtime_error(error);
  std::string all;
  for (size_t i = 0; i < plots.size(); ++i) all += embedded(svgOf(i), plots[i], ++drawn_);
  return all;
}

}  // namespace hybrid_slam::comparison
