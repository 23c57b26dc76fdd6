/// @file KeysTest.h
/// @brief For the tests of the window with real keys and the mouse, under a window manager.
#pragma once

#include <wx/uiaction.h>

#include "FileDrag.h"
#include "GuiTest.h"

namespace hybrid_slam {

class KeysTest : public GuiTest {
 protected:
  void SetUp() override {
    ASSERT_TRUE(test::happens([] { return test::hasWindowManager(); }));
    GuiTest::SetUp();
    ASSERT_TRUE(happens([this] { return frame->IsActive(); }));
  }
  void press(int key, int modifiers = wxMOD_NONE) {
    wxUIActionSimulator().Char(key, modifiers);
    wxYield();
  }
  /// Presses a key that opens a menu. @return whether the menu is open within a minute
  bool opensMenu(int key, int modifiers = wxMOD_NONE) {
    bool isOpen = false;
    const auto onOpen = [&](wxMenuEvent& event) {
      isOpen = true;
      event.Skip();
    };
    frame->Bind(wxEVT_MENU_OPEN, onOpen);
    press(key, modifiers);
    happens([&] { return isOpen; });
    frame->Unbind(wxEVT_MENU_OPEN, onOpen);
    return isOpen;
  }
  void pointAt(wxWindow* window, const wxPoint& place) {
    wxUIActionSimulator().MouseMove(window->ClientToScreen(place));
    wxYield();
  }
  void click(wxWindow* window) {
    const wxSize size = window->GetClientSize();
    pointAt(window, {size.x / 2, size.y / 2});
    wxUIActionSimulator().MouseClick();
    wxYield();
  }
  /// Replaces the text of a field with typed text.
  void typeInto(wxTextCtrl* field, const std::string& text) {
    click(field);
    ASSERT_TRUE(happens([&] { return wxWindow::FindFocus() == field; }));
    press('A', wxMOD_CONTROL);
    wxUIActionSimulator().Text(text.c_str());
    ASSERT_TRUE(happens([&] { return field->GetValue().utf8_string() == text; })) << field->GetValue();
  }
  /// Fills in the live page, and clicks on Connect, which gets the keyboard.
  void connectWithKeys(const std::string& server, const std::string& output) {
    std::vector<wxTextCtrl*> fields;
    for (wxWindow* control : frame->live()->GetChildren())
      if (auto* const field = dynamic_cast<wxTextCtrl*>(control)) fields.push_back(field);
    ASSERT_EQ(fields.size(), 2u);
    typeInto(fields[0], server);
    typeInto(fields[1], output);
    wxWindow* const button = frame->live()->connectButton();
    click(button);
    ASSERT_TRUE(happens([&] { return wxWindow::FindFocus() == button; }));
  }
  void openAt(size_t scan) {
    openLog();
    frame->replay()->seek(scan);
    ASSERT_TRUE(stands(State::paused, scan));
    const auto shows = [this](size_t i) {
      const auto& shown = frame->replay()->canvas(i)->shown();
      return shown && shown == now().filters.at(i);
    };
    ASSERT_TRUE(happens([&] { return shows(0) && shows(1); }));
  }
  /// Drags a file to the window and drops it there. Without the mouse: under load, GTK at times lost the
  /// press that begins a drag, or the click after it.
  void drop(const std::string& file) {
    test::FileDrag drag(file);
    ASSERT_TRUE(happens([&] { return drag.isOver(); })) << "the window takes no drops";
    EXPECT_TRUE(drag.isTaken());
  }
  bool isReady() {
    return happens([this] { return frame->GetMenuBar()->IsEnabled(window::kStep); });
  }
  /// Writes a log of 200 s, which does not end while a test waits for a key to take effect.
  std::string longLog() const { return test::writeGzipped(folder.path("long.rawlog"), test::laps(1000)); }
  void openLog() {
    frame->open(ini, log);
    ASSERT_TRUE(stands(State::paused, 0));
    ASSERT_TRUE(isReady());
  }
};

}  // namespace hybrid_slam
