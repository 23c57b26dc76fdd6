#include "window/gui/LivePage.h"

#include <wx/sizer.h>

#include "window/gui/MessageDialogs.h"
#include "window/gui/WhatIsThis.h"

namespace hybrid_slam::window {

using LiveState = LiveSnapshot::State;

namespace {

const char* nameOf(LiveState state) {
  const char* const names[] = {"running", "writing the results", "done", "failed"};
  return names[static_cast<int>(state)];
}

}  // namespace

LivePage::LivePage(wxWindow* parent) : wxPanel(parent) {
  auto* const row = new wxBoxSizer(wxHORIZONTAL);
  const auto add = [&](wxWindow* control, int share = 0) {
    row->Add(control, wxSizerFlags(share).CentreVertical().Border(wxALL, FromDIP(4)));
  };
  add(new wxStaticText(this, wxID_ANY, "server"));
  server_ = new wxTextCtrl(this, wxID_ANY, "127.0.0.1:4550", wxDefaultPosition, FromDIP(wxSize(140, -1)));
  add(server_);
  add(new wxStaticText(this, wxID_ANY, "results in"));
  output_ = new wxTextCtrl(this, wxID_ANY, "out/live");
  add(output_, 1);
  button_ = new wxButton(this, wxID_ANY, "Connect");
  button_->SetMinSize(button_->GetBestSize());  // of the longer name
  add(button_);
  text_ = new wxStaticText(this, wxID_ANY, "not connected", wxDefaultPosition, FromDIP(wxSize(170, -1)),
                           wxST_NO_AUTORESIZE);
  add(text_);
  explainWithTip(server_, "HOST:PORT of an observation-server");
  explainWithTip(output_, "Folder for the results and the recording");
  explainWithTip(button_, "Connect: begins a run. Stop: ends it and writes its results");
  explain(text_, "Scans received, and what the run does now");

  canvas_ = new MapCanvas(this, "no map yet: Connect", view_, [this] { canvas_->Refresh(false); });
  plots_ = new PlotPanel(this);
  events_ = new EventList(this, wxSize(200, 60),
                          "What happened to the connection and in the filter, the newest last");
  explain(canvas_, kPaneHelp);
  explain(plots_, kPlotsHelp);
  auto* const column = new wxBoxSizer(wxVERTICAL);
  column->Add(row, 0, wxEXPAND);
  column->Add(canvas_, 1, wxEXPAND);
  auto* const below = new wxBoxSizer(wxHORIZONTAL);
  below->Add(plots_, wxSizerFlags(5).Expand());
  below->Add(events_, wxSizerFlags(2).Expand().Border(wxRIGHT, FromDIP(4)));
  column->Add(below, wxSizerFlags().Expand().Border(wxTOP, FromDIP(2)));
  SetSizer(column);
  button_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { connectOrStop(); });
}

void LivePage::setSettings(std::shared_ptr<const Settings> settings) {
  settings_ = std::move(settings);
  if (!settings_->live.server.empty()) server_->SetValue(settings_->live.server);
}

bool LivePage::isRunning() const {
  if (!session_) return false;
  const auto state = session_->snapshot()->state;
  return state == LiveState::running || state == LiveState::finishing;
}

void LivePage::connectOrStop() {
  if (isRunning()) return session_->stop();
  orTell(this, [this] { start(); });
}

std::string LivePage::end() {
  if (!isRunning()) return {};
  session_->finish();
  const auto last = session_->snapshot();
  return last->state == LiveState::failed ? last->message : "";
}

void LivePage::start() {
  const std::string server = server_->GetValue().utf8_string();
  live::hostAndPort(server, "the live view's server");
  session_.reset();
  shown_.reset();
  // As in hybrid-slam-live, settings derived from the replayed log are not used.
  used_ = settings_->withLog(nullptr)->copy({"run.output=" + output_->GetValue().utf8_string()});
  session_ = std::make_unique<LiveSession>(used_->configuration, used_->live, server);
}

void LivePage::fit() {
  view_->fixed.reset();
  canvas_->Refresh(false);
}

void LivePage::toggle(bool Layers::*layer) {
  view_->layers.*layer = !(view_->layers.*layer);
  canvas_->Refresh(false);
}

void LivePage::refresh() {
  if (!session_) return;
  const auto now = session_->snapshot();
  if (now == shown_) return;
  const bool isNews = !shown_ || shown_->state != now->state;
  shown_ = now;
  events_->show(now->events);
  canvas_->setTitle(isRunning() ? "no map yet: waiting for scans" : "no map yet: Connect");
  canvas_->show(now->filter);
  plots_->show({now->filter});
  text_->SetLabel(now->state == LiveState::running && !now->isConnected
                      ? wxString("no connection, trying")
                      : wxString::Format("%zu scans, %s", now->scans, nameOf(now->state)));
  button_->SetLabel(isRunning() ? "Stop" : "Connect");
  if (!isNews) return;
  if (now->state == LiveState::done && onRecording_) onRecording_(now->recording);
  if (now->state == LiveState::done) showNotice(this, now->message);
  if (now->state == LiveState::failed) showError(this, now->message);
}

}  // namespace hybrid_slam::window
