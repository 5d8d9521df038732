#include "methods/kit/gpu/fence.h"

#include <epoxy/gl.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

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

}  // namespace dustbench::gpu
