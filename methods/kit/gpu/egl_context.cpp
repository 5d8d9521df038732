#include "methods/kit/gpu/egl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "methods/contract/errors.h"

namespace dustbench::gpu {
namespace {

/// EGL_EXT_device_drm_render_node, which libepoxy 1.5 does not define.
constexpr EGLint renderNodeFile = 0x3377;

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

std::vector<EGLDeviceEXT> eglDevices() {
    // The older name stands for enumeration and queries together.
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
        return {};
    EGLint count = 0;
    if (!eglQueryDevicesEXT(0, nullptr, &count)) return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!eglQueryDevicesEXT(count, devices.data(), &count)) return {};
    devices.resize(static_cast<std::size_t>(count));
    return devices;
}

/// ` (/dev/dri/renderD128)`, ` (CUDA 1)`, or empty if the driver reports neither.
std::string nodeOf(EGLDeviceEXT device, const char* extensions) {
    for (const auto& [extension, name] :
         {std::pair{"EGL_EXT_device_drm_render_node", renderNodeFile}, {"EGL_EXT_device_drm", EGL_DRM_DEVICE_FILE_EXT}})
        if (epoxy_extension_in_string(extensions, extension))
            if (const char* file = eglQueryDeviceStringEXT(device, name)) return std::string(" (") + file + ")";
    EGLAttrib cuda = 0;
    if (epoxy_extension_in_string(extensions, "EGL_NV_device_cuda") &&
        eglQueryDeviceAttribEXT(device, EGL_CUDA_DEVICE_NV, &cuda))
        return " (CUDA " + std::to_string(cuda) + ")";
    return "";
}

Adapter describe(EGLDeviceEXT device, int index) {
    const char* reported = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    const char* extensions = reported ? reported : "";
    Adapter adapter{.index = index, .name = "EGL device " + std::to_string(index) + nodeOf(device, extensions)};
    if (epoxy_extension_in_string(extensions, "EGL_MESA_device_software")) adapter.kind = Adapter::Kind::software;
    return adapter;
}

/// Restores the context that was current at construction.
class CurrentContextKept {
 public:
    CurrentContextKept() = default;
    ~CurrentContextKept() {
        eglBindAPI(api_);
        if (context_ != EGL_NO_CONTEXT) eglMakeCurrent(display_, drawn_, read_, context_);
    }
    CurrentContextKept(const CurrentContextKept&) = delete;
    CurrentContextKept& operator=(const CurrentContextKept&) = delete;

 private:
    EGLenum api_ = eglQueryAPI();
    EGLDisplay display_ = eglGetCurrentDisplay();
    EGLSurface drawn_ = eglGetCurrentSurface(EGL_DRAW), read_ = eglGetCurrentSurface(EGL_READ);
    EGLContext context_ = eglGetCurrentContext();
};

}  // namespace

EglContext::~EglContext() {
    if (context_ == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context_) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
}

/// Empty, or the reason why there is no context.
std::string EglContext::connect(const Adapter& adapter) {
    if (adapter.platform == Adapter::Platform::surfaceless)
        display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    else
        display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT,
                                            eglDevices().at(static_cast<std::size_t>(adapter.index)), nullptr);
    if (display_ == EGL_NO_DISPLAY) return "has no display";
    EGLint major = 0, minor = 0;
    if (!eglInitialize(display_, &major, &minor)) return "cannot be initialised: " + eglErrorText();
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
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT) return "provides no OpenGL 4.5 core context: " + eglErrorText();
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
        return "does not support contexts without a surface: " + eglErrorText();
    return "";
}

std::unique_ptr<EglContext> EglContext::open(Adapter& adapter) {
    std::unique_ptr<EglContext> context(new EglContext);
    adapter.problem = context->connect(adapter);
    if (!adapter.problem.empty()) return nullptr;
    const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    adapter.renderer = renderer ? renderer : "";
    if (isSoftwareRenderer(adapter.renderer))
        adapter.kind = Adapter::Kind::software;
    else if (adapter.platform == Adapter::Platform::surfaceless)
        adapter.kind = Adapter::Kind::hardware;
    const std::string unnamed = "EGL device " + std::to_string(adapter.index);
    if (adapter.name.starts_with(unnamed)) adapter.name.replace(0, unnamed.size(), adapter.renderer);
    return context;
}

std::vector<Adapter> offeredAdapters() {
    setenv("EGL_LOG_LEVEL", "fatal", 0);  // failures are reported once, by the code that requests a context
    if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base"))
        throw InputError(
            "OpenGL 4.5 is needed: this machine's EGL has no EGL_EXT_platform_base; install Mesa's EGL and DRI "
            "drivers");
    std::vector<Adapter> adapters;
    for (EGLDeviceEXT device : eglDevices()) adapters.push_back(describe(device, static_cast<int>(adapters.size())));
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        adapters.push_back({.index = static_cast<int>(adapters.size()),
                            .name = "surfaceless",
                            .kind = Adapter::Kind::software,
                            .platform = Adapter::Platform::surfaceless});
    return adapters;
}

std::vector<Adapter> listAdapters() {
    std::vector<Adapter> adapters = offeredAdapters();
    const CurrentContextKept kept;
    for (Adapter& adapter : adapters) (void)EglContext::open(adapter);
    return adapters;
}

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
