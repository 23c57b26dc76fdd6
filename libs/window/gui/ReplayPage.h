/// @file ReplayPage.h
/// @brief The hybrid filter and another method side by side on the same log, with player controls.
#pragma once

#include <wx/button.h>
#include <wx/choice.h>
#include <wx/panel.h>
#include <wx/slider.h>
#include <wx/stattext.h>

#include <memory>
#include <vector>

#include "window/gui/EventList.h"
#include "window/gui/MapCanvas.h"
#include "window/gui/PlotPanel.h"
#include "window/view/ReplaySession.h"

namespace hybrid_slam::window {

/// The page of the tab *Replay*.
class ReplayPage : public wxPanel {
 public:
  explicit ReplayPage(wxWindow* parent);

  /// Starts reading configuration.run.rawlog.
  void open(const run::Configuration& configuration);
  /// Lists the warnings on an INI file, until a log is opened. Changes nothing if one is.
  void showWarnings(const std::vector<std::string>& warnings);
  /// Closes the log, after an export that is being written.
  void end() { session_.reset(); }
  /// Polls the session; call several times per second.
  void refresh();

  void playOrPause();
  void step();
  void stepBack();
  void restart();
  void seek(size_t scan);
  void faster(int steps);
  void fit();
  void toggle(bool Layers::*layer);
  void showGeneral(bool isShown);
  MapCanvas* canvas(size_t i) const { return canvases_.at(i); }
  /// Returns the newest note of the replay; empty without one.
  std::string note() const { return shown_ ? shown_->note : ""; }
  /// Returns whether a log can be played; false while it is read.
  bool hasLog() const { return shown_ && shown_->state != ReplaySnapshot::State::loading; }
  std::string speed() const { return speed_->GetStringSelection().utf8_string(); }
  /// Returns the settings that follow from the log; null without one, and until it has been read.
  std::shared_ptr<const run::LogSettings> ofLog() const { return shown_ ? shown_->ofLog : nullptr; }
  wxWindow* stepButton() const { return step_; }
  const wxSlider* slider() const { return place_; }
  const EventList* events() const { return events_; }
  ReplaySession* session() const { return session_.get(); }

 private:
  void addControls(wxSizer* to);
  void enableControls();
  void showTitles();
  void redraw();

  std::shared_ptr<SharedView> view_ = std::make_shared<SharedView>();
  std::vector<MapCanvas*> canvases_;
  PlotPanel* plots_ = nullptr;
  EventList* events_ = nullptr;
  wxButton *restart_ = nullptr, *back_ = nullptr, *play_ = nullptr, *step_ = nullptr;
  wxChoice* speed_ = nullptr;
  wxSlider* place_ = nullptr;
  wxStaticText* text_ = nullptr;
  std::unique_ptr<ReplaySession> session_;
  std::shared_ptr<const ReplaySnapshot> shown_;
  size_t told_ = 0;  ///< number of session messages shown
  bool isSliding_ = false;
};

}  // namespace hybrid_slam::window
