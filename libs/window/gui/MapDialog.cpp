#include "window/gui/MapDialog.h"

#include <mrpt/core/bits_math.h>
#include <wx/sizer.h>
#include <wx/stattext.h>

#include <cmath>
#include <filesystem>
#include <locale>
#include <sstream>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "window/gui/MessageDialogs.h"

namespace hybrid_slam::window {
namespace {

using Use = MapChoice::Use;

/// Returns whether a file is a floor plan, by the ending of its name as in run/PlanFiles.h.
bool isPlan(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  return ending == ".geojson" || ending == ".dxf" || ending == ".svg";
}

}  // namespace

MapDialog::MapDialog(wxWindow* parent, const MapChoice& now)
    : wxDialog(parent, wxID_ANY, "Map or floor plan") {
  auto* const column = new wxBoxSizer(wxVERTICAL);
  const auto add = [&](wxWindow* control) {
    column->Add(control, wxSizerFlags().Expand().Border(wxALL, FromDIP(8)));
  };
  add(new wxStaticText(this, wxID_ANY, "Session, map.yaml, gridmap or floor plan (.geojson, .dxf, .svg)"));
  file_ =
      new wxFilePickerCtrl(this, wxID_ANY, "", "Open map or floor plan",
                           "Maps and floor plans (*.hslam, *.yaml, *.gridmap.gz, *.geojson, *.dxf, *.svg)|"
                           "*.hslam;*.yaml;*.gridmap;*.gridmap.gz;*.geojson;*.dxf;*.svg|All files|*",
                           wxDefaultPosition, FromDIP(wxSize(460, -1)), wxFLP_OPEN | wxFLP_USE_TEXTCTRL);
  add(file_);
  const wxString uses[] = {"none: a new map", "continue mapping in it", "localise in it without changing it",
                           "begin with the lines of this floor plan"};
  use_ = new wxRadioBox(this, wxID_ANY, "Use", wxDefaultPosition, wxDefaultSize, 4, uses, 1);
  add(use_);
  file_->Bind(wxEVT_FILEPICKER_CHANGED,
              [this](wxFileDirPickerEvent&) {  // a file that is opened is to be used
                const auto use = static_cast<Use>(use_->GetSelection());
                if (isPlan(file_->GetPath().utf8_string()))
                  use_->SetSelection(static_cast<int>(Use::plan));
                else if (use == Use::none || use == Use::plan)
                  use_->SetSelection(static_cast<int>(Use::mapOn));
              });
  add(new wxStaticText(this, wxID_ANY, "Start in it: x, y (m), heading (deg); empty: searched for"));
  start_ = new wxTextCtrl(this, wxID_ANY);
  add(start_);
  column->Add(CreateButtonSizer(wxOK | wxCANCEL), wxSizerFlags().Expand().Border(wxALL, FromDIP(8)));
  SetSizerAndFit(column);
  set(now);
  file_->GetTextCtrl()->SetFocus();
  Bind(
      wxEVT_BUTTON,
      [this](wxCommandEvent& event) {
        try {
          choice();
          event.Skip();
        } catch (const std::exception& e) {
          showError(this, messageOf(e));
        }
      },
      wxID_OK);
}

void MapDialog::set(const MapChoice& map) {
  use_->SetSelection(static_cast<int>(map.use));
  file_->SetPath(wxString::FromUTF8(map.file));
  start_->ChangeValue(map.start ? numberText(map.start->x) + ", " + numberText(map.start->y) + ", " +
                                      numberText(mrpt::RAD2DEG(map.start->phi))
                                : "");
}

MapChoice MapDialog::choice() const {
  MapChoice map;
  map.use = static_cast<Use>(use_->GetSelection());
  if (map.use == Use::none) return map;
  map.file = file_->GetPath().utf8_string();
  const bool isForPlan = map.use == Use::plan;
  if (!std::filesystem::is_regular_file(map.file))
    throw InputError(
        isForPlan ? "no floor plan" : "no map", map.file.empty() ? "file name" : map.file,
        isForPlan ? "expected a .geojson, .dxf or .svg" : "expected a session.hslam, map.yaml or gridmap");
  map.start = startOf(start_->GetValue().utf8_string());
  return map;
}

std::optional<mrpt::math::TPose2D> MapDialog::startOf(const std::string& text) {
  if (text.find_first_not_of(" \t") == std::string::npos) return std::nullopt;
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double x = 0, y = 0, degrees = 0;
  char first = 0, second = 0, more = 0;
  const bool isPose =
      in >> x >> first >> y >> second >> degrees && first == ',' && second == ',' && !(in >> more);
  for (const double value : {x, y, degrees})
    if (!isPose || !(std::abs(value) <= 1e6))
      throw InputError("wrong start `" + text + "`", "the start in the map",
                       "expected x, y (m), heading (deg), or nothing: the start is searched for");
  return mrpt::math::TPose2D(x, y, mrpt::DEG2RAD(degrees));
}

}  // namespace hybrid_slam::window
