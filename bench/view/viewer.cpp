#include "bench/view/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/measure/clock.h"
#include "bench/results/shell_words.h"
#include "bench/view/free_camera.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/gpu/egl_context.h"

namespace dustbench::view {
namespace {

constexpr double turnPerHeight = 3;  ///< radians for a drag over the picture's height
constexpr float stickPlay = 0.08f;   ///< of a gamepad's stick at rest

std::string nextCamera(const ViewState& state) {
    const std::vector<std::string> words = world::cameraKinds.words();
    if (!state.cameraPath.empty()) return words.front();
    const auto given = state.world.find("camera");
    const auto now = std::ranges::find(words, given == state.world.end() ? words.front() : given->second);
    return now + 1 < words.end() ? *(now + 1) : words.front();
}

/// The next element of a table, cyclically.
template <typename Enumeration>
Enumeration after(const Choices<Enumeration>& choices, Enumeration value) {
    const auto all = choices.all();
    const auto now = std::ranges::find(all, value, &Choice<Enumeration>::value);
    return now + 1 < all.end() ? (now + 1)->value : all.front().value;
}

}  // namespace

Viewer::Viewer(const ViewState& state, gpu::Device& device, std::filesystem::path folder)
    : device_(device),
      folder_(std::move(folder)),
      session_(state, device),
      splitView_(device),
      maps_(device),
      pixel_(gpu::Texture::make2D(device, "pixel", gpu::Format::rgba32F, 1, 1)),
      pixelTarget_(device, "pixel", &pixel_, nullptr),
      isLost_(gpu::isContextLost) {
    if (!session_.has(Half::b)) split.shown = Shown::a;
    makeImage(split.shown);
}

void Viewer::press(Key key, bool control) {
    held_.at(static_cast<std::size_t>(key)) = !control;
    if (const auto action = actionOf(key, control)) act(*action);
    drive();
}

void Viewer::release(Key key) {
    held_.at(static_cast<std::size_t>(key)) = false;
    drive();
}

void Viewer::usePad(const PadState& pad) {
    const PadState before = std::exchange(pad_, pad);
    for (const PadBinding& binding : padBindings()) {
        const auto button = static_cast<std::size_t>(binding.button);
        if (pad.buttons.at(button) && !before.buttons.at(button)) act(binding.action);
    }
    drive();
}

bool Viewer::holds(Action action) const {
    return std::ranges::any_of(keyBindings(),
                               [&](const KeyBinding& binding) {
                                   return binding.action == action && held_.at(static_cast<std::size_t>(binding.key));
                               }) ||
           std::ranges::any_of(padBindings(), [&](const PadBinding& binding) {
               return binding.action == action && pad_.buttons.at(static_cast<std::size_t>(binding.button));
           });
}

/// For each control, keys or gamepad count, whichever is pressed further; keys override the stick.
void Viewer::drive() {
    const auto pressed = [](float value) {
        return std::isfinite(value) && std::abs(value) > stickPlay ? std::clamp(static_cast<double>(value), -1.0, 1.0)
                                                                   : 0.0;
    };
    const double left = -pressed(pad_.stickRight);
    const double keys = (holds(Action::steerLeft) ? 1.0 : 0.0) - (holds(Action::steerRight) ? 1.0 : 0.0);
    session_.input() = {holds(Action::throttle) ? 1.0 : std::max(pressed(pad_.rightTrigger), 0.0),
                        holds(Action::brake) ? 1.0 : std::max(pressed(pad_.leftTrigger), 0.0), keys != 0 ? keys : left};
}

void Viewer::attempt(const std::function<void()>& work) {
    try {
        work();
    } catch (const SimulationError& error) {
        message_ = error.what();
        paused = true;
    } catch (const std::exception& error) {
        message_ = error.what();
    }
}

void Viewer::act(Action action) {
    attempt([&] { perform(action); });
}

void Viewer::perform(Action action) {
    switch (action) {
        case Action::throttle:
        case Action::brake:
        case Action::steerLeft:
        case Action::steerRight:
        case Action::flip:
            break;  // they act as long as they are held
        case Action::pause:
            paused = !paused;
            break;
        case Action::step:
            if (paused) session_.step();
            break;
        case Action::slower:
            slowness = slowness == slownesses.back() ? slownesses.front() : 2 * slowness;
            break;
        case Action::pauseDrawing:
            drawingPaused = !drawingPaused;
            break;
        case Action::restart:
            session_.restart();
            mustDraw_ = true;
            drive();
            break;
        case Action::nextCamera: {
            ViewState state = session_.state();
            state.world["camera"] = nextCamera(state);
            state.cameraPath.clear();
            apply(state);
            break;
        }
        case Action::addCameraKey:
            std::erase_if(cameraKeys_, [now = std::max(session_.world().state().timeSeconds, 0.0)](
                                           const world::CameraKey& key) { return key.seconds >= now; });
            cameraKeys_.push_back(keyOf(session_.world().view(1, 1).camera, session_.world().state().timeSeconds));
            message_ = fmt::format("camera path: {} keys", cameraKeys_.size());
            break;
        case Action::saveCameraPath:
            if (cameraKeys_.empty())
                message_ = "camera path: no keys; press K to add one";
            else
                save("camera_path.csv", world::CameraPath(cameraKeys_).csv());
            break;
        case Action::difference:
            if (session_.has(Half::b)) split.shown = split.shown == Shown::difference ? Shown::wipe : Shown::difference;
            break;
        case Action::nextShown:
            if (session_.has(Half::b)) split.shown = after(shownChoices, split.shown);
            break;
        case Action::nextChannel:
            split.channel = after(channelChoices, split.channel);
            break;
        case Action::exact:
            if (!session_.isExact(Half::b)) {
                message_ = "ground truth: choose 'exact' as B";
                break;
            }
            paused = exactAsked_ = true;
            break;
        case Action::wholePicture:
            split.origin = {0, 0};
            split.extent = {1, 1};
            break;
        case Action::panels:
            showsPanels = !showsPanels;
            break;
        case Action::walk:
            walksPanel = !walksPanel;
            held_ = {};
            break;
        case Action::help:
            showsHelp = !showsHelp;
            break;
        case Action::savePicture:
            savePicture();
            break;
        case Action::saveVolume:
            saveVolume();
            break;
        case Action::saveState:
            save("state.toml", toToml(session_.state()));
            break;
        case Action::saveDrive:
            if (session_.recordedSteps() == 0)
                message_ = "drive: nothing was recorded; set the drive to 'keyboard' and drive";
            else
                save("drive.csv", session_.recordedDrive());
            break;
        case Action::measure:
            measureAsked_ = true;
            break;
        case Action::copyLine:
            copied_ = line(Half::a);
            message_ = "copied: " + copied_;
            break;
        case Action::quit:
            quit_ = true;
            break;
    }
}

void Viewer::apply(const ViewState& state) {
    attempt([&] {
        session_.set(state);
        mustDraw_ = true;
        message_.clear();
        if (!session_.has(Half::b)) split.shown = Shown::a;
    });
}

void Viewer::applyText(const std::string& text) {
    attempt([&] {
        const std::vector<std::string> words = results::shellWords(text.substr(0, text.find('\n')));
        const bool isLine = words.size() > 1 && (words[0] == "run" || words[1] == "run");
        ViewState state = isLine ? stateOfCommandLine(text) : stateOfToml(text, "pasted text");
        if (isLine) state.b = session_.state().b;
        apply(state);
    });
}

void Viewer::applyFile(const std::filesystem::path& file) {
    attempt([&] { applyText(files::wholeText(file, "a TOML file or a command")); });
}

void Viewer::advance(double secondsForPreroll) {
    try {
        makeFrame(secondsForPreroll);
    } catch (const std::exception&) {
        requireContext();  // other errors that its loss causes would be misleading
        throw;
    }
    requireContext();
}

void Viewer::requireContext() const {
    if (isLost_())
        throw InputError(
            "view: the OpenGL context is lost, because the GPU or its driver was reset; start the window again");
}

void Viewer::makeFrame(double secondsForPreroll) {
    if (std::exchange(measureAsked_, false)) attempt([&] { measureShown(); });
    const std::int64_t start = measure::steadyNow();
    paced_.reset();
    if (isCosted_) {
        FrameCost& cost = costs_.back();
        const double wholeMs = static_cast<double>(start - frameStart_) / 1e6;
        cost.window = wholeMs - cost.methodsMs();
        const PictureParts parts = shownParts(composed_);
        if (wasPaced_ && session_.drawnSize() == shareOf(session_.state().size, drawShare) &&
            session_.drawnParts() == (drawsOnlyShown ? parts : PictureParts{}))
            paced_ =
                PacedFrame{wholeMs, sum(cost.halves[0].draw) + sum(cost.halves[1].draw),
                           session_.hasHost(Half::b) ? 0.5 * (parts[0].area() + parts[1].area()) : parts[0].area()};
    }
    frameStart_ = start;
    const bool isPreroll = session_.stepsToGo() > 0;
    const std::int64_t before = session_.frame();
    attempt([&] { goOn(secondsForPreroll); });
    const bool wasDrawn = draw();
    wasPaced_ = wasDrawn && isPaced();
    isCosted_ = !isPreroll;
    if (isCosted_) noteCost(session_.frame() > before, wasDrawn);
}

/// Meanwhile only the progress is drawn, between two runs.
void Viewer::measureShown() {
    if (!measurement_) throw InputError("measure: this program cannot start runs");
    const suite::Suite suite = measurementOf(session_.state());
    isCosted_ = false;  // the window's share would include the measurement
    device_.finish();
    MeasurementHooks hooks = *measurement_;
    hooks.between = [this](const std::string& progress) {
        message_ = progress;
        if (measurement_->between) measurement_->between(progress);
    };
    measured_ = measure(suite, folder_ / "measured", hooks);
    message_.clear();
}

void Viewer::noteCost(bool wasStepped, bool wasDrawn) {
    FrameCost cost;
    if (wasStepped) cost.world = session_.worldMs();
    for (const Half half : {Half::a, Half::b}) {
        if (!session_.hasHost(half)) continue;
        HalfCost& ofHalf = cost.halves.at(half == Half::a ? 0 : 1);
        ofHalf = session_.cost(half);
        if (!wasStepped) ofHalf.update = {};
        if (!wasDrawn) ofHalf.draw = {};
    }
    if (costs_.size() == keptFrames) costs_.erase(costs_.begin());
    costs_.push_back(cost);
}

void Viewer::goOn(double secondsForPreroll) {
    const std::int64_t start = measure::steadyNow();
    const auto isEarly = [&] { return static_cast<double>(measure::steadyNow() - start) < 1e9 * secondsForPreroll; };
    if (session_.stepsToGo() > 0)
        while (session_.stepsToGo() > 0 && isEarly()) session_.step();
    else if (!paused && ++framesSinceStep_ >= slowness) {
        framesSinceStep_ = 0;
        session_.step();
    }
}

template <typename Move>
void Viewer::moveCamera(const Move& move) {
    ViewState state = session_.state();
    const world::CameraKey key = move(keyOf(session_.world().view(1, 1).camera, 0));
    state.cameraPath = world::CameraPath({key}).rows();
    apply(state);
}

void Viewer::turnCamera(double right, double up) {
    moveCamera([&](const world::CameraKey& key) { return turned(key, -turnPerHeight * right, -turnPerHeight * up); });
}

void Viewer::shiftCamera(double right, double up) {
    moveCamera([&](const world::CameraKey& key) {
        // Objects at the target's distance follow the mouse.
        const double height =
            2 * glm::distance(key.eye, key.target) * std::tan(glm::radians(key.fieldOfViewDegrees) / 2);
        return shifted(key, -height * right, -height * up);
    });
}

void Viewer::dollyCamera(double factor) {
    moveCamera([&](const world::CameraKey& key) { return dollied(key, factor); });
}

}  // namespace dustbench::view
