#include "bench/view/window/view_window.h"

#define GLFW_INCLUDE_NONE
#include <dlfcn.h>
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bench/measure/clock.h"
#include "bench/view/panels/viewer_panels.h"
#include "bench/view/window/window_output.h"
#include "bench/view/window_settings.h"
#include "methods/contract/errors.h"

namespace dustbench::view {
namespace {

constexpr float fontPixels = 15;  ///< on a display of 96 dots per inch

std::string& lastProblem() {
    static std::string problem;
    return problem;
}

InputError cannotOpen() {
    return InputError("view: cannot open a window: " + (lastProblem().empty() ? "no reason given" : lastProblem()) +
                      "; --picture FILE draws one frame without a window");
}

#ifdef DUSTBENCH_PORTABLE
/// The portable program is not linked with GLFW, which needs the host's X11 libraries; the other commands run without
/// them. Its calls of GLFW find the library once it is loaded.
void loadGlfw() {
    if (!dlopen("libglfw.so.3", RTLD_LAZY | RTLD_GLOBAL))
        throw InputError(std::string("view: a library is missing on this machine: ") + dlerror());
}
#else
void loadGlfw() {}
#endif

/// Initialises GLFW's library, and ends it on destruction.
class Library {
 public:
    Library() {
        loadGlfw();
        glfwSetErrorCallback([](int, const char* text) { lastProblem() = text; });
#ifdef GLFW_PLATFORM  // 3.4 or newer: it asks Wayland first, whose library prints a line of its own without this
                      // variable
        if (!std::getenv("XDG_RUNTIME_DIR")) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
        if (glfwInit() != GLFW_TRUE) throw cannotOpen();
    }
    ~Library() {
        glfwTerminate();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
};

const std::map<int, Key>& keysOfGlfw() {
    static const std::map<int, Key> keys{
        {GLFW_KEY_LEFT, Key::left},     {GLFW_KEY_RIGHT, Key::right},   {GLFW_KEY_UP, Key::up},
        {GLFW_KEY_DOWN, Key::down},     {GLFW_KEY_TAB, Key::tab},       {GLFW_KEY_HOME, Key::home},
        {GLFW_KEY_END, Key::end},       {GLFW_KEY_DELETE, Key::erase},  {GLFW_KEY_BACKSPACE, Key::backspace},
        {GLFW_KEY_ENTER, Key::enter},   {GLFW_KEY_ESCAPE, Key::escape}, {GLFW_KEY_SPACE, Key::space},
        {GLFW_KEY_PERIOD, Key::period}, {GLFW_KEY_COMMA, Key::comma},   {GLFW_KEY_F1, Key::f1},
        {GLFW_KEY_A, Key::a},           {GLFW_KEY_B, Key::b},           {GLFW_KEY_C, Key::c},
        {GLFW_KEY_D, Key::d},           {GLFW_KEY_E, Key::e},           {GLFW_KEY_F, Key::f},
        {GLFW_KEY_G, Key::g},           {GLFW_KEY_H, Key::h},           {GLFW_KEY_K, Key::k},
        {GLFW_KEY_M, Key::m},           {GLFW_KEY_N, Key::n},           {GLFW_KEY_O, Key::o},
        {GLFW_KEY_P, Key::p},           {GLFW_KEY_Q, Key::q},           {GLFW_KEY_R, Key::r},
        {GLFW_KEY_S, Key::s},           {GLFW_KEY_V, Key::v},           {GLFW_KEY_W, Key::w},
        {GLFW_KEY_X, Key::x},           {GLFW_KEY_Y, Key::y},           {GLFW_KEY_Z, Key::z}};
    return keys;
}

struct KeyEvent {
    Key key;
    bool pressed, control;
};

/// Events that GLFW has reported since the last frame.
struct Reported {
    PanelInput input;
    std::vector<KeyEvent> keys;
    std::vector<std::string> dropped;  ///< files
    bool gotFocus = true;
};

Reported& reportedOf(GLFWwindow* window) {
    return *static_cast<Reported*>(glfwGetWindowUserPointer(window));
}

void onKey(GLFWwindow* window, int code, int, int action, int modifiers) {
    const auto key = keysOfGlfw().find(code);
    Reported& reported = reportedOf(window);
    reported.input.control = (modifiers & GLFW_MOD_CONTROL) != 0;
    reported.input.shift = (modifiers & GLFW_MOD_SHIFT) != 0;
    if (key == keysOfGlfw().end() || action == GLFW_REPEAT) return;
    reported.input.keys.at(static_cast<std::size_t>(key->second)) = action == GLFW_PRESS;
    reported.keys.push_back({key->second, action == GLFW_PRESS, reported.input.control});
}

/// UTF-8 of a code point.
std::string utf8(unsigned int point) {
    const auto tail = [point](int shift) { return static_cast<char>(0x80 | ((point >> shift) & 0x3f)); };
    if (point < 0x80) return {static_cast<char>(point)};
    if (point < 0x800) return {static_cast<char>(0xc0 | (point >> 6)), tail(0)};
    if (point < 0x10000) return {static_cast<char>(0xe0 | (point >> 12)), tail(6), tail(0)};
    return {static_cast<char>(0xf0 | (point >> 18)), tail(12), tail(6), tail(0)};
}

void listen(GLFWwindow* window) {
    glfwSetInputMode(window, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);  // a click may be shorter than a frame
    glfwSetKeyCallback(window, onKey);
    glfwSetCharCallback(window, [](GLFWwindow* to, unsigned int point) { reportedOf(to).input.text += utf8(point); });
    glfwSetScrollCallback(
        window, [](GLFWwindow* to, double, double up) { reportedOf(to).input.wheel += static_cast<float>(up); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* to, int has) { reportedOf(to).gotFocus |= has == GLFW_TRUE; });
    glfwSetDropCallback(window, [](GLFWwindow* to, int count, const char** paths) {
        reportedOf(to).dropped.insert(reportedOf(to).dropped.end(), paths, paths + count);
    });
}

void readMouse(GLFWwindow* window, PanelInput& input) {
    double x = 0, y = 0;
    int width = 0, height = 0, pixels = 0, rows = 0;
    glfwGetCursorPos(window, &x, &y);
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixels, &rows);
    const bool isInside = x >= 0 && y >= 0 && x < width && y < height;
    input.mouse = isInside ? glm::vec2(x * pixels / width, y * rows / height) : glm::vec2(-1);
    for (int button = 0; button < 3; ++button)
        input.buttons[static_cast<std::size_t>(button)] = glfwGetMouseButton(window, button) == GLFW_PRESS;
}

/// State of the first connected gamepad.
PadState readPad() {
    PadState pad;
    GLFWgamepadstate state;
    int id = GLFW_JOYSTICK_1;
    while (id <= GLFW_JOYSTICK_LAST && glfwGetGamepadState(id, &state) == GLFW_FALSE) ++id;
    if (id > GLFW_JOYSTICK_LAST) return pad;
    // Triggers rest at −1.
    const auto trigger = [&](int axis) { return 0.5f * (state.axes[axis] + 1); };
    pad.stickRight = state.axes[GLFW_GAMEPAD_AXIS_LEFT_X];
    pad.rightTrigger = trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER);
    pad.leftTrigger = trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER);
    constexpr std::array buttons{GLFW_GAMEPAD_BUTTON_A,           GLFW_GAMEPAD_BUTTON_B,
                                 GLFW_GAMEPAD_BUTTON_X,           GLFW_GAMEPAD_BUTTON_Y,
                                 GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER,
                                 GLFW_GAMEPAD_BUTTON_BACK,        GLFW_GAMEPAD_BUTTON_START};
    static_assert(buttons.size() == padButtonCount);
    for (std::size_t i = 0; i < buttons.size(); ++i) pad.buttons[i] = state.buttons[buttons[i]] == GLFW_PRESS;
    return pad;
}

