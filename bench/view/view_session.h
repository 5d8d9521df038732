// One world, stepped once a frame and drawn by up to two methods, or by one method next to the ground truth.
//
// Each method has the host of a run, with its own targets and its own ledger, and gets the same updates as in a run.
// Owns: world and hosts. Threads: the device's, inside the oneTBB arena to be used; the caller applies
// `ViewState::threads`.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "bench/measure/clock.h"
#include "bench/reference/judge/judgement.h"
#include "bench/run/method_host.h"
#include "bench/view/split_view.h"
#include "bench/view/view_state.h"
#include "bench/world/control_source.h"
#include "bench/world/world.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::view {

/// The ground truth of one moment as textures, and the metrics of a method compared with it. bench/reference draws it,
/// as for the metrics of a run (bench/reference/judge). That takes from a few milliseconds to seconds.
class ExactHalf {
 public:
    ExactHalf(gpu::Device& device, int width, int height);

    /// Draws the dust, given in its colours without light, in front of the method's scene and compares the method's
    /// picture with it. `whyNotEvaluated`: why metrics would be meaningless; if empty, they are computed.
    void draw(const reference::DrawnMoment& drawn, const scene::Scene& scene, const scene::View& view,
              const Puffs& dust, std::string whyNotEvaluated);

    [[nodiscard]] HalfTextures textures() const { return {display_, scene_, layer_, depth_}; }
    /// The ground truth and the method's picture: linear light, opaque.
    [[nodiscard]] const reference::EvaluatedMoment& evaluated() const { return evaluated_; }
    /// Why `evaluated` has no metrics; empty if it has.
    [[nodiscard]] const std::string& whyNotEvaluated() const { return whyNotEvaluated_; }
    /// Duration of the last draw(), including metrics.
    [[nodiscard]] double seconds() const { return seconds_; }

 private:
    gpu::Texture display_, scene_, layer_, depth_;
    reference::EvaluatedMoment evaluated_;
    std::string whyNotEvaluated_;
    double seconds_ = 0;
};

/// Milliseconds by stage (methods/contract/stage_clock.h). Each stage ends with a wait for the GPU, so that it includes
/// the work that it queued.
using StageMs = std::array<double, stageNames.size()>;
[[nodiscard]] inline double sum(const StageMs& stages) {
    return std::accumulate(stages.begin(), stages.end(), 0.0);
}

/// Costs of a half's last step and last picture.
struct HalfCost {
    StageMs update{}, draw{};
    [[nodiscard]] double totalMs() const { return sum(update) + sum(draw); }
};

class ViewSession {
 public:
    /// Starts at the beginning of the preroll. Throws InputError for a state that cannot be shown. `device` must
    /// outlive the session.
    ViewSession(const ViewState& state, gpu::Device& device);

    /// The state with the current frame, or the later one that the session is stepping to.
    [[nodiscard]] ViewState state() const;
    /// Changes as little as possible: a new half or camera joins the running world; any other change of the world
    /// restarts it. Throws InputError and changes nothing if the state cannot be shown.
    void set(const ViewState& state);
    /// Starts again at the beginning of the preroll, up to frame 0.
    void restart();

    /// Steps the world and updates every half as a run would.
    void step();
    /// Frame of the last step, as in a run: warm-up and preroll are below 0.
    [[nodiscard]] std::int64_t frame() const { return next_ - 1; }
    /// Number of steps to the frame of the state that was set.
    [[nodiscard]] std::int64_t stepsToGo() const { return std::max<std::int64_t>(state_.frame - frame(), 0); }

    /// Draws every method at the state's size or at `size`. The pictures are valid until the next call or set().
    /// Outside of `parts` their pixels are undefined; a half with an empty part is not drawn.
    void draw() { draw(state_.size); }
    void draw(const results::ImageSize& size, const PictureParts& parts = {});
    /// Size and parts of the last draw().
    [[nodiscard]] results::ImageSize drawnSize() const { return drawnSize_; }
    [[nodiscard]] const PictureParts& drawnParts() const { return drawnParts_; }
    /// Draws the ground truth of the world's current state, and the methods, at the state's size. Half B must be the
    /// ground truth.
    void drawExact();
    /// Identifies the last draw: a different number means another state of the world, a method or the camera.
    [[nodiscard]] std::int64_t drawnMoment() const { return drawnMoment_; }
    [[nodiscard]] std::int64_t drawnFrame() const { return drawnFrame_; }
    /// The half shows the moment that was drawn last: false for the ground truth of an earlier one, or none.
    [[nodiscard]] bool isCurrent(Half half) const;
    /// Half B is the ground truth of the moment that was drawn last, with metrics. Half B may be current without that,
    /// if `groundTruthMethod` has drawn it.
    [[nodiscard]] bool isEvaluated() const { return exact_ && exactMoment_ == drawnMoment_; }
    /// The world or the state has changed since the last draw.
    [[nodiscard]] bool isBehind() const { return drawnMoment_ != moment_; }

