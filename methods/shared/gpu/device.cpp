#include "methods/shared/gpu/device.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "methods/shared/errors.h"
#include "methods/shared/gpu/debug_output.h"

namespace dustbench::gpu {

/// The display belongs to the process and is never terminated: another Device may be using it.
struct Device::Connection {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    ~Connection() {
        if (display == EGL_NO_DISPLAY) return;
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    }
};

namespace {

std::string eglErrorText() {
    switch (const EGLint error = eglGetError()) {
        case EGL_SUCCESS:
            return "no error given";
        case EGL_NOT_INITIALIZED:
            return "EGL_NOT_INITIALIZED";
        case EGL_BAD_MATCH:
            return "EGL_BAD_MATCH";
        case EGL_BAD_CONFIG:
            return "EGL_BAD_CONFIG";
        case EGL_BAD_ATTRIBUTE:
            return "EGL_BAD_ATTRIBUTE";
        case EGL_BAD_ALLOC:
            return "EGL_BAD_ALLOC";
        default:
            return "EGL error " + std::to_string(error);
    }
}

/// Makes a 4.5 core context on the display current. On failure says why and leaves nothing behind.
std::string connect(EGLDisplay display, EGLContext& context) {
    if (display == EGL_NO_DISPLAY) return "no display";
    EGLint major = 0, minor = 0;
    if (!eglInitialize(display, &major, &minor)) return "cannot be initialised: " + eglErrorText();
    if (!eglBindAPI(EGL_OPENGL_API)) return "has no desktop OpenGL";
    const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
#ifdef DUSTBENCH_CHECKED
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           EGL_TRUE,
#else
                                           EGL_CONTEXT_OPENGL_DEBUG,
                                           EGL_FALSE,
#endif
                                           EGL_NONE};
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT) return "gives no OpenGL 4.5 core context: " + eglErrorText();
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
        return "does not let a context be current without a surface: " + eglErrorText();
    return "";
}

std::vector<EGLDeviceEXT> eglDevices() {
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) return {};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(0, nullptr, &count)) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!eglQueryDevicesEXT(count, devices.data(), &count)) return {};
    return devices;
}

}  // namespace

Device::Device() {
    setenv("EGL_LOG_LEVEL", "fatal", 0);  // a failure is told once, by the exception
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base"))
        throw InputError(
            "OpenGL 4.5 is needed: this machine's EGL has no EGL_EXT_platform_base; install Mesa's EGL and DRI "
            "drivers");

    std::string tried;
    const auto attempt = [&](const std::string& platform, EGLenum kind, void* native) {
        auto connection = std::make_unique<Connection>();
        connection->display = eglGetPlatformDisplayEXT(kind, native, nullptr);
        const std::string reason = connect(connection->display, connection->context);
        if (reason.empty()) {
            connection_ = std::move(connection);
            info_.platform = platform;
            return true;
        }
        tried += (tried.empty() ? "" : "; ") + platform + " " + reason;
        return false;
    };

    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        attempt("surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
    else
        tried = "surfaceless is not offered";
    if (!connection_)
        for (EGLDeviceEXT device : eglDevices())
            if (attempt("device", EGL_PLATFORM_DEVICE_EXT, device)) break;
    if (!connection_)
        throw InputError("OpenGL 4.5 is needed and EGL gives none (" + tried +
                         "); install Mesa's DRI drivers (libgl1-mesa-dri) or a GPU driver");

    const auto text = [](GLenum name) {
        const auto* value = reinterpret_cast<const char*>(glGetString(name));
        return std::string(value ? value : "");
    };
    info_.vendor = text(GL_VENDOR);
    info_.renderer = text(GL_RENDERER);
    info_.version = text(GL_VERSION);
    listenToDebugOutput();
    glEnable(GL_PROGRAM_POINT_SIZE);               // shaders say how large points are
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // reversed depth keeps its precision only without the −1..1 remap
}

Device::~Device() = default;

std::optional<std::int64_t> Device::driverFreeBytes() const {
    // The first of the numbers, in KiB, of either extension is what is free.
    std::array<GLint, 4> kibibytes{};
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, kibibytes.data());
    else if (epoxy_has_gl_extension("GL_ATI_meminfo"))
        glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, kibibytes.data());
    if (kibibytes[0] <= 0) return std::nullopt;
    return std::int64_t{kibibytes[0]} * 1024;
}

std::size_t Device::mostStorageBytes() const {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    return static_cast<std::size_t>(bytes);
}

bool Device::isSoftware() const {
    return info_.renderer.find("llvmpipe") != std::string::npos || info_.renderer.find("softpipe") != std::string::npos;
}

void Device::finish() {
    glFinish();
    throwOnDebugOutput("finish");
}

}  // namespace dustbench::gpu
