// The keys of the window and the buttons of a gamepad with their actions: tables for the input and for the help.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace dustbench::view {

/// Keys that the window or a text field reads, independent of the window system's numbers.
enum class Key {
    left,
    right,
    up,
    down,
    tab,
    home,
    end,
    erase,
    backspace,
    enter,
    escape,
    space,
    period,
    comma,
    f1,
    a,
    b,
    c,
    d,
    e,
    f,
    g,
    h,
    k,
    m,
    n,
    o,
    p,
    q,
    r,
    s,
    v,
    w,
    x,
    y,
    z,
};
inline constexpr std::size_t keyCount = static_cast<std::size_t>(Key::z) + 1;

enum class Action {
    throttle,
    brake,
    steerLeft,
    steerRight,
    pause,
    step,
    slower,
    pauseDrawing,
    restart,
    nextCamera,
    addCameraKey,
    saveCameraPath,
    flip,
    nextShown,
    difference,
    nextChannel,
    exact,
    wholePicture,
    panels,
    walk,
    help,
    savePicture,
    saveVolume,
    saveState,
    saveDrive,
    measure,
    copyLine,
    quit,
};

struct KeyBinding {
    Key key;
    bool control;  ///< together with Ctrl
    Action action;
    std::string_view name;  ///< of the key in the help
    std::string_view help;
};

/// In the order of the help. Driving and flipping last as long as the key is held.
[[nodiscard]] std::span<const KeyBinding> keyBindings();
[[nodiscard]] std::optional<Action> actionOf(Key key, bool control);

/// Buttons of a gamepad by position, as on an Xbox controller.
enum class PadButton { south, east, west, north, leftBumper, rightBumper, back, start };
inline constexpr std::size_t padButtonCount = static_cast<std::size_t>(PadButton::start) + 1;

struct PadBinding {
    PadButton button;
    Action action;
    std::string_view name, help;
};

/// As keyBindings(). Stick and triggers have no entries: they drive.
[[nodiscard]] std::span<const PadBinding> padBindings();

/// The state that a gamepad reports.
struct PadState {
    float stickRight = 0;                     ///< of the left stick, −1..1
    float rightTrigger = 0, leftTrigger = 0;  ///< 0..1
    std::array<bool, padButtonCount> buttons{};
};

}  // namespace dustbench::view
