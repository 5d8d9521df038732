// Draws many small shapes in one instanced draw call; shaders pull the shapes' values from a buffer.
//
// Several shapes share one instance, because with one shape per instance software rasterisers run their vertex pipeline
// once per shape (reports/decisions/0002-billboard-drawing.md). Shaders get the definitions SHAPES_AT_ONCE and FLOATS,
// and COLOURED if each shape has its own colour. They read `values[]` at storage binding 0; the uniform `count` is the
// number of shapes. Dust in GPU buffers is gathered into the same values there.
//
// Owns: values, corners and programs, on the GPU. Threads: the OpenGL thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "methods/contract/method.h"
#include "methods/contract/view.h"
#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/layer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/shader_file.h"

namespace dustbench::draw {

/// Layout of the values of one shape.
struct InstanceLayout {
    std::size_t floats = 0;  ///< total per shape, colour included
    bool coloured = false;   ///< red green blue at the end, unless all shapes share one colour
};

/// A fragment shader for shapes that replaces the pass's own, the `.glsl` pieces of both stages, and the programs built
/// from them.
struct FragmentPass {
    const char* name;  ///< used in labels and messages
    std::vector<gpu::ShaderFile> files;
    std::map<std::string, std::string> definitions{};
    std::optional<gpu::Program> oneColour{}, ownColours{};            ///< compiled on first use
    std::optional<gpu::Program> oneColourOnGpu{}, ownColoursOnGpu{};  ///< for gathered puffs
};

/// Base class for a pass that draws one kind of shape.
class DUSTBENCH_API InstanceBatch {
 public:
    /// Maps GPU memory for `count` shapes in drawing order; write-only. Fill it, then call `unmap`.
    [[nodiscard]] std::span<float> map(std::size_t count, const InstanceLayout& layout);
    void unmap();

    /// Gathers the puffs on the GPU as x y z radius opacity [red green blue], in their order or that of the indices in
    /// `order`; only for shapes whose shaders read the number of puffs there (COUNT_ON_GPU).
    void gather(const GpuPuffs& dust, const gpu::Buffer* order = nullptr);

    /// Of gathered puffs, a bound.
    [[nodiscard]] std::size_t count() const { return count_; }
    /// The number of gathered puffs, in word 0; null if it is `count`.
    [[nodiscard]] const gpu::Buffer* countOnGpu() const { return gathered_ ? &drawn_ : nullptr; }
    [[nodiscard]] const InstanceLayout& layoutOfAll() const { return layout_; }
    /// For Method::primitives.
    [[nodiscard]] std::int64_t primitives() const {
        return gathered_ ? Method::onePerPuff : static_cast<std::int64_t>(count_);
    }
    /// Of puffs that were gathered on the GPU, which alone knows their number.
    [[nodiscard]] bool isGathered() const { return gathered_; }
    /// Binds the values of the shapes mapped last, for a pass that does not draw them.
    void bindValues(std::uint32_t binding) const { instances_.bindStorage(binding); }
    /// Binds the number of gathered puffs, an int at its beginning.
    void bindNumber(std::uint32_t binding) const { drawn_.bindStorage(binding); }
    [[nodiscard]] std::size_t gpuBytes() const { return instances_.bytes() + corners_.bytes() + drawn_.bytes(); }

 protected:
    struct Shape {
        const char* name;  ///< used in labels and messages: `cubes`
        gpu::ShaderFile vertex, fragment;
        std::vector<std::uint32_t> corners;  ///< vertex numbers of one shape's triangles
        std::uint32_t vertices;              ///< per shape; the next shape's vertex numbers begin after them
        std::size_t atOnce;                  ///< shapes per instance
        std::map<std::string, std::string> definitions{};
        /// Points and lines have no corners; their shaders receive vertex numbers, `vertices` per shape.
        gpu::Primitives primitives = gpu::Primitives::triangles;
        std::vector<gpu::ShaderFile> pieces{};  ///< `.glsl`, of both stages
    };
    InstanceBatch(gpu::Device& device, Shape shape);
    ~InstanceBatch() = default;

    /// The program for the instances mapped last, compiled on first use. Sets `count`, `eye` and `worldToEye`; the pass
    /// sets its own uniforms.
    [[nodiscard]] gpu::Program& program(const scene::View& view) { return program(view, own_); }
    [[nodiscard]] gpu::Program& program(const scene::View& view, FragmentPass& fragments);
    /// Draws the instances mapped last into the bound target.
    void drawInstances(const gpu::Program& program, const gpu::DrawState& state);
    /// The same, blended into `layer` with the scene's depth test; sets `projection`.
    void drawWithinScene(gpu::Program& program, const scene::View& view, const gpu::Layer& layer);

 private:
    gpu::Device& device_;
    Shape shape_;
    gpu::Buffer instances_, corners_;
    gpu::Buffer drawn_;  ///< of gathered puffs: their number, then the arguments of the draw call
    std::optional<gpu::Program> gather_, gatherColoured_;
    bool gathered_ = false;
    gpu::VertexArray vertices_;
    FragmentPass own_;
    InstanceLayout layout_;
    std::size_t count_ = 0;
};

}  // namespace dustbench::draw
