// Shows in a window what a device has drawn: the window's own, or that of another adapter.
//
// Owns: the Device of the window's context. Threads: the one that opened the window.
#pragma once

#include <memory>

#include "bench/view/panels/panel_target.h"
#include "methods/kit/gpu/current_context.h"
#include "methods/kit/gpu/device.h"

struct GLFWwindow;

namespace dustbench::bench {

class WindowOutput {
 public:
    /// The window's context must be current. Draws with the adapter that was asked for (askedAdapter), else with the
    /// window's. Throws InputError as Device does.
    explicit WindowOutput(GLFWwindow* window);
    /// Whatever was drawn with device() must be gone by then.
    ~WindowOutput();
    WindowOutput(const WindowOutput&) = delete;
    WindowOutput& operator=(const WindowOutput&) = delete;

    /// To draw with; its context is current.
    [[nodiscard]] gpu::Device& device() { return other_ ? *other_ : own_; }
    /// Another adapter's picture passes through the main memory.
    void show(PanelTarget& target);

 private:
    void copy(PanelTarget& target);

    GLFWwindow* window_;
    gpu::Device own_;
    PanelTarget copy_;  ///< in the window's context
    std::unique_ptr<gpu::Device> other_;
    gpu::CurrentContext drawing_;  ///< of device()
};

}  // namespace dustbench::bench
