#include "bench/view/view_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bench/measure/clock.h"
#include "bench/run/frame_runner.h"
#include "bench/run/judged_run.h"
#include "bench/view/split_view.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::view {
namespace {

pictures::Image opaque(pictures::Image image) {
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

constexpr std::array<Half, 2> bothHalves{Half::a, Half::b};

ParameterValues worldValues(const ViewState& state) {
    ParameterValues values(world::worldParameters());
    for (const auto& [name, text] : state.world) values.set(name, text);
    return values;
}

bool needsHost(const ViewState& state, Half which) {
    return which == Half::a || (state.b && !showsExact(state));
}

/// The state without the parts that can change in a running world: halves, camera, size and frame.
ViewState worldAlone(ViewState state) {
    state.a = {};
    state.b.reset();
    state.cameraPath.clear();
    state.world.erase("camera");
    state.size = {};
    state.frame = 0;
    return state;
}

void aim(world::World& world, const ViewState& state) {
    if (state.cameraPath.empty())
        world.look(worldValues(state).choice("camera", world::cameraKinds));
    else
        world.followPath(state.cameraPath);
}

double milliseconds(std::int64_t ns) {
    return static_cast<double>(ns) / 1e6;
}

}  // namespace

ExactHalf::ExactHalf(gpu::Device& device, int width, int height)
    : display_(gpu::Texture::make2D(device, "ground truth", gpu::Format::rgba8, width, height)),
      scene_(gpu::Texture::make2D(device, "scene of the ground truth", gpu::Format::rgba32F, width, height)),
      layer_(gpu::Texture::make2D(device, "layer of the ground truth", gpu::Format::rgba32F, width, height)),
      depth_(gpu::Texture::make2D(device, "depth of the ground truth", gpu::Format::r32F, width, height)) {}

void ExactHalf::draw(const reference::DrawnMoment& drawn, const scene::Scene& scene, const scene::View& view,
                     const Puffs& dust, std::string whyNotEvaluated) {
    const std::int64_t start = measure::steadyNow();
    reference::ReferenceStore none;
    const reference::ExactMoment exact = reference::exactMoment(scene, view, drawn, dust, false, std::nullopt, none);
    whyNotEvaluated_ = std::move(whyNotEvaluated);
    evaluated_ = {
        {}, opaque(pictures::over(drawn.layer, drawn.scene)), opaque(pictures::over(exact.layer, drawn.scene)), {}};
    try {
        if (whyNotEvaluated_.empty()) evaluated_ = reference::comparePictures(drawn, exact);
    } catch (const InputError& error) {  // the picture contains values that are not finite
        whyNotEvaluated_ = error.what();
    }
    upload(evaluated_.reference, display_);
    upload(drawn.scene, scene_);
    upload(exact.layer, layer_);
    uploadRows(drawn.sceneDepth, depth_);
    seconds_ = static_cast<double>(measure::steadyNow() - start) / 1e9;
}

ViewSession::ViewSession(const ViewState& state, gpu::Device& device) : device_(device) {
    recorder_.setFence([&device] { device.finish(); });
    begin(normalised(state));
}

ViewState ViewSession::state() const {
    ViewState now = state_;
    now.frame = std::max(state_.frame, frame());
    return now;
}

void ViewSession::set(const ViewState& wanted) {
    const ViewState state = normalised(wanted);
    if (!state.cameraPath.empty()) (void)world::CameraPath::read(state.cameraPath);
    if (worldAlone(state) != worldAlone(state_) || state.frame < frame()) return begin(state);
    replaceHalves(state);
    aim(*world_, state);
    state_ = state;
    ++moment_;
}

void ViewSession::restart() {
    ViewState state = state_;
    state.frame = 0;
    begin(state);
}

void ViewSession::begin(const ViewState& state) {
    auto input = std::make_shared<world::DrivingInput>();
    std::unique_ptr<world::World> world = makeWorld(state, input);
    Halves halves;
    for (const Half which : bothHalves)
        if (needsHost(state, which)) halves[indexOf(which)] = makeHalf(state, which, *world);
    // Hosts refer to their world, so they are destroyed first.
    halves_ = std::move(halves);
    groundTruth_ = {};
    world_ = std::move(world);
    input_ = std::move(input);
    state_ = state;
    if (state_.drive == keyboardDrive) state_.frame = 0;
    exact_.reset();
    recording_ = {};
    ++moment_;
    next_ = -run::stepsBeforeWarmup(*world_) - state_.warmup;
    makeGroundTruth(state_);
}

std::unique_ptr<world::World> ViewSession::makeWorld(const ViewState& state,
                                                     std::shared_ptr<world::DrivingInput> input) const {
    const ParameterValues values = worldValues(state);
    auto world = state.drive == keyboardDrive
                     ? std::make_unique<world::World>(
                           state.scene, std::make_unique<world::KeyboardControls>(std::move(input)), values, state.seed)
                     : std::make_unique<world::World>(state.scene, state.drive, values, state.seed);
    world->useDust({state.dust, state.dustColumns, state.warmup, /*frames=*/0});
    aim(*world, state);
    return world;
}

ViewSession::ShownHalf ViewSession::makeHalf(const ViewState& state, Half which, const world::World& world) const {
    const MethodInfo& method = findMethod(half(state, which).method);
    if (const std::string reason = run::whyNotTaken(method, world.scene()); !reason.empty())
        throw InputError(fmt::format("method {} cannot show scene '{}': {}", method.id, state.scene, reason));
    ParameterValues values(method.parameters);
    for (const auto& [name, text] : half(state, which).parameters) values.set(name, text);
    ShownHalf shown;
    shown.host = std::make_unique<run::MethodHost>(world, device_, method, values, state.size.width, state.size.height);
    return shown;
}

void ViewSession::replaceHalves(const ViewState& state) {
    std::array<std::optional<ShownHalf>, 2> joining;
    for (const Half which : bothHalves) {
        if (!needsHost(state, which)) continue;
        const bool same = hasHost(which) && state.size == state_.size && half(state, which) == half(state_, which);
        if (!same) joining[indexOf(which)] = makeHalf(state, which, *world_);
    }
    for (const Half which : bothHalves) {
        ShownHalf& shown = halves_[indexOf(which)];
        if (!needsHost(state, which)) shown = {};
        if (!joining[indexOf(which)]) continue;
        shown = std::move(*joining[indexOf(which)]);
        shown.sinceStart = frame() < -state.warmup - run::stepsBeforeWarmup(*world_);
        if (!shown.sinceStart) updateHalf(shown);
    }
    if (!showsExact(state) || state.size != state_.size) exact_.reset();
    makeGroundTruth(state);
}

/// There is no live ground truth if A's method simulates its own dust. All methods with reliefs and lamps, which would
/// be missing, do so. Nor is there one for dust of several colours without a GPU, because it takes seconds.
void ViewSession::makeGroundTruth(const ViewState& state) {
    const bool isKnown =
        std::ranges::any_of(methods(), [](const MethodInfo& info) { return info.id == groundTruthMethod; });
    const bool isFast = world_->dust().uniformColour || !device_.isSoftware();
    const bool isShown =
        showsExact(state) && isKnown && isFast && run::whyNotEvaluated({}, host(Half::a).method()).empty();
    if (!isShown) groundTruth_ = {};
    if (!isShown || (groundTruth_.host && state.size == state_.size)) return;
    ViewState alone = state;
    alone.a = {groundTruthMethod, {}};
    groundTruth_ = makeHalf(alone, Half::a, *world_);
    if (frame() >= -state.warmup - run::stepsBeforeWarmup(*world_)) updateHalf(groundTruth_);
}

StageMs ViewSession::recordedMs() const {
    StageMs stages{};
    std::ranges::transform(recorder_.stageNs(), stages.begin(), [](std::int64_t ns) { return milliseconds(ns); });
    return stages;
}

void ViewSession::updateHalf(ShownHalf& shown) {
    recorder_.clear();
    {
        const StageClock clock(&recorder_);
        const Frame now = shown.host->see(frame(), clock);
        const auto timing = clock.measure(Stage::build);
        shown.host->update(now);
    }
    shown.cost.update = recordedMs();
}

void ViewSession::step() {
    const bool isOfDrive = world_->state().timeSeconds > -0.5 * world::stepSeconds;
    const std::int64_t start = measure::steadyNow();
    world_->step();
    worldMs_ = milliseconds(measure::steadyNow() - start);
    ++next_;
    ++moment_;
    if (state_.drive == keyboardDrive && isOfDrive) recording_.add(world_->controls());
    // As in replay(): a method is updated from the last step of the preroll on, or always if it requests that.
    for (ShownHalf& shown : halves_)
        if (shown.host && (frame() >= -state_.warmup - 1 || shown.host->method().wantsPreroll())) updateHalf(shown);
    if (groundTruth_.host && frame() >= -state_.warmup - 1) updateHalf(groundTruth_);
}

void ViewSession::draw(const results::ImageSize& size, const PictureParts& parts) {
    resizeHosts(size);
    for (const Half half : {Half::a, Half::b}) {
        ShownHalf& shown = halves_.at(indexOf(half));
        if (!shown.host) continue;
        recorder_.clear();
        drawPart(shown, parts.at(indexOf(half)), StageClock(&recorder_));
        shown.cost.draw = recordedMs();
    }
    if (groundTruth_.host) drawPart(groundTruth_, parts.at(indexOf(Half::b)), StageClock());
    noteDrawn();
    drawnParts_ = parts;
}

void ViewSession::drawPart(ShownHalf& shown, const PicturePart& part, const StageClock& clock) {
    if (part.isEmpty()) return;
    constexpr int border = 16;  // pixels: methods may look at neighbours
    const glm::ivec2 size(drawnSize_.width, drawnSize_.height);
    const glm::ivec2 from = glm::max(glm::ivec2(glm::floor(part.from * glm::vec2(size))) - border, glm::ivec2(0));
    const glm::ivec2 to = glm::min(glm::ivec2(glm::ceil(part.to * glm::vec2(size))) + border, size);
    const gpu::DrawnPart limited(size.x, size.y, from.x, from.y, to.x - from.x, to.y - from.y);
    shown.host->draw(shown.host->see(frame(), clock));
}

void ViewSession::resizeHosts(const results::ImageSize& size) {
    for (ShownHalf& shown : halves_)
        if (shown.host) shown.host->resize(size.width, size.height);
    if (groundTruth_.host) groundTruth_.host->resize(size.width, size.height);
    drawnSize_ = size;
}

void ViewSession::noteDrawn() {
    drawnMoment_ = moment_;
    drawnFrame_ = frame();
    drawnParts_ = {};
}

void ViewSession::drawExact() {
    const StageClock untimed;
    resizeHosts(state_.size);
    run::MethodHost& host = *halves_[indexOf(Half::a)].host;
    const reference::DrawnMoment drawn = host.drawn(host.see(frame(), untimed), false);
    if (!exact_) exact_ = std::make_unique<ExactHalf>(device_, state_.size.width, state_.size.height);
    exact_->draw(drawn, world_->scene(), view(), world_->unlitDust(), run::whyNotEvaluated({}, host.method()));
    exactMoment_ = moment_;
    noteDrawn();
}

bool ViewSession::isCurrent(Half half) const {
    return isExact(half) ? isEvaluated() || groundTruth_.host : hasHost(half);
}

HalfTextures ViewSession::textures(Half half) const {
    if (isExact(half) && isEvaluated()) return exact_->textures();
    const run::MethodHost& drawn = isExact(half) ? *groundTruth_.host : host(half);
    return {drawn.display(), drawn.sceneColour(), drawn.layerColour(), drawn.sceneDepth()};
}

pictures::Image ViewSession::image(Half half) const {
    if (isExact(half) && isEvaluated()) return exact_->evaluated().reference;
    pictures::Image image = (isExact(half) ? *groundTruth_.host : host(half)).picture();
    for (glm::vec4& pixel : image.pixels) pixel.a = 1;
    return image;
}

void ViewSession::volume(Half half, VolumeVisitor& visitor) {
    const StageClock untimed;
    run::MethodHost& shown = *halves_.at(indexOf(half)).host;
    shown.method().volume(shown.see(frame(), untimed), visitor);
}

ViewState ViewSession::replayOf(const std::string& file) const {
    if (state_.drive != keyboardDrive || recording_.steps() == 0)
        throw std::logic_error("ViewSession: nothing has been driven by keyboard");
    ViewState replay = state();
    replay.drive = file;
    replay.world.erase("speed");  // a drive with pedals has no target speeds that this could replace
    return replay;
}

}  // namespace dustbench::view
