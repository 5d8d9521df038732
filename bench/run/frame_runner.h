// Steps a world and times the frames of one method in it: input, simulation, method, opaque scene, drawing, waiting. A
// replay makes the same steps without measuring.
//
// Owns: the method's host. Threads: the one that created it, inside the oneTBB arena to be used.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/measure/clock.h"
#include "bench/measure/frame_record.h"
#include "bench/results/run_spec.h"
#include "bench/run/method_host.h"
#include "bench/world/world.h"
#include "methods/contract/stage_clock.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/queue_marks.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::run {

/// Steps of the world before the warm-up: the preroll, but at least one, for verification.
[[nodiscard]] std::int64_t stepsBeforeWarmup(const world::World& world);

class FrameRunner {
 public:
    /// Hosts the method of `spec` with `parameters`. Set `useGpuTimers` only if GPU timers were found to be reliable.
    /// `world` and `device` must outlive the runner.
    FrameRunner(const results::RunSpec& spec, world::World& world, gpu::Device& device,
                const ParameterValues& parameters, bool useGpuTimers);

    /// One step of the world without a picture; the method is updated if it requires that.
    void stepWithoutPicture(std::int64_t index);
    /// One step whose picture is drawn twice, as in a timed frame and with a wait after every stage. Throws
    /// std::runtime_error if the two pictures differ, and as requireFinitePicture does.
    void verifiedStep(std::int64_t index);
    /// One step of the world and of the method, as in a frame but without drawing. For exports.
    void updateOnly(std::int64_t index);
    /// One measured frame; recorded if `index` is 0 or more.
    void frame(std::int64_t index);
    /// Waits for all frames in flight and completes their records.
    void drain();
    /// Reads back the last frame. Throws SimulationError if its scene or layer contains a non-finite value.
    void requireFinitePicture() const;

    /// For metrics: draws the state of the last `updateOnly` outside all timing. `withDetail`: also draws the layer
    /// without the scene.
    [[nodiscard]] reference::DrawnMoment drawn(bool withDetail);
    /// The last frame over its scene, linear.
    [[nodiscard]] pictures::Image picture();
    /// The volume (Method::volume) and the facts that the method provides for the last `frame` or `updateOnly`.
    void volume(VolumeVisitor& visitor);
    [[nodiscard]] results::Columns facts();
    [[nodiscard]] std::span<const measure::FrameRecord> records() const { return records_; }
    [[nodiscard]] const MethodHost& host() const { return host_; }
    [[nodiscard]] const Method& method() const { return host_.method(); }

 private:
    void stepWorld();
    void waitForGpu();
    void keepRecord(std::int64_t index, std::int64_t elapsedNs);
    void collectGpuTimes();
    void keepCount(const gpu::Buffer& number, bool isOfParticles);
    void collectCounts();

    results::RunSpec spec_;
    world::World& world_;
    gpu::Device& device_;
    MethodHost host_;
    measure::StageRecorder recorder_;
    gpu::Fence lastFrame_;
    std::int64_t lastEndNs_ = 0;  ///< start of the next overlapping frame; 0: none in flight
    std::int64_t lastIndex_ = 0;
    bool useGpuTimers_;
    std::deque<std::pair<std::size_t, gpu::TimerQuery>> pendingGpuTimes_;  ///< by index into records_
    /// Copies of numbers that only the GPU knows.
    struct PendingCount {
        std::size_t record;  ///< index into records_
        bool isOfParticles;  ///< else of primitives
        gpu::Buffer number;
    };
    std::deque<PendingCount> pendingCounts_;
    std::vector<measure::FrameRecord> records_;
};

struct Replay {
    const results::RunSpec& spec;
    FrameRunner& runner;
    std::int64_t prerollSteps;  ///< stepsBeforeWarmup
    std::int64_t lastFrame;
    /// Called after each step, including the untimed ones before frame 0; returning false stops the replay.
    std::function<bool()> stepped;
    /// Called after each frame from 0 on.
    std::function<void(std::int64_t frame)> visit;
    /// As RunProgress.
    std::function<void(std::string_view phase, std::int64_t done, std::int64_t total)> progress;
};

/// Repeats the steps of a run without measuring: at each frame, world and method have made exactly the same steps as in
/// `measureRun`. Returns false if `stepped` stopped it.
bool replay(const Replay& replay);

/// Checks that the pixels drawn by a stage are finite. Throws SimulationError with the number of non-finite pixels and
/// the first of them, from the top left: `frame 119: the method's layer is not finite in 3 pixels, first in (12, 40):
/// red is nan (stage draw)`.
void requireFinite(const pictures::Image& picture, std::int64_t frame, Stage stage, std::string_view what);

}  // namespace dustbench::run
