#include "window/gui/ReplayPage.h"

#include <wx/msgdlg.h>
#include <wx/sizer.h>

#include <algorithm>

#include "window/gui/Messages.h"

namespace hybrid_slam::window {
namespace {

using State = ReplaySnapshot::State;

struct Speed {
  const char* name;
  double factor;
};
constexpr Speed kSpeeds[] = {{"0.25 x", 0.25}, {"0.5 x", 0.5}, {"1 x", 1},   {"2 x", 2},
                             {"5 x", 5},       {"10 x", 10},   {"20 x", 20}, {"fastest", 0}};
constexpr int kUsualSpeed = 2;

const char* nameOf(State state) {
  const char* const names[] = {"reading the log", "paused", "playing", "at the end", "failed"};
  return names[static_cast<int>(state)];
}

}  // namespace

ReplayPage::ReplayPage(wxWindow* parent) : wxPanel(parent) {
  auto* const column = new wxBoxSizer(wxVERTICAL);
  auto* const panes = new wxBoxSizer(wxHORIZONTAL);
  for (const char* title :
       {"hybrid filter: File, Open rawlog", "general filter, the same without lines, or the method of -m"}) {
    canvases_.push_back(new MapCanvas(this, title, view_, [this] { redraw(); }));
    panes->Add(canvases_.back(), wxSizerFlags(1).Expand().Border(wxALL, FromDIP(2)));
  }
  column->Add(panes, 1, wxEXPAND);
  plots_ = new PlotPanel(this);
  column->Add(plots_, wxSizerFlags().Expand().Border(wxTOP, FromDIP(2)));
  addControls(column);
  SetSizer(column);
}

void ReplayPage::addControls(wxSizer* to) {
  auto* const row = new wxBoxSizer(wxHORIZONTAL);
  const auto add = [&](wxWindow* control, int share = 0) {
    row->Add(control, wxSizerFlags(share).CentreVertical().Border(wxALL, FromDIP(4)));
  };
  auto* const again = new wxButton(this, wxID_ANY, "Restart");
  play_ = new wxButton(this, wxID_ANY, "Play");
  auto* const one = new wxButton(this, wxID_ANY, "Step");
  speed_ = new wxChoice(this, wxID_ANY);
  for (const Speed& speed : kSpeeds) speed_->Append(speed.name);
  speed_->SetSelection(kUsualSpeed);
  place_ = new wxSlider(this, wxID_ANY, 0, 0, 1);
  text_ = new wxStaticText(this, wxID_ANY, "no log", wxDefaultPosition, FromDIP(wxSize(270, -1)),
                           wxST_NO_AUTORESIZE);
  for (wxWindow* control : std::initializer_list<wxWindow*>{again, play_, one, speed_}) add(control);
  add(place_, 1);
  add(text_);
  to->Add(row, 0, wxEXPAND);

  again->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { restart(); });
  play_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { playOrPause(); });
  one->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { step(); });
  speed_->Bind(wxEVT_CHOICE, [this](wxCommandEvent&) { faster(0); });
  place_->Bind(wxEVT_SCROLL_THUMBTRACK, [this](wxScrollEvent&) { isSliding_ = true; });
  place_->Bind(wxEVT_SCROLL_CHANGED, [this](wxScrollEvent&) {
    isSliding_ = false;
    seek(static_cast<size_t>(place_->GetValue()));
  });
}

void ReplayPage::open(const run::Configuration& configuration) {
  session_.reset();  // free the old maps before creating new ones
  told_ = 0;
  shown_.reset();
  view_->fixed.reset();
  session_ = std::make_unique<ReplaySession>(configuration, comparedMethods(configuration));
  faster(0);
}

void ReplayPage::refresh() {
  if (!session_) return;
  const auto now = session_->snapshot();
  if (now == shown_) return;
  shown_ = now;
  for (size_t i = 0; i < std::min(canvases_.size(), now->filters.size()); ++i)
    canvases_[i]->show(now->filters[i]);
  plots_->show(now->filters);
  const bool isPlaying = now->state == State::playing;
  play_->SetLabel(isPlaying ? "Pause" : "Play");
  if (now->total > 0 && place_->GetMax() != static_cast<int>(now->total))
    place_->SetRange(0, static_cast<int>(now->total));
  if (!isSliding_) place_->SetValue(static_cast<int>(now->scans));
  text_->SetLabel(
      wxString::Format("scan %zu of %zu, %.1f s, %s", now->scans, now->total, now->time, nameOf(now->state)));
  if (now->messages == told_) return;
  told_ = now->messages;
  const auto keep = now;  // the timer continues during a dialog
  keep->isError ? showError(this, keep->message) : showNotice(this, keep->message);
}

void ReplayPage::playOrPause() {
  if (!session_) return;
  session_->snapshot()->state == State::playing ? session_->pause() : session_->play();
}

void ReplayPage::step() {
  if (session_) session_->step();
}

void ReplayPage::restart() { seek(0); }

void ReplayPage::seek(size_t scan) {
  if (session_) session_->seek(scan);
}

void ReplayPage::faster(int steps) {
  const int last = static_cast<int>(speed_->GetCount()) - 1;
  speed_->SetSelection(std::clamp(speed_->GetSelection() + steps, 0, last));
  if (session_) session_->setSpeed(kSpeeds[speed_->GetSelection()].factor);
}

void ReplayPage::fit() {
  view_->fixed.reset();
  redraw();
}

void ReplayPage::toggle(bool Layers::*layer) {
  view_->layers.*layer = !(view_->layers.*layer);
  redraw();
}

void ReplayPage::showGeneral(bool isShown) {
  canvases_.at(1)->Show(isShown);
  Layout();
}

void ReplayPage::redraw() {
  for (MapCanvas* canvas : canvases_) canvas->Refresh(false);
}

}  // namespace hybrid_slam::window
