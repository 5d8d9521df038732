#include "methods/kit/gpu/current_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <stdexcept>

namespace dustbench::gpu {

CurrentContext::CurrentContext()
    : display_(eglGetCurrentDisplay()),
      drawn_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)),
      context_(eglGetCurrentContext()) {}

void CurrentContext::makeCurrent() const {
    if (!eglMakeCurrent(display_, drawn_, read_, context_))
        throw std::runtime_error("EGL: cannot make an OpenGL context current again");
}

bool isContextLost() {
    return glGetGraphicsResetStatus() != GL_NO_ERROR;
}

}  // namespace dustbench::gpu
