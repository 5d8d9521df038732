#include "methods/kit/gpu/device.h"

#include <epoxy/gl.h>
#include <sys/resource.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/gpu/debug_output.h"
#include "methods/kit/gpu/egl_context.h"

namespace dustbench::gpu {
namespace {

constexpr const char* askedVariable = "DUSTBENCH_ADAPTER";

std::string textOf(GLenum name) {
    const auto* value = reinterpret_cast<const char*>(glGetString(name));
    return value ? value : "";
}

struct Opened {
    std::unique_ptr<EglContext> context;
    Adapter adapter;
    std::string why;
};

/// Drivers do not report a lack of memory. Throws MachineError if the process's limit leaves too little.
void requireMemory() {
    constexpr rlim_t enough = rlim_t{4} << 30;
    rlimit allowed{};
    if (getrlimit(RLIMIT_AS, &allowed) == 0 && allowed.rlim_cur != RLIM_INFINITY && allowed.rlim_cur < enough)
        throw files::MachineError(std::string(files::outOfMemory) + ": OpenGL does not start within the limit of " +
                                  std::to_string(allowed.rlim_cur >> 20) +
                                  " MB of address space (ulimit -v); raise it");
}

Opened openAsked(const std::string& asked) {
    // Only a name requires trying every adapter, because names come from the renderers.
    std::vector<Adapter> adapters = offeredAdapters();
    if (!adapterOfIndex(adapters, asked)) adapters = listAdapters();
    Adapter& adapter = adapters[findAdapter(adapters, asked)];
    auto context = EglContext::open(adapter);
    if (!context) requireMemory();
    if (!context)
        throw InputError("--adapter " + asked + ": OpenGL 4.5 is needed, but " + problemsOf(std::vector{adapter}));
    return {std::move(context), adapter, "--adapter " + asked};
}

Opened openPreferred() {
    std::vector<Adapter> adapters = offeredAdapters();
    std::unique_ptr<EglContext> context;
    const auto taken = takePreferred(adapters, [&context](Adapter& adapter) {
        context.reset();
        context = EglContext::open(adapter);
    });
    if (taken) return {std::move(context), adapters[*taken], whyPreferred(adapters, *taken)};
    requireMemory();
    throw InputError(
        "OpenGL 4.5 is needed, but EGL does not provide it (" +
        (adapters.empty() ? "it offers neither a device nor a surfaceless display" : problemsOf(adapters)) +
        "); install Mesa's DRI drivers (libgl1-mesa-dri) or a GPU driver");
}

}  // namespace

std::string askedAdapter() {
    const char* asked = std::getenv(askedVariable);
    return asked ? asked : "";
}

void askForAdapter(const std::string& asked) {
    setenv(askedVariable, asked.c_str(), 1);
}

Device::Device() {
    const std::string asked = askedAdapter();
    Opened opened = asked.empty() ? openPreferred() : openAsked(asked);
    context_ = std::move(opened.context);
    info_.platform = platformName(opened.adapter.platform);
    info_.adapter = opened.adapter.name;
    info_.adapterIndex = opened.adapter.index;
    info_.adapterWhy = opened.why;
    begin();
}

Device::Device(Adopted) {
    const std::string version = textOf(GL_VERSION);
    if (version.empty()) throw InputError("OpenGL 4.5 is needed, but no context is current");
    GLint profile = 0;
    if (epoxy_is_desktop_gl() && epoxy_gl_version() >= 45) glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    if ((profile & GL_CONTEXT_CORE_PROFILE_BIT) == 0)
        throw InputError("OpenGL 4.5 core is needed, but the current context is '" + version + "'" +
                         (profile != 0 ? ", not of the core profile" : ""));
    info_.platform = "adopted";
    info_.adapterWhy = "adopted the current context";
    begin();
}

Device Device::adoptCurrent() {
    return Device(Adopted{});
}

void Device::begin() {
    info_.vendor = textOf(GL_VENDOR);
    info_.renderer = textOf(GL_RENDERER);
    info_.version = textOf(GL_VERSION);
    listenToDebugOutput();
    glEnable(GL_PROGRAM_POINT_SIZE);               // shaders set the size of points
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // reversed depth keeps its precision only without the −1..1 remap
}

Device::~Device() = default;

std::optional<std::int64_t> Device::driverFreeBytes() const {
    if (isSoftware()) return std::nullopt;  // the host's memory; Mesa 25 reports 24 GiB as 24 MiB
    // With either extension the first value is the free memory in KiB.
    std::array<GLint, 4> kibibytes{};
    if (epoxy_has_gl_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, kibibytes.data());
    else if (epoxy_has_gl_extension("GL_ATI_meminfo"))
        glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, kibibytes.data());
    if (kibibytes[0] <= 0) return std::nullopt;
    return std::int64_t{kibibytes[0]} * 1024;
}

std::size_t Device::maximumStorageBytes() const {
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    return static_cast<std::size_t>(bytes);
}

bool Device::offers(const std::string& extension) const {
    return epoxy_has_gl_extension(extension.c_str());
}

int Device::subgroupThreads() const {
    if (!offers("GL_KHR_shader_subgroup")) return 0;
    constexpr GLint needed = GL_SUBGROUP_FEATURE_BASIC_BIT_KHR | GL_SUBGROUP_FEATURE_ARITHMETIC_BIT_KHR |
                             GL_SUBGROUP_FEATURE_BALLOT_BIT_KHR | GL_SUBGROUP_FEATURE_SHUFFLE_BIT_KHR;
    GLint threads = 0, stages = 0, features = 0;
    glGetIntegerv(GL_SUBGROUP_SIZE_KHR, &threads);
    glGetIntegerv(GL_SUBGROUP_SUPPORTED_STAGES_KHR, &stages);
    glGetIntegerv(GL_SUBGROUP_SUPPORTED_FEATURES_KHR, &features);
    return (stages & GL_COMPUTE_SHADER_BIT) != 0 && (features & needed) == needed ? threads : 0;
}

bool Device::isSoftware() const {
    return isSoftwareRenderer(info_.renderer);
}

void Device::finish() {
    glFinish();
    throwOnDebugOutput("finish");
}

}  // namespace dustbench::gpu