/// A call, unlike the function's address, needs GLFW only when it is made (loadGlfw).
struct DestroyWindow {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowOwner = std::unique_ptr<GLFWwindow, DestroyWindow>;

WindowOwner createWindow(const results::ImageSize& size) {
    return WindowOwner(glfwCreateWindow(size.width, size.height, "dustbench view", nullptr, nullptr));
}

/// Creates a window whose context reports its loss, if the driver supports that.
WindowOwner openWindow(const results::ImageSize& size) {
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    WindowOwner window = createWindow(size);
    if (!window) {
        glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_NO_ROBUSTNESS);
        window = createWindow(size);
    }
    if (!window) throw cannotOpen();
    glfwMakeContextCurrent(window.get());
    glfwSwapInterval(1);
    return window;
}

/// The window's main loop.
class Loop {
 public:
    Loop(GLFWwindow* window, const ViewState& state, const std::filesystem::path& folder,
         const run::ExecutionOptions& execution, SettingsKeeper& settings)
        : window_(window),
          isInterrupted_(execution.interrupted),
          settings_(settings),
          output_(window),
          viewer_(state, output_.device(), folder),
          panels_(output_.device(), fontPixels * contentScale()),
          target_(output_.device()) {
        useSettings();
        glfwSetWindowUserPointer(window, &reported_);
        listen(window);
        viewer_.setMeasurement(
            {execution, [this](const std::string&) { showProgress(); }, [this] { return cancels(); }});
    }

    void run() {
        while (glfwWindowShouldClose(window_) == GLFW_FALSE && !viewer_.wantsToQuit() &&
               !(isInterrupted_ && isInterrupted_())) {
            glfwPollEvents();
            useInput();
            if (makeTarget())
                frame();
            else
                glfwWaitEventsTimeout(0.1);  // minimised
            keepSettings();
        }
        keepAtEnd();
    }

