#include "window/gui/ReplayPage.h"

#include <wx/msgdlg.h>
#include <wx/sizer.h>

#include <algorithm>

#include "window/gui/MessageDialogs.h"
#include "window/gui/WhatIsThis.h"

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
  for (size_t i = 0; i < 2; ++i) {
    canvases_.push_back(new MapCanvas(this, "", view_, [this] { redraw(); }));
    panes->Add(canvases_.back(), wxSizerFlags(1).Expand().Border(wxALL, FromDIP(2)));
  }
  column->Add(panes, 1, wxEXPAND);
  plots_ = new PlotPanel(this);
  events_ =
      new EventList(this, wxSize(200, 60),
                    "The lasers used, the settings derived from the log, what is wrong with it, and what "
                    "happened in the filters, the newest last");
  auto* const below = new wxBoxSizer(wxHORIZONTAL);
  below->Add(plots_, wxSizerFlags(5).Expand());
  below->Add(events_, wxSizerFlags(2).Expand().Border(wxRIGHT, FromDIP(4)));
  column->Add(below, wxSizerFlags().Expand().Border(wxTOP, FromDIP(2)));
  addControls(column);
  SetSizer(column);
}

void ReplayPage::addControls(wxSizer* to) {
  auto* const row = new wxBoxSizer(wxHORIZONTAL);
  const auto add = [&](wxWindow* control, int share = 0) {
    row->Add(control, wxSizerFlags(share).CentreVertical().Border(wxALL, FromDIP(4)));
  };
  const auto button = [&](const char* name, const char* help) {
    auto* const made = new wxButton(this, wxID_ANY, name, wxDefaultPosition, wxDefaultSize, wxBU_EXACTFIT);
    explainWithTip(made, help);
    return made;
  };
  restart_ = button("Restart", "Back to before the first scan (F7)");
  back_ = button("Back", "One scan back (left arrow)");
  play_ = button("Pause", "Play or pause (space bar, F5)");
  play_->SetMinSize(play_->GetBestSize());  // of the longer name
  play_->SetLabel("Play");
  step_ = button("Step", "One scan forward (right arrow, F6)");
  speed_ = new wxChoice(this, wxID_ANY);
  for (const Speed& speed : kSpeeds) speed_->Append(speed.name);
  speed_->SetSelection(kUsualSpeed);
  place_ = new wxSlider(this, wxID_ANY, 0, 0, 1);
  text_ = new wxStaticText(this, wxID_ANY, "no log", wxDefaultPosition, FromDIP(wxSize(270, -1)),
                           wxST_NO_AUTORESIZE);
  explainWithTip(speed_, "Pace of the replay, as a multiple of the log's (Ctrl+Up, Ctrl+Down)");
  explainWithTip(place_, "Place in the log: drag to go to a scan (Ctrl+G)");
  for (wxWindow* control : std::initializer_list<wxWindow*>{restart_, back_, play_, step_, speed_})
    add(control);
  add(place_, 1);
  add(text_);
  to->Add(row, 0, wxEXPAND);

  restart_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { restart(); });
  back_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { stepBack(); });
  play_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { playOrPause(); });
  step_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { step(); });
  speed_->Bind(wxEVT_CHOICE, [this](wxCommandEvent&) { faster(0); });
  for (MapCanvas* canvas : canvases_) explain(canvas, kPaneHelp);
  explain(plots_, kPlotsHelp);
  explain(text_, "The scan shown, its time since the first one, and what the replay does");
  place_->Bind(wxEVT_SCROLL_THUMBTRACK, [this](wxScrollEvent&) { isSliding_ = true; });
  place_->Bind(wxEVT_SCROLL_CHANGED, [this](wxScrollEvent&) {
    isSliding_ = false;
    seek(static_cast<size_t>(place_->GetValue()));
  });
  enableControls();
  showTitles();
}

void ReplayPage::enableControls() {
  for (wxWindow* control : std::initializer_list<wxWindow*>{restart_, back_, play_, step_, speed_, place_})
    if (control->IsThisEnabled() != hasLog()) control->Enable(hasLog());
}

/// Shows what to do while there is no map.
void ReplayPage::showTitles() {
  std::string hint = "File, Open log, or drop a log here";
  if (session_) hint = "reading the log";
  if (hasLog())
    hint = shown_->state == State::failed ? "the log could not be replayed" : "press Space to play";
  canvases_[0]->setTitle("hybrid filter:\n" + hint);
  canvases_[1]->setTitle(session_ ? "second filter:\n" + hint
                                  : "general filter: the same without lines,\nor the method of -m");
}

void ReplayPage::open(const run::Configuration& configuration) {
  session_.reset();  // free the old maps before creating new ones
  told_ = 0;
  shown_.reset();
  view_->fixed.reset();
  session_ = std::make_unique<ReplaySession>(configuration, comparedMethods(configuration));
  faster(0);
  enableControls();
  showTitles();
  events_->show({});
  for (MapCanvas* canvas : canvases_) canvas->show(nullptr);
}

void ReplayPage::showWarnings(const std::vector<std::string>& warnings) {
  if (session_) return;
  std::vector<std::string> lines;
  for (const std::string& warning : warnings) lines.push_back("warning: " + warning);
  events_->show(lines);
}

void ReplayPage::refresh() {
  if (!session_) return;
  const auto now = session_->snapshot();
  if (now == shown_) return;
  shown_ = now;
  for (size_t i = 0; i < std::min(canvases_.size(), now->filters.size()); ++i)
    canvases_[i]->show(now->filters[i]);
  plots_->show(now->filters);
  events_->show(now->events);
  enableControls();
  showTitles();
  const bool isPlaying = now->state == State::playing;
  play_->SetLabel(isPlaying ? "Pause" : "Play");
  if (now->total > 0 && place_->GetMax() != static_cast<int>(now->total))
    place_->SetRange(0, static_cast<int>(now->total));
  if (!isSliding_) place_->SetValue(static_cast<int>(now->scans));
  text_->SetLabel(
      wxString::Format("scan %zu of %zu, %.1f s, %s", now->scans, now->total, now->time, nameOf(now->state)));
  if (now->messages == told_) return;
  told_ = now->messages;
  now->isError ? showError(this, now->message) : showNotice(this, now->message);
}

void ReplayPage::playOrPause() {
  if (session_) session_->playOrPause();
}

void ReplayPage::step() {
  if (session_) session_->step();
}

void ReplayPage::stepBack() {
  if (session_) session_->stepBack();
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
