// A mark in the queue of GPU work that can be waited for.
#pragma once

namespace dustbench::gpu {

class DUSTBENCH_API Fence {
 public:
    Fence() = default;
    /// A mark behind all work queued so far.
    [[nodiscard]] static Fence afterQueuedWork();
    ~Fence();
    Fence(Fence&& other) noexcept;
    Fence& operator=(Fence&& other) noexcept;

    /// Blocks until the work before the mark is done; returns at once where there is no mark.
    void wait();

 private:
    void* sync_ = nullptr;
};

}  // namespace dustbench::gpu
