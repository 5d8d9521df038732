// Shows the pictures of a device in a window. The device is the window's own or that of another adapter.
//
// Owns: the Device of the window's context. Threads: the one that opened the window.
#pragma once

#include <memory>

#include "bench/view/panels/panel_canvas.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/egl_context.h"

struct GLFWwindow;

namespace dustbench::view {

class WindowOutput {
 public:
    /// The window's context must be current. Uses the requested adapter (askedAdapter), otherwise the window's. Throws
    /// InputError as Device does.
    explicit WindowOutput(GLFWwindow* window);
    /// All objects of device() must be destroyed before.
    ~WindowOutput();
    WindowOutput(const WindowOutput&) = delete;
    WindowOutput& operator=(const WindowOutput&) = delete;

    /// The device to draw with; its context is current.
    [[nodiscard]] gpu::Device& device() { return other_ ? *other_ : own_; }
    /// A picture of another adapter is copied through main memory.
    void show(PanelTarget& target);

 private:
    void copy(PanelTarget& target);

    GLFWwindow* window_;
    gpu::Device own_;
    PanelTarget copy_;  ///< in the window's context
    std::unique_ptr<gpu::Device> other_;
    gpu::CurrentContext drawing_;  ///< of device()
};

}  // namespace dustbench::view
