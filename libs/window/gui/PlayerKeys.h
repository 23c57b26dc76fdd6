/// @file PlayerKeys.h
/// @brief Keys of the replay page that a focused control would use otherwise.
#pragma once

#include <wx/event.h>

#include <optional>

#include "window/gui/MenuBar.h"

namespace hybrid_slam::window {

/// Space plays or pauses, the left and right arrows step, Ctrl with the up and down arrows changes the speed,
/// as in video players. Otherwise a button, the slider or the page's tab would take these keys.
inline std::optional<MenuCommand> playerCommand(const wxKeyEvent& key) {
  const bool isPlain = key.GetModifiers() == wxMOD_NONE, isControl = key.GetModifiers() == wxMOD_CONTROL;
  switch (key.GetKeyCode()) {
    case WXK_SPACE:
      return isPlain ? std::optional(kPlay) : std::nullopt;
    case WXK_RIGHT:
      return isPlain ? std::optional(kStep) : std::nullopt;
    case WXK_LEFT:
      return isPlain ? std::optional(kStepBack) : std::nullopt;
    case WXK_UP:
      return isControl ? std::optional(kFaster) : std::nullopt;
    case WXK_DOWN:
      return isControl ? std::optional(kSlower) : std::nullopt;
    default:
      return std::nullopt;
  }
}

}  // namespace hybrid_slam::window
