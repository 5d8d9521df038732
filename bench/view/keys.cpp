#include "bench/view/keys.h"

#include <algorithm>
#include <array>

namespace dustbench::bench {
namespace {

constexpr std::array bindings{
    KeyBinding{Key::up, false, Action::throttle, "Up, W", "accelerate"},
    KeyBinding{Key::w, false, Action::throttle, "", ""},
    KeyBinding{Key::down, false, Action::brake, "Down, S", "brake"},
    KeyBinding{Key::s, false, Action::brake, "", ""},
    KeyBinding{Key::left, false, Action::steerLeft, "Left, A", "steer to the left"},
    KeyBinding{Key::a, false, Action::steerLeft, "", ""},
    KeyBinding{Key::right, false, Action::steerRight, "Right, D", "steer to the right"},
    KeyBinding{Key::d, false, Action::steerRight, "", ""},
    KeyBinding{Key::space, false, Action::pause, "Space", "pause and go on"},
    KeyBinding{Key::period, false, Action::step, ".", "one step, while paused"},
    KeyBinding{Key::comma, false, Action::slower, ",", "slow motion: half, a quarter, an eighth, full speed"},
    KeyBinding{Key::space, true, Action::pauseDrawing, "Ctrl+Space",
               "pause drawing while the world goes on, and draw again"},
    KeyBinding{Key::b, false, Action::restart, "B", "from the beginning"},
    KeyBinding{Key::c, false, Action::nextCamera, "C", "next camera: chase, fixed, orbit, wheel"},
    KeyBinding{Key::k, false, Action::addCameraKey, "K", "key of a camera path, here and now"},
    KeyBinding{Key::k, true, Action::saveCameraPath, "Ctrl+K", "save the camera path"},
    KeyBinding{Key::f, false, Action::flip, "F", "while held: B in place of A"},
    KeyBinding{Key::v, false, Action::nextShown, "V", "only A, only B, wipe, side by side, difference, FLIP"},
    KeyBinding{Key::x, false, Action::difference, "X", "difference of A and B, and back"},
    KeyBinding{Key::n, false, Action::nextChannel, "N", "picture, alpha, depth, overdraw, outlines, faults"},
    KeyBinding{Key::e, false, Action::exact, "E", "pause, and draw the exact picture (half B)"},
    KeyBinding{Key::z, false, Action::wholePicture, "Z",
               "the whole picture, after Ctrl and the wheel have enlarged it"},
    KeyBinding{Key::h, false, Action::panels, "H", "hide the panel, and back"},
    KeyBinding{Key::tab, false, Action::walk, "Tab", "walk through the panel with the arrow keys, and back to driving"},
    KeyBinding{Key::p, false, Action::savePicture, "P",
               "save the picture, without the panel: PNG, and its light as EXR"},
    KeyBinding{Key::o, false, Action::saveVolume, "O", "save the volume of A at this moment, for ParaView and Blender"},
    KeyBinding{Key::s, true, Action::saveState, "Ctrl+S", "save all settings as TOML"},
    KeyBinding{Key::r, false, Action::saveDrive, "R", "save what was driven as a drive"},
    KeyBinding{Key::m, false, Action::measure, "M", "measure A against B in processes of their own; Escape cancels"},
    KeyBinding{Key::c, true, Action::copyLine, "Ctrl+C", "copy the command that makes picture A"},
    KeyBinding{Key::f1, false, Action::help, "F1", "this help"},
    KeyBinding{Key::q, true, Action::quit, "Ctrl+Q", "quit"},
};

constexpr std::array padButtons{
    PadBinding{PadButton::south, Action::flip, "A (below)", "while held: B in place of A"},
    PadBinding{PadButton::east, Action::nextChannel, "B (right)", "next channel"},
    PadBinding{PadButton::west, Action::difference, "X (left)", "difference of A and B, and back"},
    PadBinding{PadButton::north, Action::nextShown, "Y (above)", "next view"},
    PadBinding{PadButton::leftBumper, Action::savePicture, "left bumper", "save the picture"},
    PadBinding{PadButton::rightBumper, Action::nextCamera, "right bumper", "next camera"},
    PadBinding{PadButton::back, Action::restart, "back", "from the beginning"},
    PadBinding{PadButton::start, Action::pause, "start", "pause and go on"},
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

}  // namespace dustbench::bench
