#include "methods/kit/gpu/queue_marks.h"

#include <epoxy/gl.h>

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "gpu_shaders.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::gpu {

Fence Fence::afterQueuedWork() {
    Fence fence;
    fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    return fence;
}

Fence::~Fence() {
    if (sync_) glDeleteSync(static_cast<GLsync>(sync_));
}

Fence::Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}

Fence& Fence::operator=(Fence&& other) noexcept {
    std::swap(sync_, other.sync_);
    return *this;
}

void Fence::wait() {
    if (!sync_) return;
    constexpr std::uint64_t minuteNs = 60'000'000'000;
    const GLenum result = glClientWaitSync(static_cast<GLsync>(sync_), GL_SYNC_FLUSH_COMMANDS_BIT, minuteNs);
    glDeleteSync(static_cast<GLsync>(std::exchange(sync_, nullptr)));
    if (result == GL_TIMEOUT_EXPIRED || result == GL_WAIT_FAILED)
        throw std::runtime_error("the GPU has not finished its work within 60 s");
}

TimerQuery::TimerQuery(Device&) {
    GLuint name = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &name);
    name_ = Name(name, [](std::uint32_t value) { glDeleteQueries(1, &value); });
}

void TimerQuery::begin() {
    glBeginQuery(GL_TIME_ELAPSED, name_.get());
}

void TimerQuery::end() {
    glEndQuery(GL_TIME_ELAPSED);
}

std::optional<double> TimerQuery::milliseconds() const {
    GLint ready = 0;
    glGetQueryObjectiv(name_.get(), GL_QUERY_RESULT_AVAILABLE, &ready);
    if (!ready) return std::nullopt;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(name_.get(), GL_QUERY_RESULT, &nanoseconds);
    return static_cast<double>(nanoseconds) * 1e-6;
}

TimerComparison compareTimerWithFence(Device& device) {
    constexpr int items = 64 * 1024;
    constexpr double enoughMs = 5;  // far above the cost of reading either clock
    const std::vector<float> start(items, 0.25f);
    Buffer values(device, "timer self-test", std::span<const float>(start));
    Program load(device, "timer self-test", {gpu_shaders::busy_comp});
    TimerQuery query(device);
    values.bindStorage(0);

    TimerComparison times;
    for (int rounds = 64; rounds <= 64 * 1024 && times.fenceMs < enoughMs; rounds *= 4) {
        load.set("rounds", rounds);
        device.finish();
        const auto begin = std::chrono::steady_clock::now();
        query.begin();
        load.dispatch(items / 64, 1, 1);
        query.end();
        device.finish();
        times.fenceMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        times.queryMs = query.milliseconds().value_or(0);
    }
    return times;
}

bool timerQueriesAreTrue(Device& device) {
    return compareTimerWithFence(device).agree();
}

}  // namespace dustbench::gpu
