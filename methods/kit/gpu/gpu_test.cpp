// Tests the GPU layer's contracts on this machine's OpenGL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <optional>

#include "gpu_shaders.h"
#include "methods/contract/errors.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/debug_output.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/queue_marks.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::gpu {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr ShaderFile coverVert{"test/cover.vert", R"(
uniform float depth;
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, depth, 1); })"};
constexpr ShaderFile colourFrag{"test/colour.frag", R"(
uniform vec4 value;
out vec4 colour;
void main() { colour = value; })"};

std::vector<float> channel(const std::vector<float>& rgba, int which) {
    std::vector<float> values;
    for (std::size_t i = static_cast<std::size_t>(which); i < rgba.size(); i += 4) values.push_back(rgba[i]);
    return values;
}

TEST(Device, IsOpenGL45AndSaysWhatItIs) {
    Device device;
    EXPECT_FALSE(device.info().renderer.empty());
    EXPECT_THAT(device.info().version, testing::StartsWith("4."));
}

TEST(Device, CanBeMadeAgainAfterItIsGone) {
    for (int i = 0; i < 3; ++i) Device device;
}

TEST(Buffer, GivesBackWhatWasWrittenByEitherWay) {
    Device device;
    std::vector<float> values(1000);
    std::iota(values.begin(), values.end(), 0.5f);
    Buffer written(device, "written", std::span<const float>(values));
    Buffer mapped(device, "mapped", values.size() * sizeof(float));
    std::ranges::copy(values, static_cast<float*>(mapped.mapForWriting(values.size() * sizeof(float))));
    mapped.unmap();
    std::vector<float> first(1000), second(1000);
    written.read(std::span<float>(first));
    mapped.read(std::span<float>(second));
    EXPECT_EQ(first, values);
    EXPECT_EQ(second, values);
    mapped.clear();
    mapped.read(std::span<float>(second));
    EXPECT_EQ(second, std::vector<float>(1000, 0));
    EXPECT_GE(device.maximumStorageBytes(), std::size_t{1} << 27);  // the minimum that OpenGL 4.5 guarantees
}

TEST(Buffer, RefusesMoreThanItHolds) {
    Device device;
    Buffer buffer(device, "small", 8);
    const std::vector<float> three(3);
    EXPECT_THROW(buffer.write(std::span<const float>(three)), std::out_of_range);
    EXPECT_THROW((void)buffer.mapForWriting(9), std::out_of_range);
}

TEST(Buffer, CopiesTheStartOfAnother) {
    Device device;
    const std::vector<int> numbers{1, 2, 3, 4}, others{5, 6, 7};
    const Buffer from(device, "from", std::span<const int>(numbers));
    Buffer to(device, "to", std::span<const int>(others));
    to.copyFrom(from, 2 * sizeof(int));
    std::vector<int> found(3);
    to.read(std::span<int>(found));
    EXPECT_EQ(found, (std::vector<int>{1, 2, 7}));
    EXPECT_THROW(to.copyFrom(from, 4 * sizeof(int)), std::out_of_range);
}

constexpr ShaderFile groupsComp{"test/groups.comp", R"(
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Groups { uint groups, x, y, z; };
void main() {
    atomicAdd(groups, 1u);
    atomicMax(x, gl_WorkGroupID.x), atomicMax(y, gl_WorkGroupID.y), atomicMax(z, gl_WorkGroupID.z);
})"};

TEST(Program, TakesItsWorkGroupsFromABuffer) {
    Device device;
    const Program program(device, "groups", {groupsComp});
    const std::vector<std::uint32_t> sizes{9, 4, 3, 2};
    const Buffer arguments(device, "arguments", std::span<const std::uint32_t>(sizes));
    Buffer result(device, "groups", 4 * sizeof(std::uint32_t));
    result.clear();
    result.bindStorage(0);
    program.dispatchIndirect(arguments, sizeof(std::uint32_t));
    std::vector<std::uint32_t> found(4);
    result.read(std::span<std::uint32_t>(found));
    EXPECT_EQ(found, (std::vector<std::uint32_t>{24, 3, 2, 1}));
}

