// The current OpenGL context: restores it after another one was used, and detects its loss.
//
// Threads: the context's.
#pragma once

namespace dustbench::gpu {

/// Remembers the EGL context that is current at construction, with its surfaces. It must stay alive.
class DUSTBENCH_API CurrentContext {
 public:
    CurrentContext();
    /// Throws std::runtime_error on failure.
    void makeCurrent() const;

 private:
    void *display_, *drawn_, *read_, *context_;
};

/// True if the driver has reset the GPU and its memory is lost. Works only for contexts that report resets.
[[nodiscard]] DUSTBENCH_API bool isContextLost();

}  // namespace dustbench::gpu
