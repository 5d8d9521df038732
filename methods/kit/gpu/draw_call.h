// A draw call: its vertices, its fixed-function state, and the call. Every draw sets all of its state, so that no state
// leaks into the next pass.
#pragma once

#include <cstdint>
#include <optional>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/ownership.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::gpu {

enum class Advance { perVertex, perInstance };

/// Assigns buffers to vertex attributes. Owns the OpenGL vertex array, not the buffers, which must outlive it.
class DUSTBENCH_API VertexArray {
 public:
    VertexArray() = default;
    explicit VertexArray(Device& device);

    /// Attribute `location` reads `components` floats at `offset` of each element of `stride` bytes.
    void attribute(int location, int components, const Buffer& buffer, std::size_t stride, std::size_t offset,
                   Advance advance = Advance::perVertex);
    /// Indices are 32-bit.
    void indices(const Buffer& buffer);

    void bind() const;

 private:
    Name name_;
};

enum class Blend {
    none,
    premultiplied,  ///< C = Cs + (1 − αs)·Cd, the same for α
    additive,       ///< C = Cs + Cd
    revealing,      ///< C = (1 − Cs)·Cd
};

struct DrawState {
    bool depthTest = false;  ///< passes where nearer or equal (reversed depth)
    bool depthWrite = false;
    Blend blend = Blend::none;
    std::optional<Blend> blendOfOutput1{};  ///< if it differs from `blend`; neither may be `none`
    bool cullBackFaces = false;
    bool storesToBuffers = false;  ///< subsequent commands see what the shaders store
};

enum class Primitives { triangles, triangleStrip, points, lines };

DUSTBENCH_API void draw(const Program& program, const VertexArray& vertices, const DrawState& state,
                        Primitives primitives, int vertexCount, int instances = 1);
DUSTBENCH_API void drawIndexed(const Program& program, const VertexArray& vertices, const DrawState& state,
                               Primitives primitives, int indexCount, int instances = 1);

/// The same with the five numbers of the call (indices, instances, first index, base vertex, base instance) read from
/// `arguments` when the command runs.
DUSTBENCH_API void drawIndexedIndirect(const Program& program, const VertexArray& vertices, const DrawState& state,
                                       Primitives primitives, const Buffer& arguments, std::size_t firstByte);

}  // namespace dustbench::gpu
