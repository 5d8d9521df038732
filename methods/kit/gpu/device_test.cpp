// Tests the device with foreign contexts, and on each adapter of this machine.
#include "methods/kit/gpu/device.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/egl_context.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::gpu {
namespace {

using testing::HasSubstr;

/// A context that does not belong to gpu/; current from construction.
class ForeignContext {
 public:
    ForeignContext(int major, int minor, EGLint profile) {
        eglInitialize(display_, nullptr, nullptr);
        eglBindAPI(EGL_OPENGL_API);
        const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               major,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               minor,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               profile,
                                               EGL_CONTEXT_OPENGL_DEBUG,
                                               EGL_TRUE,
                                               EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
    }
    ~ForeignContext() {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
    }
    ForeignContext(const ForeignContext&) = delete;
    ForeignContext& operator=(const ForeignContext&) = delete;

    [[nodiscard]] bool isCurrent() const { return context_ != EGL_NO_CONTEXT && eglGetCurrentContext() == context_; }

 private:
    EGLDisplay display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// Draws a point of 8 pixels in one corner and returns the pixel in the opposite corner, with the depth as red. The
/// point has the shader's size, and depth 0, only if Device has set its state.
std::vector<float> pointDrawnOn(Device& device) {
    constexpr ShaderFile vertex{"test/point.vert", R"(
void main() { gl_Position = vec4(0.9, 0.9, 0, 1); gl_PointSize = 8; })"};
    constexpr ShaderFile fragment{"test/point.frag", R"(
out vec4 colour;
void main() { colour = vec4(gl_FragCoord.z, 0.25, 0.5, 1); })"};
    const Program program(device, "point", {vertex, fragment});
    const VertexArray nothing(device);
    const Texture picture = Texture::make2D(device, "picture", Format::rgba32F, 4, 4);
    const Framebuffer target(device, "target", &picture, nullptr);
    target.bind();
    target.clearColour(0, 0, 0, 0);
    draw(program, nothing, {}, Primitives::points, 1);
    const std::vector<float> pixels = picture.readFloats();
    return {pixels.begin(), pixels.begin() + 4};
}

/// Requests an adapter for its lifetime.
class Asked {
 public:
    explicit Asked(const std::string& adapter) { askForAdapter(adapter); }
    ~Asked() { askForAdapter(before_); }
    Asked(const Asked&) = delete;
    Asked& operator=(const Asked&) = delete;

 private:
    std::string before_ = askedAdapter();
};

}  // namespace

TEST(AdoptedDevice, DrawsWithAContextThatStaysItsMakers) {
    const ForeignContext context(4, 5, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
    ASSERT_TRUE(context.isCurrent());
    for (int i = 0; i < 2; ++i) {
        {
            Device device = Device::adoptCurrent();
            EXPECT_FALSE(device.info().renderer.empty());
            EXPECT_EQ(device.info().platform, "adopted");
            EXPECT_EQ(pointDrawnOn(device), (std::vector<float>{0, 0.25f, 0.5f, 1}));
            EXPECT_EQ(device.ledger().totalBytes(), 0u);
        }
        EXPECT_TRUE(context.isCurrent());
        GLuint buffer = 0;
        glCreateBuffers(1, &buffer);
        EXPECT_TRUE(glIsBuffer(buffer));
        glDeleteBuffers(1, &buffer);
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
}

TEST(AdoptedDevice, TakesNoContextThatIsTooOldOrMissing) {
    const auto adopt = [] { return inputError([] { const Device device = Device::adoptCurrent(); }); };
    EXPECT_THAT(adopt(), HasSubstr("no context is current"));
    {
        const ForeignContext context(4, 5, EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT);
        if (context.isCurrent()) {
            EXPECT_THAT(adopt(), HasSubstr("core"));
        }
    }
    {
        // Core profiles do not exist in this version: Mesa creates the requested version regardless.
        const ForeignContext context(2, 1, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
        ASSERT_TRUE(context.isCurrent());
        EXPECT_THAT(adopt(), HasSubstr("the current context is '"));
    }
}

TEST(Device, LeavesAnotherContextCurrentThatWasMadeCurrentMeanwhile) {
    auto device = std::make_unique<Device>();
    const ForeignContext context(4, 5, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
    device.reset();
    EXPECT_TRUE(context.isCurrent());
}

TEST(Device, ListsAdaptersAndLeavesNothingBehind) {
    const ForeignContext context(4, 5, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT);
    const std::vector<Adapter> adapters = listAdapters();
    ASSERT_FALSE(adapters.empty());
    EXPECT_TRUE(context.isCurrent());
    for (std::size_t i = 0; i < adapters.size(); ++i) {
        EXPECT_EQ(adapters[i].index, static_cast<int>(i));
        EXPECT_EQ(adapters[i].renderer.empty(), !adapters[i].problem.empty()) << adapters[i].name;
        EXPECT_EQ(isSoftwareRenderer(adapters[i].renderer), adapters[i].kind == Adapter::Kind::software);
    }
}

TEST(Device, IsMadeOnThePreferredAdapterAndSaysWhy) {
    const Asked nothing("");
    const std::vector<Adapter> adapters = listAdapters();
    const auto preferred = preferredAdapter(adapters);
    ASSERT_TRUE(preferred);
    const Device device;
    EXPECT_EQ(device.info().adapterIndex, adapters[*preferred].index);
    EXPECT_EQ(device.info().adapter, adapters[*preferred].name);
    EXPECT_EQ(device.info().renderer, adapters[*preferred].renderer);
    EXPECT_EQ(device.info().adapterWhy, whyPreferred(adapters, *preferred));
}

TEST(Device, IsMadeOnTheAdapterThatIsAskedFor) {
    for (const Adapter& adapter : listAdapters()) {
        if (!adapter.problem.empty()) continue;
        for (const std::string& asked : {std::to_string(adapter.index), adapter.name}) {
            const Asked one(asked);
            const Device device;
            EXPECT_EQ(device.info().adapterIndex, adapter.index);
            EXPECT_EQ(device.info().platform, platformName(adapter.platform));
            EXPECT_EQ(device.info().renderer, adapter.renderer);
            EXPECT_EQ(device.info().adapterWhy, "--adapter " + asked);
        }
    }
    const Asked none("no such adapter");
    EXPECT_THAT(inputError([] { const Device device; }), HasSubstr("'no such adapter'"));
}

}  // namespace dustbench::gpu
