/// @file DragWindow.h
/// @brief For the tests of the window: a file that the mouse drags to it.
#pragma once

#include <wx/dnd.h>
#include <wx/frame.h>
#include <wx/timer.h>
#include <wx/uiaction.h>

#include <optional>
#include <string>

namespace hybrid_slam {

/// A window from which the mouse drags a file to another, as from a file manager. The drag begins when the
/// left button is pressed in it, and ends by itself.
class DragWindow : public wxFrame {
 public:
  /// @param place  on the screen, where a window has the target
  DragWindow(wxWindow* over, const std::string& file, const wxDropTarget& target, const wxPoint& place)
      : wxFrame(over, wxID_ANY, "file", wxPoint(900, 300), wxSize(160, 160),
                wxDEFAULT_FRAME_STYLE | wxFRAME_FLOAT_ON_PARENT),
        hand_(target, place) {
    file_.AddFile(wxString::FromUTF8(file));
    Bind(wxEVT_LEFT_DOWN, [this](wxMouseEvent&) {
      constexpr int kInterval = 20;  // ms
      if (hand_.IsRunning()) return;
      hasBegun_ = true;
      hand_.Start(kInterval);
      result_ = wxDropSource(file_, this).DoDragDrop();  // runs the windows until the hand lets go
    });
    Show();
  }
  bool hasBegun() const { return hasBegun_; }
  bool isOver() const { return result_.has_value() && !hand_.IsRunning(); }
  /// Returns wxDragCopy if the file has been taken; empty while it has not been dragged.
  std::optional<wxDragResult> result() const { return result_; }

 private:
  /// Moves the mouse to the target, and lets go once it has answered.
  class Hand : public wxTimer {
   public:
    Hand(const wxDropTarget& target, const wxPoint& place) : target_(target), place_(place) {}
    void Notify() override {
      constexpr int kEnough = 500;  // else a test without an answer would not end
      if (target_.m_firstMotion && ++moves_ < kEnough)
        return (void)wxUIActionSimulator().MouseMove(place_ + wxPoint(moves_ % 2, 0));
      Stop();
      wxUIActionSimulator().MouseUp();
    }

   private:
    const wxDropTarget& target_;
    wxPoint place_;
    int moves_ = 0;
  };

  wxFileDataObject file_;
  Hand hand_;
  bool hasBegun_ = false;
  std::optional<wxDragResult> result_;
};

}  // namespace hybrid_slam