TEST(Ledger, CountsEveryByteAndForgetsWhatIsFreed) {
    Device device;
    const std::size_t before = device.ledger().totalBytes();
    {
        Buffer buffer(device, "a", 1000);
        Buffer moved = std::move(buffer);
        const Texture flat = Texture::make2D(device, "b", Format::rgba32F, 10, 20);
        const Texture volume = Texture::make3D(device, "c", Format::r16F, 4, 5, 6);
        const Texture mips = Texture::make2D(device, "d", Format::r8, 4, 4, Filter::mipmapped);
        EXPECT_EQ(device.ledger().totalBytes() - before, 1000u + 10 * 20 * 16 + 4 * 5 * 6 * 2 + (16 + 4 + 1));
    }
    EXPECT_EQ(device.ledger().totalBytes(), before);
}

TEST(Ledger, OfAScopeHoldsWhatIsMadeInIt) {
    Device device;
    const std::size_t before = device.ledger().totalBytes();
    MemoryLedger first, second;
    std::optional<Buffer> ofFirst, ofSecond;
    {
        const LedgerScope scope(device, first);
        ofFirst.emplace(device, "a", 100);
        const LedgerScope inner(device, second);
        ofSecond.emplace(device, "a", 7);
    }
    const Buffer own(device, "a", 1000);
    EXPECT_EQ(first.totalBytes(), 100u);
    EXPECT_EQ(second.totalBytes(), 7u);
    EXPECT_EQ(device.ledger().totalBytes() - before, 1000u);
    ofFirst.reset();
    EXPECT_EQ(first.totalBytes(), 0u) << "released where it was booked";
    EXPECT_EQ(second.totalBytes(), 7u);
}

TEST(Texture, SaysWhichOneIsTooLarge) {
    Device device;
    const std::size_t before = device.ledger().totalBytes();
    try {
        const Texture texture = Texture::make2D(device, "too large", Format::rgba8, 1 << 24, 1);
        FAIL() << "made";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("too large"));
    }
    EXPECT_EQ(device.ledger().totalBytes(), before);
}

TEST(Texture, WritesARectangleAndNothingElse) {
    Device device;
    Texture flat = Texture::make2D(device, "flat", Format::r8, 5, 4);
    flat.write(std::vector<std::uint8_t>(20, 0));
    flat.writeRectangle(1, 2, 3, 2, std::vector<std::uint8_t>{51, 102, 153, 204, 255, 51});
    const std::vector<float> values = flat.readFloats();
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 5; ++column) {
            const bool inside = column >= 1 && column < 4 && row >= 2;
            const std::array written{0.2f, 0.4f, 0.6f, 0.8f, 1.0f, 0.2f};
            const float expected = inside ? written[static_cast<std::size_t>(3 * (row - 2) + column - 1)] : 0.0f;
            EXPECT_NEAR(values[static_cast<std::size_t>(5 * row + column)], expected, 1e-6f) << column << ' ' << row;
        }
    EXPECT_THROW(flat.writeRectangle(3, 0, 3, 1, std::vector<std::uint8_t>(3)), std::invalid_argument);
    EXPECT_THROW(flat.writeRectangle(0, 0, 2, 1, std::vector<std::uint8_t>(3)), std::invalid_argument);
}

TEST(Buffer, WritesAPartAndNothingElse) {
    Device device;
    Buffer buffer(device, "b", std::span<const int>(std::vector<int>{1, 2, 3, 4, 5}));
    buffer.writeFrom(2, std::span<const int>(std::vector<int>{8, 9}));
    std::vector<int> values(5);
    buffer.read(std::span<int>(values));
    EXPECT_EQ(values, (std::vector<int>{1, 2, 8, 9, 5}));
    EXPECT_THROW(buffer.writeFrom(4, std::span<const int>(std::vector<int>{8, 9})), std::out_of_range);
}