    /// The textures that a half has drawn; it must be current.
    [[nodiscard]] HalfTextures textures(Half half) const;
    [[nodiscard]] const gpu::Texture& picture(Half half) const { return textures(half).display; }
    /// The picture in linear light, opaque, at the size at which it was drawn.
    [[nodiscard]] pictures::Image image(Half half) const;

    [[nodiscard]] const world::World& world() const { return *world_; }
    [[nodiscard]] scene::View view() const { return world_->view(state_.size.width, state_.size.height); }
    [[nodiscard]] bool has(Half half) const { return hasHost(half) || isExact(half); }
    [[nodiscard]] bool isExact(Half half) const { return half == Half::b && showsExact(state_); }
    [[nodiscard]] bool hasHost(Half half) const { return static_cast<bool>(halves_.at(indexOf(half)).host); }
    /// The half must be a method.
    [[nodiscard]] const run::MethodHost& host(Half half) const { return *halves_.at(indexOf(half)).host; }
    /// Visits the volume that a half's method shows.
    void volume(Half half, VolumeVisitor& visitor);
    /// The ground truth in half B; isEvaluated() must be true.
    [[nodiscard]] const ExactHalf& exact() const { return *exact_; }
    [[nodiscard]] HalfCost cost(Half half) const { return halves_.at(indexOf(half)).cost; }
    /// Duration of the last step of the world, which both halves share: input and simulation.
    [[nodiscard]] double worldMs() const { return worldMs_; }
    /// False for a half that joined later: if its method depends on earlier frames, a run shows another picture.
    [[nodiscard]] bool isSinceStart(Half half) const { return halves_.at(indexOf(half)).sinceStart; }

    /// The driver's current input; only read if the drive is keyboardDrive.
    [[nodiscard]] world::DrivingInput& input() { return *input_; }
    [[nodiscard]] const world::DrivingInput& input() const { return *input_; }
    /// The recorded drive as a drive file, and the state that replays it from `file`. Throws std::logic_error unless
    /// the drive is keyboardDrive and has begun.
    [[nodiscard]] std::string recordedDrive() const { return recording_.csv(); }
    [[nodiscard]] ViewState replayOf(const std::string& file) const;
    [[nodiscard]] std::size_t recordedSteps() const { return recording_.steps(); }

 private:
    struct ShownHalf {
        std::unique_ptr<run::MethodHost> host;
        HalfCost cost;
        bool sinceStart = true;
    };
    using Halves = std::array<ShownHalf, 2>;

    static std::size_t indexOf(Half half) { return half == Half::a ? 0 : 1; }
    void begin(const ViewState& state);
    [[nodiscard]] std::unique_ptr<world::World> makeWorld(const ViewState& state,
                                                          std::shared_ptr<world::DrivingInput> input) const;
    [[nodiscard]] ShownHalf makeHalf(const ViewState& state, Half half, const world::World& world) const;
    void replaceHalves(const ViewState& state);
    void updateHalf(ShownHalf& shown);
    void makeGroundTruth(const ViewState& state);
    void resizeHosts(const results::ImageSize& size);
    void drawPart(ShownHalf& shown, const PicturePart& part, const StageClock& clock);
    void noteDrawn();
    [[nodiscard]] StageMs recordedMs() const;

    gpu::Device& device_;
    ViewState state_;
    std::shared_ptr<world::DrivingInput> input_;
    std::unique_ptr<world::World> world_;
    Halves halves_;
    std::unique_ptr<ExactHalf> exact_;
    ShownHalf
        groundTruth_;  ///< draws with groundTruthMethod; empty if half B is a method, or if A shows dust of its own
    world::ControlRecording recording_;
    std::int64_t next_ = 0;
    std::int64_t moment_ = 0, drawnMoment_ = -1, exactMoment_ = -1;
    std::int64_t drawnFrame_ = 0;
    results::ImageSize drawnSize_;
    PictureParts drawnParts_;
    measure::StageRecorder recorder_;
    double worldMs_ = 0;
};

}  // namespace dustbench::view
