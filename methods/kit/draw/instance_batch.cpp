#include "methods/kit/draw/instance_batch.h"

#include <algorithm>
#include <utility>

#include "draw_shaders.h"

namespace dustbench::draw {
namespace {

gpu::Buffer makeCorners(gpu::Device& device, const auto& shape) {
    std::vector<std::uint32_t> corners;
    corners.reserve(shape.atOnce * shape.corners.size());
    for (std::uint32_t i = 0; i < shape.atOnce; ++i)
        for (const std::uint32_t corner : shape.corners) corners.push_back(i * shape.vertices + corner);
    return {device, std::string(shape.name) + ": corners", std::span<const std::uint32_t>(corners)};
}

}  // namespace

InstanceBatch::InstanceBatch(gpu::Device& device, Shape shape)
    : device_(device),
      shape_(std::move(shape)),
      corners_(makeCorners(device, shape_)),
      vertices_(device),
      own_{shape_.name, shape_.pieces} {
    own_.files.push_back(shape_.fragment);
    vertices_.indices(corners_);
}

std::span<float> InstanceBatch::map(std::size_t count, const InstanceLayout& layout) {
    count_ = count;
    layout_ = layout;
    gathered_ = false;
    const std::size_t floats = count * layout.floats;
    if (floats == 0) return {};
    if (floats * sizeof(float) > instances_.bytes())
        instances_ = gpu::Buffer(device_, shape_.name, (floats + floats / 8) * sizeof(float));
    return {static_cast<float*>(instances_.mapForWriting(floats * sizeof(float))), floats};
}

void InstanceBatch::gather(const GpuPuffs& dust, const gpu::Buffer* order) {
    constexpr std::size_t word = sizeof(std::uint32_t), drawnWords = 6;
    const bool coloured = dust.colour != nullptr;
    count_ = dust.bound;
    layout_ = {coloured ? 8u : 5u, coloured};
    gathered_ = true;
    std::optional<gpu::Program>& program = coloured ? gatherColoured_ : gather_;
    if (!program) {
        std::map<std::string, std::string> definitions{
            {"SHAPES_AT_ONCE", std::to_string(shape_.atOnce) + "u"},
            {"INDICES", std::to_string(shape_.corners.size() * shape_.atOnce) + "u"},
            {"FLOATS", std::to_string(layout_.floats) + "u"}};
        if (coloured) definitions["COLOURED"] = "";
        program.emplace(device_, "gather puffs", std::initializer_list<gpu::ShaderFile>{draw_shaders::gather_comp},
                        definitions);
    }
    if (drawn_.bytes() == 0) drawn_ = gpu::Buffer(device_, "drawn puffs", drawnWords * word);
    drawn_.clear();
    const std::size_t bytes = count_ * layout_.floats * sizeof(float);
    if (bytes > instances_.bytes())
        instances_ = gpu::Buffer(device_, shape_.name, std::max(bytes, 2 * instances_.bytes()));
    if (bytes == 0) return;
    program->set("ordered", order ? 1 : 0);
    instances_.bindStorage(0);
    dust.position->bindStorage(1);
    dust.look->bindStorage(2);
    if (coloured) dust.colour->bindStorage(3);
    if (order) order->bindStorage(4);
    dust.tally->bindStorage(5);
    drawn_.bindStorage(6);
    program->dispatchIndirect(*dust.tally, word);
}

void InstanceBatch::unmap() {
    if (count_ > 0) instances_.unmap();
}

gpu::Program& InstanceBatch::program(const scene::View& view, FragmentPass& fragments) {
    std::optional<gpu::Program>& onCpu = layout_.coloured ? fragments.ownColours : fragments.oneColour;
    std::optional<gpu::Program>& onGpu = layout_.coloured ? fragments.ownColoursOnGpu : fragments.oneColourOnGpu;
    std::optional<gpu::Program>& made = gathered_ ? onGpu : onCpu;
    if (!made) {
        std::map<std::string, std::string> definitions = shape_.definitions;
        definitions["SHAPES_AT_ONCE"] = std::to_string(shape_.atOnce);
        definitions["FLOATS"] = std::to_string(layout_.floats);
        if (layout_.coloured) definitions["COLOURED"] = "";
        if (gathered_) definitions["COUNT_ON_GPU"] = "";
        definitions.insert(fragments.definitions.begin(), fragments.definitions.end());
        std::vector<gpu::ShaderFile> files = fragments.files;
        files.push_back(shape_.vertex);
        made.emplace(device_, fragments.name, std::span<const gpu::ShaderFile>(files), definitions);
    }
    if (!gathered_) made->set("count", static_cast<int>(count_));
    made->set("eye", glm::vec3(view.camera.eye));
    made->set("worldToEye", view.worldToEye());
    return *made;
}

void InstanceBatch::drawInstances(const gpu::Program& program, const gpu::DrawState& state) {
    instances_.bindStorage(0);
    if (gathered_) {
        drawn_.bindStorage(7);
        gpu::drawIndexedIndirect(program, vertices_, state, gpu::Primitives::triangles, drawn_, sizeof(std::uint32_t));
        return;
    }
    if (shape_.primitives != gpu::Primitives::triangles) {
        gpu::draw(program, vertices_, state, shape_.primitives, static_cast<int>(shape_.vertices * count_));
        return;
    }
    gpu::drawIndexed(program, vertices_, state, gpu::Primitives::triangles,
                     static_cast<int>(shape_.corners.size() * shape_.atOnce),
                     static_cast<int>((count_ + shape_.atOnce - 1) / shape_.atOnce));
}

void InstanceBatch::drawWithinScene(gpu::Program& program, const scene::View& view, const gpu::Layer& layer) {
    const glm::mat4 eyeToClip = view.eyeToClip();
    program.set("projection", glm::vec3(eyeToClip[0][0], eyeToClip[1][1], view.camera.nearMetres));
    gpu::DrawState state;
    state.blend = gpu::Blend::premultiplied;
    state.depthTest = true;
    layer.bindWithSceneDepth();
    drawInstances(program, state);
}

}  // namespace dustbench::draw
