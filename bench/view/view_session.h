// One world stepped once a frame, shown by up to two methods side by side, or by one beside the exact picture.
//
// Each method has the host of a run, with its own targets and its own ledger, and gets the updates that a run gives it.
// Owns: world and hosts. Threads: the device's, inside the oneTBB arena to be used; `ViewState::threads` is the
// caller's business.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "bench/measure/stage_recorder.h"
#include "bench/run/method_host.h"
#include "bench/scene/control_recording.h"
#include "bench/scene/keyboard_controls.h"
#include "bench/scene/world.h"
#include "bench/view/exact_half.h"
#include "bench/view/view_state.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

/// Milliseconds by stage (methods/contract/stage_clock.h). A wait for the GPU follows each stage, so that queued work
/// counts where it was queued.
using StageMs = std::array<double, stageNames.size()>;
[[nodiscard]] inline double sum(const StageMs& stages) {
    return std::accumulate(stages.begin(), stages.end(), 0.0);
}

/// Of one half's last step and last picture.
struct HalfCost {
    StageMs update{}, draw{};
    [[nodiscard]] double totalMs() const { return sum(update) + sum(draw); }
};

class ViewSession {
 public:
    /// At the beginning of the preroll. Throws InputError for a state that cannot be shown. `device` must outlive it.
    ViewSession(const ViewState& state, gpu::Device& device);

    /// With the frame that is shown, or the later one that is on its way.
    [[nodiscard]] ViewState state() const;
    /// Does as little as possible: a new half joins the running world, a new camera only looks at it, and any other
    /// change of the world restarts it. Throws InputError and changes nothing if the state cannot be shown.
    void set(const ViewState& state);
    /// From the beginning of the preroll to frame 0.
    void restart();

    /// One step of the world, and the update of every half that a run would give it.
    void step();
    /// Of the last step, as in a run: the warm-up and the preroll before it are below 0.
    [[nodiscard]] std::int64_t frame() const { return next_ - 1; }
    /// Steps to go until the frame of the state that was set.
    [[nodiscard]] std::int64_t stepsToGo() const { return std::max<std::int64_t>(state_.frame - frame(), 0); }

    /// Draws every method, as large as the state says or as given; its picture is valid until the next call or set().
    void draw() { draw(state_.size); }
    void draw(const ImageSize& size);
    /// Of the last draw().
    [[nodiscard]] ImageSize drawnSize() const { return drawnSize_; }
    /// Draws the exact picture of the world as it is now, and the methods with it, as large as the state says. Half B
    /// must be the exact picture.
    void drawExact();
    /// Of the last draw: another number is another state of the world, of a method or of the camera.
    [[nodiscard]] std::int64_t drawnMoment() const { return drawnMoment_; }
    [[nodiscard]] std::int64_t drawnFrame() const { return drawnFrame_; }
    /// The half shows the moment that was drawn last: false for an exact picture of an earlier one, or none.
    [[nodiscard]] bool isCurrent(Half half) const;
    /// Half B is the judge's exact picture of the moment that was drawn last, with numbers; it may be current without
    /// that, drawn by the live truth.
    [[nodiscard]] bool isJudged() const { return exact_ && exactMoment_ == drawnMoment_; }
    /// The world has gone on, or the state has changed, since the last draw.
    [[nodiscard]] bool isBehind() const { return drawnMoment_ != moment_; }

    /// What a half has drawn; it must be current.
    [[nodiscard]] HalfTextures textures(Half half) const;
    [[nodiscard]] const gpu::Texture& picture(Half half) const { return textures(half).display; }
    /// The picture in linear light, opaque, as large as it was drawn.
    [[nodiscard]] pictures::Image image(Half half) const;

    [[nodiscard]] const World& world() const { return *world_; }
    [[nodiscard]] scene::View view() const { return world_->view(state_.size.width, state_.size.height); }
    [[nodiscard]] bool has(Half half) const { return hasHost(half) || isExact(half); }
    [[nodiscard]] bool isExact(Half half) const { return half == Half::b && showsExact(state_); }
    [[nodiscard]] bool hasHost(Half half) const { return static_cast<bool>(halves_.at(indexOf(half)).host); }
    /// Of a half that is a method.
    [[nodiscard]] const MethodHost& host(Half half) const { return *halves_.at(indexOf(half)).host; }
    /// The volume that a half's method shows.
    void volume(Half half, VolumeVisitor& visitor);
    /// Of half B; isJudged() must be true.
    [[nodiscard]] const ExactHalf& exact() const { return *exact_; }
    [[nodiscard]] HalfCost cost(Half half) const { return halves_.at(indexOf(half)).cost; }
    /// Of the last step of the world, which both halves show: input and simulation.
    [[nodiscard]] double worldMs() const { return worldMs_; }
    /// False for a half that joined later: if its method remembers earlier frames, a run shows another picture.
    [[nodiscard]] bool isSinceStart(Half half) const { return halves_.at(indexOf(half)).sinceStart; }

    /// What the driver holds; only read if the drive is keyboardDrive.
    [[nodiscard]] DrivingInput& input() { return *input_; }
    [[nodiscard]] const DrivingInput& input() const { return *input_; }
    /// The drive so far as a drive file, and the state whose drive it is: `file` is its name. Throws std::logic_error
    /// unless the drive is keyboardDrive and has begun.
    [[nodiscard]] std::string recordedDrive() const { return recording_.csv(); }
    [[nodiscard]] ViewState replayOf(const std::string& file) const;
    [[nodiscard]] std::size_t recordedSteps() const { return recording_.steps(); }

 private:
    struct ShownHalf {
        std::unique_ptr<MethodHost> host;
        HalfCost cost;
        bool sinceStart = true;
    };
    using Halves = std::array<ShownHalf, 2>;

    static std::size_t indexOf(Half half) { return half == Half::a ? 0 : 1; }
    void begin(const ViewState& state);
    [[nodiscard]] std::unique_ptr<World> makeWorld(const ViewState& state, std::shared_ptr<DrivingInput> input) const;
    [[nodiscard]] ShownHalf makeHalf(const ViewState& state, Half half, const World& world) const;
    void replaceHalves(const ViewState& state);
    void updateHalf(ShownHalf& shown);
    void makeTruth(const ViewState& state);
    void resizeHosts(const ImageSize& size);
    void noteDrawn();
    [[nodiscard]] StageMs recordedMs() const;

    gpu::Device& device_;
    ViewState state_;
    std::shared_ptr<DrivingInput> input_;
    std::unique_ptr<World> world_;
    Halves halves_;
    std::unique_ptr<ExactHalf> exact_;
    ShownHalf truth_;  ///< the live truth; empty if half B is a method, or A shows other dust than the shared
    ControlRecording recording_;
    std::int64_t next_ = 0;
    std::int64_t moment_ = 0, drawnMoment_ = -1, exactMoment_ = -1;
    std::int64_t drawnFrame_ = 0;
    ImageSize drawnSize_;
    StageRecorder recorder_;
    double worldMs_ = 0;
};

}  // namespace dustbench::bench
