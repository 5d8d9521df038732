#include "methods/kit/draw/instance_batch.h"

#include <utility>

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
    const std::size_t floats = count * layout.floats;
    if (floats == 0) return {};
    if (floats * sizeof(float) > instances_.bytes())
        instances_ = gpu::Buffer(device_, shape_.name, (floats + floats / 8) * sizeof(float));
    return {static_cast<float*>(instances_.mapForWriting(floats * sizeof(float))), floats};
}

void InstanceBatch::unmap() {
    if (count_ > 0) instances_.unmap();
}

gpu::Program& InstanceBatch::program(const scene::View& view, FragmentPass& fragments) {
    std::optional<gpu::Program>& made = layout_.coloured ? fragments.ownColours : fragments.oneColour;
    if (!made) {
        std::map<std::string, std::string> definitions = shape_.definitions;
        definitions["SHAPES_AT_ONCE"] = std::to_string(shape_.atOnce);
        definitions["FLOATS"] = std::to_string(layout_.floats);
        if (layout_.coloured) definitions["COLOURED"] = "";
        definitions.insert(fragments.definitions.begin(), fragments.definitions.end());
        std::vector<gpu::ShaderFile> files = fragments.files;
        files.push_back(shape_.vertex);
        made.emplace(device_, fragments.name, std::span<const gpu::ShaderFile>(files), definitions);
    }
    made->set("count", static_cast<int>(count_));
    made->set("eye", glm::vec3(view.camera.eye));
    made->set("worldToEye", view.worldToEye());
    return *made;
}

void InstanceBatch::drawInstances(const gpu::Program& program, const gpu::DrawState& state) {
    instances_.bindStorage(0);
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