TEST(Texture, GivesBackWhatWasWritten) {
    Device device;
    std::vector<float> values(4 * 5 * 6);
    std::iota(values.begin(), values.end(), 0.f);
    Texture volume = Texture::make3D(device, "volume", Format::r32F, 4, 5, 6);
    volume.write(std::span<const float>(values));
    EXPECT_EQ(volume.readFloats(), values);
    EXPECT_THROW(volume.write(std::span<const float>(values).first(7)), std::invalid_argument);
}

TEST(Framebuffer, AddsToSeveralColoursAtOnce) {
    Device device;
    const Texture first = Texture::make2D(device, "first", Format::rgba32F, 3, 2);
    const Texture second = Texture::make2D(device, "second", Format::r32F, 3, 2);
    const std::vector<const Texture*> both{&first, &second};
    const Framebuffer target(device, "both", both);
    const ShaderFile frag{"two.frag",
                          "layout(location = 0) out vec4 a;\nlayout(location = 1) out float b;\n"
                          "void main() { a = vec4(1, 2, 3, 4); b = 0.5; }"};
    const Program program(device, "two", {coverVert, frag});
    const VertexArray vertices(device);
    target.clearColour(1, 1, 1, 1);
    target.bind();
    for (int turn = 0; turn < 2; ++turn) draw(program, vertices, {.blend = Blend::additive}, Primitives::triangles, 3);
    for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(first.readFloats()[i], 1 + 2 * static_cast<float>(i % 4 + 1));
    for (const float value : second.readFloats()) EXPECT_EQ(value, 2);
    EXPECT_THROW((Framebuffer(device, "none", std::span<const Texture* const>())), std::invalid_argument);
}

/// Draws change only the part, in framebuffers of its size; clears are whole, and so is everything once it is gone.
TEST(DrawnPart, LimitsDrawsOfItsSizeAndNothingElse) {
    Device device;
    const Texture picture = Texture::make2D(device, "picture", Format::rgba32F, 8, 4);
    const Texture other = Texture::make2D(device, "other", Format::rgba32F, 8, 5);
    const Framebuffer target(device, "picture", &picture, nullptr), otherTarget(device, "other", &other, nullptr);
    Program program(device, "fill", {coverVert, colourFrag});
    program.set("depth", 0.5f);
    const VertexArray vertices(device);
    const auto fill = [&](const Framebuffer& framebuffer, float red) {
        framebuffer.bind();
        program.set("value", glm::vec4(red, 0, 0, 1));
        draw(program, vertices, {}, Primitives::triangles, 3);
    };
    const auto count = [](const Texture& texture, float red) {
        return std::ranges::count(channel(texture.readFloats(), 0), red);
    };
    {
        const DrawnPart part(8, 4, 2, 1, 3, 2);
        target.clearColour(0.25f, 0, 0, 1);
        fill(target, 0.5f);
        EXPECT_EQ(count(picture, 0.5f), 6);
        EXPECT_EQ(count(picture, 0.25f), 26);
        fill(otherTarget, 0.5f);
        EXPECT_EQ(count(other, 0.5f), 40);
        fill(target, 0.75f);
        target.clearColour(0.125f, 0, 0, 1);
        EXPECT_EQ(count(picture, 0.125f), 32);
        fill(target, 0.5f);
        EXPECT_EQ(count(picture, 0.5f), 6);
    }
    fill(target, 1);
    EXPECT_EQ(count(picture, 1), 32);
}

TEST(Program, NamesTheFileThatDoesNotCompile) {
    Device device;
    const ShaderFile broken{"somewhere/broken.frag", "out vec4 c;\nvoid main() { c = nonsense; }"};
    try {
        const Program program(device, "broken", {coverVert, broken});
        FAIL() << "compiled";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("somewhere/broken.frag"));
        EXPECT_THAT(error.what(), HasSubstr("nonsense"));
    }
}

TEST(Program, RefusesUniformsItDoesNotHave) {
    Device device;
    Program program(device, "cover", {coverVert, colourFrag});
    EXPECT_THROW(program.set("depht", 1.f), std::invalid_argument);
}

