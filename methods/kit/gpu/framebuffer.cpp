#include "methods/kit/gpu/framebuffer.h"

#include <epoxy/gl.h>

#include <array>
#include <stdexcept>
#include <string>

#include "methods/kit/gpu/debug_output.h"

namespace dustbench::gpu {
namespace {

/// Of the DrawnPart that exists; without one, no framebuffer has the size.
struct Part {
    int width = 0, height = 0, left = 0, bottom = 0, columns = 0, rows = 0;
};
Part part;

/// Clears are not limited to the part that is drawn.
class WholeClear {
 public:
    WholeClear() : wasLimited_(glIsEnabled(GL_SCISSOR_TEST)) { glDisable(GL_SCISSOR_TEST); }
    ~WholeClear() {
        if (wasLimited_) glEnable(GL_SCISSOR_TEST);
    }
    WholeClear(const WholeClear&) = delete;
    WholeClear& operator=(const WholeClear&) = delete;

 private:
    GLboolean wasLimited_;
};

}  // namespace

DrawnPart::DrawnPart(int width, int height, int left, int bottom, int columns, int rows) {
    part = {width, height, left, bottom, columns, rows};
}

DrawnPart::~DrawnPart() {
    part = {};
    glDisable(GL_SCISSOR_TEST);
}

Framebuffer::Framebuffer(Device&, std::string_view label, const Texture* colour, const Texture* depth)
    : colours_(colour ? 1 : 0) {
    create(label);
    const GLuint name = name_.get();
    if (colour) glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour->name().get(), 0);
    if (depth) glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth->name().get(), 0);
    if (!colour) glNamedFramebufferDrawBuffer(name, GL_NONE);
    complete(label, colour ? *colour : *depth);
}

Framebuffer::Framebuffer(Device&, std::string_view label, std::span<const Texture* const> colours)
    : colours_(static_cast<int>(colours.size())) {
    constexpr std::size_t maximum = 8;  // guaranteed by OpenGL 4.5
    if (colours.empty() || colours.size() > maximum)
        throw std::invalid_argument("framebuffer '" + std::string(label) + "': got " + std::to_string(colours.size()) +
                                    " colours, allowed: 1..8");
    create(label);
    std::array<GLenum, maximum> places{};
    for (std::size_t i = 0; i < colours.size(); ++i) {
        places[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
        glNamedFramebufferTexture(name_.get(), places[i], colours[i]->name().get(), 0);
    }
    glNamedFramebufferDrawBuffers(name_.get(), colours_, places.data());
    complete(label, *colours.front());
}

void Framebuffer::create(std::string_view label) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    name_ = Name(name, [](std::uint32_t value) { glDeleteFramebuffers(1, &value); });
    glObjectLabel(GL_FRAMEBUFFER, name, static_cast<GLsizei>(label.size()), label.data());
}

void Framebuffer::complete(std::string_view label, const Texture& any) {
    const GLenum status = glCheckNamedFramebufferStatus(name_.get(), GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("framebuffer '" + std::string(label) + "' is not complete: status " +
                                 std::to_string(status));
    throwOnDebugOutput(label);
    width_ = any.width();
    height_ = any.height();
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name_.get());
    glViewport(0, 0, width_, height_);
    if (colours_ > 0 && width_ == part.width && height_ == part.height) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(part.left, part.bottom, part.columns, part.rows);
    } else if (part.width > 0) {
        glDisable(GL_SCISSOR_TEST);
    }
}

void Framebuffer::clearColour(float red, float green, float blue, float alpha) const {
    const WholeClear whole;
    const std::array<float, 4> value{red, green, blue, alpha};
    for (int i = 0; i < colours_; ++i) glClearNamedFramebufferfv(name_.get(), GL_COLOR, i, value.data());
}

void Framebuffer::clearOutput(int output, float value) const {
    const WholeClear whole;
    const std::array<float, 4> values{value, value, value, value};
    glClearNamedFramebufferfv(name_.get(), GL_COLOR, output, values.data());
}

void Framebuffer::clearDepth() const {
    const WholeClear whole;
    const float farthest = 0;
    glDepthMask(GL_TRUE);  // clears respect the depth mask
    glClearNamedFramebufferfv(name_.get(), GL_DEPTH, 0, &farthest);
}

void Framebuffer::copyToWindow() const {
    glBlitNamedFramebuffer(name_.get(), 0, 0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT,
                           GL_NEAREST);
}

}  // namespace dustbench::gpu
