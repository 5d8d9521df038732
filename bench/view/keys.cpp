#include "bench/view/keys.h"

#include <algorithm>
#include <array>

namespace dustbench::view {
namespace {

constexpr std::array bindings{
    KeyBinding{Key::up, false, Action::throttle, "Up, W", "accelerate"},
    KeyBinding{Key::w, false, Action::throttle, "", ""},
    KeyBinding{Key::down, false, Action::brake, "Down, S", "brake"},
    KeyBinding{Key::s, false, Action::brake, "", ""},
    KeyBinding{Key::left, false, Action::steerLeft, "Left, A", "steer left"},
    KeyBinding{Key::a, false, Action::steerLeft, "", ""},
    KeyBinding{Key::right, false, Action::steerRight, "Right, D", "steer right"},
    KeyBinding{Key::d, false, Action::steerRight, "", ""},
    KeyBinding{Key::space, false, Action::pause, "Space", "pause or resume"},
    KeyBinding{Key::period, false, Action::step, ".", "advance one step while paused"},
    KeyBinding{Key::comma, false, Action::slower, ",", "cycle through 1/2, 1/4, 1/8 and full speed"},
    KeyBinding{Key::space, true, Action::pauseDrawing, "Ctrl+Space",
               "pause or resume drawing while the world continues"},
    KeyBinding{Key::b, false, Action::restart, "B", "restart from the beginning"},
    KeyBinding{Key::c, false, Action::nextCamera, "C", "next camera: chase, fixed, orbit, wheel"},
    KeyBinding{Key::k, false, Action::addCameraKey, "K", "add the current view and time to the camera path"},
    KeyBinding{Key::k, true, Action::saveCameraPath, "Ctrl+K", "save the camera path"},
    KeyBinding{Key::f, false, Action::flip, "F", "hold to show B instead of A"},
    KeyBinding{Key::v, false, Action::nextShown, "V",
               "next view: A only, B only, wipe, side by side, difference, FLIP"},
    KeyBinding{Key::x, false, Action::difference, "X", "toggle the difference of A and B"},
    KeyBinding{Key::n, false, Action::nextChannel, "N",
               "next channel: picture, alpha, depth, overdraw, outlines, faults"},
    KeyBinding{Key::e, false, Action::exact, "E", "pause and compute the ground truth for B"},
    KeyBinding{Key::z, false, Action::wholePicture, "Z", "reset the zoom"},
    KeyBinding{Key::h, false, Action::panels, "H", "show or hide the panel"},
    KeyBinding{Key::tab, false, Action::walk, "Tab", "switch the arrow keys between the panel and driving"},
    KeyBinding{Key::p, false, Action::savePicture, "P",
               "save the picture without the panel, as PNG and as EXR in linear light"},
    KeyBinding{Key::o, false, Action::saveVolume, "O", "save the current volume of A for ParaView and Blender"},
    KeyBinding{Key::s, true, Action::saveState, "Ctrl+S", "save all settings as TOML"},
    KeyBinding{Key::r, false, Action::saveDrive, "R", "save the recorded driving as a drive file"},
    KeyBinding{Key::m, false, Action::measure, "M", "measure A against B in separate processes; Escape cancels"},
    KeyBinding{Key::c, true, Action::copyLine, "Ctrl+C", "copy the command that reproduces picture A"},
    KeyBinding{Key::f1, false, Action::help, "F1", "show or hide this help"},
    KeyBinding{Key::q, true, Action::quit, "Ctrl+Q", "quit"},
};

constexpr std::array padButtons{
    PadBinding{PadButton::south, Action::flip, "A (bottom)", "hold to show B instead of A"},
    PadBinding{PadButton::east, Action::nextChannel, "B (right)", "next channel"},
    PadBinding{PadButton::west, Action::difference, "X (left)", "toggle the difference of A and B"},
    PadBinding{PadButton::north, Action::nextShown, "Y (top)", "next view"},
    PadBinding{PadButton::leftBumper, Action::savePicture, "left bumper", "save the picture"},
    PadBinding{PadButton::rightBumper, Action::nextCamera, "right bumper", "next camera"},
    PadBinding{PadButton::back, Action::restart, "back", "restart from the beginning"},
    PadBinding{PadButton::start, Action::pause, "start", "pause or resume"},
};

}  // namespace

std::span<const PadBinding> padBindings() {
    return padButtons;
}

std::span<const KeyBinding> keyBindings() {
    return bindings;
}

std::optional<Action> actionOf(Key key, bool control) {
    const auto found = std::ranges::find_if(
        bindings, [&](const KeyBinding& binding) { return binding.key == key && binding.control == control; });
    return found == bindings.end() ? std::nullopt : std::optional(found->action);
}

}  // namespace dustbench::view
