#include "window/gui/PlotPanel.h"

#include <mrpt/core/bits_math.h>

#include <wx/dcbuffer.h>
#include <wx/graphics.h>

#include <algorithm>
#include <cmath>

namespace hybrid_slam::window {
namespace {

struct Plot {
  double (*value)(const PlotRow&);
  double least;  ///< minimum end of the axis
};

const Plot kPlots[PlotPanel::kCount] = {{[](const PlotRow& r) { return r.stdX; }, 0.01},
                                        {[](const PlotRow& r) { return r.stdY; }, 0.01},
                                        {[](const PlotRow& r) { return mrpt::RAD2DEG(r.stdPhi); }, 0.1},
                                        {[](const PlotRow& r) { return r.ess; }, 1}};

wxColour colourOf(size_t filter) { return filter == 0 ? wxColour(0, 90, 200) : wxColour(230, 110, 0); }

/// Rounds up to 1, 2 or 5 times a power of ten.
double roundedUp(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (step * power >= value * (1 - 1e-9)) return step * power;
  return 10 * power;
}

void drawPlot(wxGraphicsContext& to, const wxRect2DDouble& area, const std::string& title, const Plot& plot,
              const std::vector<std::shared_ptr<const FilterSnapshot>>& filters) {
  double high = plot.least, end = 1;
  for (const auto& filter : filters)
    for (const PlotRow& row : filter->plot) {
      high = std::max(high, plot.value(row));
      end = std::max(end, row.time);
    }
  high = roundedUp(high);
  double width = 0, height = 0;
  to.GetTextExtent("0", &width, &height);
  to.DrawText(title, area.m_x, area.m_y);
  const double top = area.m_y + height + 3, bottom = area.m_y + area.m_height;
  to.SetBrush(*wxWHITE_BRUSH);
  to.SetPen(*wxGREY_PEN);
  to.DrawRectangle(area.m_x, top, area.m_width, bottom - top);
  for (size_t i = 0; i < filters.size(); ++i) {
    if (filters[i]->plot.size() < 2) continue;
    wxGraphicsPath curve = to.CreatePath();
    bool isFirst = true;
    for (const PlotRow& row : filters[i]->plot) {
      const double x = area.m_x + area.m_width * row.time / end;
      const double y = bottom - (bottom - top) * plot.value(row) / high;
      isFirst ? curve.MoveToPoint(x, y) : curve.AddLineToPoint(x, y);
      isFirst = false;
    }
    to.SetPen(wxPen(colourOf(i), 1));
    to.StrokePath(curve);
  }
  // The ends of the axes are inside: beside the title they would overlap in a narrow window. They hide the
  // curve.
  const auto write = [&](const wxString& text, double x, double y) {
    wxDouble w = 0, h = 0;
    to.GetTextExtent(text, &w, &h);
    to.SetPen(*wxTRANSPARENT_PEN);
    to.SetBrush(*wxWHITE_BRUSH);
    to.DrawRectangle(x, y, w, h);
    to.DrawText(text, x, y);
  };
  const wxString last = wxString::Format("%.0f s", end);
  write(wxString::Format("%g", high), area.m_x + 3, top + 1);
  to.GetTextExtent(last, &width, &height);
  write(last, area.m_x + area.m_width - width - 3, bottom - height - 1);
}

}  // namespace

PlotPanel::PlotPanel(wxWindow* parent)
    : wxPanel(parent, wxID_ANY, wxDefaultPosition, wxDefaultSize, wxFULL_REPAINT_ON_RESIZE) {
  SetBackgroundStyle(wxBG_STYLE_PAINT);
  SetMinSize(FromDIP(wxSize(-1, 130)));
  Bind(wxEVT_PAINT, &PlotPanel::onPaint, this);
}

void PlotPanel::show(const std::vector<std::shared_ptr<const FilterSnapshot>>& filters) {
  std::vector<std::shared_ptr<const FilterSnapshot>> there;
  for (const auto& filter : filters)
    if (filter) there.push_back(filter);
  if (there == filters_) return;
  filters_ = std::move(there);
  Refresh(false);
}

const std::array<std::string, PlotPanel::kCount>& PlotPanel::titles() {
  static const std::array<std::string, kCount> all{"std x (m)", "std y (m)", "std phi (deg)", "ESS"};
  return all;
}

wxRect2DDouble PlotPanel::plotArea(size_t i) const {
  const double gap = FromDIP(8);
  const wxSize size = GetClientSize();
  const double width = (namesArea().m_x - (kCount + 1) * gap) / kCount;
  return {gap + static_cast<double>(i) * (width + gap), 2, width, size.y - 6.0};
}

wxRect2DDouble PlotPanel::namesArea() const {
  const double width = FromDIP(70), top = FromDIP(24);
  const wxSize size = GetClientSize();
  return {size.x - width, top, width, size.y - top};
}

void PlotPanel::onPaint(wxPaintEvent&) {
  wxAutoBufferedPaintDC dc(this);
  dc.SetBackground(wxBrush(GetBackgroundColour()));
  dc.Clear();
  const std::unique_ptr<wxGraphicsContext> to(wxGraphicsContext::Create(dc));
  to->SetFont(GetFont(), GetForegroundColour());
  for (size_t i = 0; i < kCount; ++i) drawPlot(*to, plotArea(i), titles()[i], kPlots[i], filters_);
  const wxRect2DDouble names = namesArea();
  for (size_t i = 0; i < filters_.size(); ++i) {
    to->SetFont(GetFont(), colourOf(i));
    to->DrawText(filters_[i]->method, names.m_x, names.m_y + static_cast<double>(i) * FromDIP(20));
  }
}

}  // namespace hybrid_slam::window