TEST(Program, DefinitionsReachTheShader) {
    Device device;
    const ShaderFile text{"test/define.comp",
                          "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer B { float b[]; };\n"
                          "void main() { b[0] = ANSWER; }"};
    Program program(device, "define", {text}, {{"ANSWER", "42.0"}});
    Buffer buffer(device, "b", sizeof(float));
    buffer.bindStorage(0);
    program.dispatch(1, 1, 1);
    float answer = 0;
    buffer.read(std::span<float>(&answer, 1));
    EXPECT_EQ(answer, 42.f);
}

TEST(Draw, BlendsPremultipliedColourOver) {
    Device device;
    const Texture target = Texture::make2D(device, "target", Format::rgba32F, 8, 8);
    const Framebuffer framebuffer(device, "target", &target, nullptr);
    const VertexArray nothing(device);
    Program program(device, "cover", {coverVert, colourFrag});
    program.set("depth", 0.5f);
    framebuffer.clearColour(0, 0, 0, 0);
    framebuffer.bind();
    for (const float alpha : {0.25f, 0.5f}) {
        program.set("value", glm::vec4(alpha * 0.8f, 0, 0, alpha));
        draw(program, nothing, {.blend = Blend::premultiplied}, Primitives::triangles, 3);
    }
    EXPECT_THAT(channel(target.readFloats(), 3), Each(testing::FloatEq(1 - 0.75f * 0.5f)));
    EXPECT_THAT(channel(target.readFloats(), 0), Each(testing::FloatNear(0.8f * (1 - 0.75f * 0.5f), 1e-6f)));
}

TEST(Layer, TestsTheScenesDepthAndLeavesItAsItWas) {
    Device device;
    const Texture depth = Texture::make2D(device, "depth", Format::depth32F, 8, 8);
    const Framebuffer scene(device, "scene", nullptr, &depth);
    const VertexArray nothing(device);
    Program program(device, "cover", {coverVert, colourFrag});
    program.set("value", glm::vec4(1));
    program.set("depth", 0.5f);
    scene.clearDepth();
    scene.bind();
    draw(program, nothing, {.depthTest = true, .depthWrite = true}, Primitives::triangles, 3);

    Layer layer(device, depth);
    const auto alphaAt = [&](float behind) {
        layer.clear();
        layer.bindWithSceneDepth();
        program.set("depth", behind);
        draw(program, nothing, {.depthTest = true, .blend = Blend::premultiplied}, Primitives::triangles, 3);
        return channel(layer.colour().readFloats(), 3);
    };
    EXPECT_THAT(alphaAt(0.4f), Each(0.f));  // reversed depth: smaller is farther
    EXPECT_THAT(alphaAt(0.6f), Each(1.f));
    EXPECT_THAT(depth.readFloats(), Each(0.5f));
}

TEST(Fence, WaitsForTheWorkBeforeIt) {
    Device device;
    std::vector<float> values(64 * 1024, 0.25f);
    Buffer buffer(device, "values", std::span<const float>(values));
    Program load(device, "load", {gpu_shaders::busy_comp});
    buffer.bindStorage(0);
    load.set("rounds", 1000);
    TimerQuery query(device);
    query.begin();
    load.dispatch(1024, 1, 1);
    query.end();
    Fence fence = Fence::afterQueuedWork();
    fence.wait();
    EXPECT_TRUE(query.milliseconds().has_value());
    fence.wait();  // no marker left: returns at once
}

TEST(TimerQuery, SelfTestComesToAnAnswer) {
    Device device;
    const bool trusted = timerQueriesAreTrue(device);
    const bool isSoftware = device.info().renderer.starts_with("llvmpipe");
    EXPECT_FALSE(isSoftware && trusted);
}

#ifdef DUSTBENCH_CHECKED
TEST(DebugOutput, TurnsAWrongCallIntoAnException) {
    Device device;
    const Program load(device, "load", {gpu_shaders::busy_comp});
    EXPECT_THROW(load.dispatch(1 << 30, 1, 1), std::runtime_error);
    EXPECT_NO_THROW(device.finish());
}
#endif

}  // namespace
}  // namespace dustbench::gpu
