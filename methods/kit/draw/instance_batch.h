// Many small shapes in one instanced draw call: their values in a buffer that shaders pull from.
//
// Several shapes share one instance, because one each costs software rasterisers a run of their vertex pipeline a shape
// (reports/decisions/0002-billboard-drawing.md). Shaders are given SHAPES_AT_ONCE and FLOATS, and COLOURED where each
// shape brings a colour of its own; they read `values[]` at storage binding 0 and are told `count`, how many there are.
//
// Owns: values, corners and programs, on the GPU. Threads: the OpenGL thread's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "methods/contract/view.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/shader_file.h"
#include "methods/kit/gpu/vertex_array.h"

namespace dustbench::draw {

/// Where the values of one shape lie.
struct InstanceLayout {
    std::size_t floats = 0;  ///< in all, the colour included
    bool coloured = false;   ///< red green blue at the end, where not all have one colour
};

/// For a pass of one kind of shape to derive from.
class DUSTBENCH_API InstanceBatch {
 public:
    /// GPU memory for `count` shapes in drawing order; write-only, to be filled and unmapped.
    [[nodiscard]] std::span<float> map(std::size_t count, const InstanceLayout& layout);
    void unmap();

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] std::size_t gpuBytes() const { return instances_.bytes() + corners_.bytes(); }

 protected:
    struct Shape {
        const char* name;  ///< in labels and messages: `cubes`
        gpu::ShaderFile vertex, fragment;
        std::vector<std::uint32_t> corners;  ///< vertex numbers of one shape's triangles
        std::uint32_t vertices;              ///< of one shape: the next one's numbers begin after them
        std::size_t atOnce;                  ///< shapes in an instance
        std::map<std::string, std::string> definitions{};
        /// Points and lines have no corners: their shaders count vertices, `vertices` of each shape.
        gpu::Primitives primitives = gpu::Primitives::triangles;
    };
    InstanceBatch(gpu::Device& device, Shape shape);
    ~InstanceBatch() = default;

    /// For what was mapped last, made when first wanted; `count`, `eye` and `worldToEye` are set, the pass's own
    /// uniforms are not.
    [[nodiscard]] gpu::Program& program(const scene::View& view);
    /// Draws what was mapped last into the target that is bound.
    void drawInstances(const gpu::Program& program, const gpu::DrawState& state);
    /// The same, blended into `layer` where nothing of the scene is nearer; `projection` is set for it.
    void drawWithinScene(gpu::Program& program, const scene::View& view, const gpu::Layer& layer);
    [[nodiscard]] const InstanceLayout& layoutOfAll() const { return layout_; }

 private:
    gpu::Device& device_;
    Shape shape_;
    gpu::Buffer instances_, corners_;
    gpu::VertexArray vertices_;
    std::optional<gpu::Program> oneColour_, ownColours_;
    InstanceLayout layout_;
    std::size_t count_ = 0;
};

}  // namespace dustbench::draw
