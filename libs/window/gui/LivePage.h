/// @file LivePage.h
/// @brief The live page: map, plots and connection events of a run from an observation-server.
#pragma once

#include <wx/button.h>
#include <wx/panel.h>
#include <wx/stattext.h>
#include <wx/textctrl.h>

#include <functional>
#include <memory>

#include "window/gui/EventList.h"
#include "window/gui/MapCanvas.h"
#include "window/gui/PlotPanel.h"
#include "window/gui/Settings.h"
#include "window/view/LiveSession.h"

namespace hybrid_slam::window {

/// The page of the tab *Live*.
class LivePage : public wxPanel {
 public:
  explicit LivePage(wxWindow* parent);

  void setSettings(std::shared_ptr<const Settings> settings);
  /// Starts a run with the server in the text field, or ends the current run.
  void connectOrStop();
  /// Ends the current run and waits for its results. @return why it failed; empty if it did not
  std::string end();
  /// Called with the recording of each finished run.
  void setOnRecording(std::function<void(const std::string&)> action) { onRecording_ = std::move(action); }
  /// Polls the session; call several times per second.
  void refresh();
  bool isRunning() const;
  void fit();
  void toggle(bool Layers::*layer);

  void setServer(const wxString& server) { server_->SetValue(server); }
  void setOutput(const wxString& folder) { output_->SetValue(folder); }
  MapCanvas* canvas() const { return canvas_; }
  wxWindow* connectButton() const { return button_; }
  /// Returns the newest event of the run; empty without one.
  std::string note() const { return shown_ && !shown_->events.empty() ? shown_->events.back() : ""; }
  std::string state() const { return text_->GetLabel().utf8_string(); }
  LiveSession* session() const { return session_.get(); }

 private:
  void start();

  std::shared_ptr<const Settings> settings_, used_;  ///< of the next run; of the current run
  wxTextCtrl *server_, *output_;
  wxButton* button_;
  wxStaticText* text_;
  std::shared_ptr<SharedView> view_ = std::make_shared<SharedView>();
  MapCanvas* canvas_ = nullptr;
  PlotPanel* plots_;
  EventList* events_;
  std::function<void(const std::string&)> onRecording_;
  std::unique_ptr<LiveSession> session_;
  std::shared_ptr<const LiveSnapshot> shown_;
};

}  // namespace hybrid_slam::window
