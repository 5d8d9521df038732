// Steps a world and times the frames of one method in it: input, simulation, method, opaque scene, drawing, waiting.
//
// Owns: the method's host. Threads: the one that made it, inside the oneTBB arena to be used.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/measure/frame_record.h"
#include "bench/measure/stage_recorder.h"
#include "bench/results/run_spec.h"
#include "bench/run/method_host.h"
#include "bench/scene/world.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/fence.h"
#include "methods/kit/gpu/timer_query.h"

namespace dustbench::bench {

/// Steps of the world before the warm-up: the preroll, and one at least, to be verified.
[[nodiscard]] std::int64_t stepsBeforeWarmup(const World& world);

class FrameRunner {
 public:
    /// Hosts the method of `spec` with `parameters`. `useGpuTimers`: only where they were found to be true. `world` and
    /// `device` must outlive the runner.
    FrameRunner(const RunSpec& spec, World& world, gpu::Device& device, const ParameterValues& parameters,
                bool useGpuTimers);

    /// One step of the world without a picture; the method takes part where it wants to.
    void stepWithoutPicture(std::int64_t index);
    /// One step whose picture is drawn twice: right away, as a timed frame is, and again with every stage waited for.
    /// Throws std::runtime_error where the two differ.
    void verifiedStep(std::int64_t index);
    /// One step of the world and of the method, which sees what it would see in a frame but is not drawn. For exports.
    void updateOnly(std::int64_t index);
    /// One frame as it is measured; recorded where `index` is 0 or more.
    void frame(std::int64_t index);
    /// Waits for all frames in flight and completes their records.
    void drain();

    /// Draws what the last `updateOnly` led to, apart from all that is timed. For metrics. `withDetail`: the layer
    /// without the scene as well.
    [[nodiscard]] DrawnMoment drawn(bool withDetail);
    /// The last frame over its scene, linear.
    [[nodiscard]] pictures::Image picture();
    /// Of the last `frame` or `updateOnly`: what the method hands over (Method::volume), and the facts that it told.
    void volume(VolumeVisitor& visitor);
    [[nodiscard]] Columns facts();
    [[nodiscard]] std::span<const FrameRecord> records() const { return records_; }
    [[nodiscard]] const MethodHost& host() const { return host_; }
    [[nodiscard]] const Method& method() const { return host_.method(); }

 private:
    void stepWorld();
    void waitForGpu();
    void keepRecord(std::int64_t index, std::int64_t elapsedNs);
    void collectGpuTimes();

    RunSpec spec_;
    World& world_;
    gpu::Device& device_;
    MethodHost host_;
    StageRecorder recorder_;
    gpu::Fence lastFrame_;
    std::int64_t lastEndNs_ = 0;  ///< where the next frame begins that overlaps this one; 0: nothing is in flight
    std::int64_t lastIndex_ = 0;
    bool useGpuTimers_;
    std::deque<std::pair<std::size_t, gpu::TimerQuery>> pendingGpuTimes_;  ///< by index into records_
    std::vector<FrameRecord> records_;
};

}  // namespace dustbench::bench
