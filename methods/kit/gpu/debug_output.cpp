#include "methods/kit/gpu/debug_output.h"

#include <epoxy/gl.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "methods/contract/errors.h"

namespace dustbench::gpu {

namespace {

#ifdef DUSTBENCH_CHECKED
thread_local std::string firstMessage;

void forgetMessage() {
    firstMessage.clear();
}
#else
void forgetMessage() {}
#endif

}  // namespace

void requireAllocated(std::string_view label, std::size_t bytes) {
    if (glGetError() == GL_NO_ERROR) return;
    forgetMessage();
    throw InputError("GPU: '" + std::string(label) + "' of " + std::to_string(bytes) +
                     " bytes cannot be allocated; use smaller pictures or grids, or fewer particles");
}

#ifdef DUSTBENCH_CHECKED
namespace {

void onMessage(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* message, const void*) {
    const bool wrong = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (wrong && firstMessage.empty()) firstMessage.assign(message, static_cast<std::size_t>(length));
}

}  // namespace

void listenToDebugOutput() {
    firstMessage.clear();
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&onMessage, nullptr);
}

void throwOnDebugOutput(std::string_view where) {
    if (firstMessage.empty()) return;
    throw std::runtime_error("OpenGL, " + std::string(where) + ": " + std::exchange(firstMessage, {}));
}

#endif

}  // namespace dustbench::gpu
