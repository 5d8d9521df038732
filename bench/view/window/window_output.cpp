#include "bench/view/window/window_output.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace dustbench::view {
namespace {

std::vector<std::uint8_t> bytesOf(const gpu::Texture& texture) {
    std::vector<std::uint8_t> bytes;
    for (const float value : texture.readFloats()) bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * value)));
    return bytes;
}

}  // namespace

WindowOutput::WindowOutput(GLFWwindow* window) : window_(window), own_(gpu::Device::adoptCurrent()), copy_(own_) {
    if (gpu::askedAdapter().empty()) return;
    other_ = std::make_unique<gpu::Device>();
    drawing_ = gpu::CurrentContext();
}

WindowOutput::~WindowOutput() {
    other_.reset();
    glfwMakeContextCurrent(window_);  // the copy is deleted in it
}

void WindowOutput::show(PanelTarget& target) {
    if (other_)
        copy(target);
    else
        target.framebuffer().copyToWindow();
    glfwSwapBuffers(window_);
    if (other_) drawing_.makeCurrent();
}

void WindowOutput::copy(PanelTarget& target) {
    const std::vector<std::uint8_t> bytes = bytesOf(target.texture());
    const int width = target.texture().width(), height = target.texture().height();
    glfwMakeContextCurrent(window_);
    copy_.fit(width, height);
    copy_.texture().write(std::span<const std::uint8_t>(bytes));
    copy_.framebuffer().copyToWindow();
}

}  // namespace dustbench::view
