// The OpenGL context that is current: to come back to it after another one, and to see whether it is lost.
//
// Threads: the one that it is current on.
#pragma once

namespace dustbench::gpu {

/// Remembers the EGL context that is current at construction, with its surfaces. It must stay alive.
class DUSTBENCH_API CurrentContext {
 public:
    CurrentContext();
    /// Throws std::runtime_error if EGL refuses.
    void makeCurrent() const;

 private:
    void *display_, *drawn_, *read_, *context_;
};

/// The driver has reset the GPU, and all that was on it is gone. Known only of contexts that notify of it.
[[nodiscard]] DUSTBENCH_API bool isContextLost();

}  // namespace dustbench::gpu