 private:
    [[nodiscard]] float contentScale() const {
        float x = 1, y = 1;
        glfwGetWindowContentScale(window_, &x, &y);
        return y;
    }
    void useInput() {
        for (const KeyEvent& event : std::exchange(reported_.keys, {})) {
            if (!event.pressed)
                viewer_.release(event.key);
            else if (event.key == Key::tab || !panels_.takesKeyboard())
                viewer_.press(event.key, event.control);
        }
        for (const std::string& file : std::exchange(reported_.dropped, {})) viewer_.applyFile(file);
        if (std::exchange(reported_.gotFocus, false))
            if (const char* text = glfwGetClipboardString(window_)) panels_.canvas().setClipboard(text);
        readMouse(window_, reported_.input);
        viewer_.usePad(readPad());
    }
    /// The window's size as it must be requested: where GLFW counts sizes in pixels, it multiplies a requested size by
    /// the display's scale.
    [[nodiscard]] results::ImageSize unscaledSize() const {
        int width = 0, height = 0, pixels = 0, rows = 0;
        glfwGetWindowSize(window_, &width, &height);
        glfwGetFramebufferSize(window_, &pixels, &rows);
        const float scale = pixels == width ? contentScale() : 1;
        const auto unscaled = [scale](int size) {
            return static_cast<int>(std::lround(static_cast<float>(size) / scale));
        };
        return {unscaled(width), unscaled(height)};
    }
    void useSettings() {
        const WindowSettings& read = settings_.read();
        viewer_.keepsPace = read.keepsPace;
        viewer_.showsPanels = read.showsPanels;
        viewer_.split.divider = read.divider;
        if (viewer_.session().has(Half::b)) viewer_.split.shown = read.shown;
        panels_.setTextScale(read.textScale);
        if (!settings_.problem().empty()) viewer_.say(settings_.problem());
    }
    void keepSettings() {
        WindowSettings now = settings_.read();
        if (const results::ImageSize size = unscaledSize(); size.width > 0 && size.height > 0) now.size = size;
        now.keepsPace = viewer_.keepsPace;
        now.showsPanels = viewer_.showsPanels;
        now.divider = viewer_.split.divider;
        if (viewer_.session().has(Half::b)) now.shown = viewer_.split.shown;
        now.textScale = panels_.textScale();
        try {
            settings_.keep(now);
        } catch (const std::runtime_error& error) {
            viewer_.say(error.what());
        }
    }
    /// Errors are ignored: the window is closed, and its appearance is not a result.
    void keepAtEnd() {
        try {
            settings_.finish();
        } catch (const std::runtime_error&) {
        }
    }
    /// False if the window has no area.
    bool makeTarget() {
        int width = 0, height = 0;
        glfwGetFramebufferSize(window_, &width, &height);
        return target_.fit(width, height);
    }
    void frame() {
        const std::int64_t now = measure::steadyNow();
        reported_.input.seconds = before_ == 0 ? 1.0 / 60 : std::max(1e-6, static_cast<double>(now - before_) / 1e9);
        before_ = now;
        viewer_.advance();
        if (const auto paced = viewer_.takePaced()) pace_.note(*paced);
        viewer_.drawShare = pace_.share();
        viewer_.drawsOnlyShown = pace_.drawsOnlyShown();
        const std::string clipboard = panels_.canvas().clipboard();
        showPanels(reported_.input);
        if (panels_.canvas().clipboard() != clipboard)
            glfwSetClipboardString(window_, panels_.canvas().clipboard().c_str());
        reported_.input.text.clear();
        reported_.input.wheel = 0;
    }
    void showPanels(const PanelInput& input) {
        panels_.draw(viewer_, target_.framebuffer(), target_.texture().width(), target_.texture().height(), input);
        output_.show(target_);
    }
    /// Draws between two runs of a measurement, without input.
    void showProgress() {
        if (makeTarget()) showPanels({});
    }
    /// Called while a run may be timed.
    bool cancels() {
        glfwPollEvents();
        const auto isEscape = [](const KeyEvent& event) { return event.pressed && event.key == Key::escape; };
        const bool cancelled = std::ranges::any_of(reported_.keys, isEscape);
        std::erase_if(reported_.keys, [](const KeyEvent& event) { return event.pressed; });
        return cancelled || glfwWindowShouldClose(window_) == GLFW_TRUE;
    }

    GLFWwindow* window_;
    std::function<bool()> isInterrupted_;
    SettingsKeeper& settings_;
    WindowOutput output_;
    Viewer viewer_;
    ViewerPanels panels_;
    PanelTarget target_;
    DrawPace pace_;
    Reported reported_;
    std::int64_t before_ = 0;
};

}  // namespace

void showWindow(const ViewState& state, const std::filesystem::path& folder, const run::ExecutionOptions& execution) {
    const Library library;
    SettingsKeeper settings(windowSettingsFile());
    const WindowOwner window = openWindow(settings.read().size);
    Loop(window.get(), state, folder, execution, settings).run();
}

}  // namespace dustbench::view
