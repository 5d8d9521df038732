// Assigns buffers to vertex attributes.
//
// Owns: the OpenGL vertex array, not the buffers, which must outlive it.
#pragma once

#include <cstdint>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/name.h"

namespace dustbench::gpu {

enum class Advance { perVertex, perInstance };

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

}  // namespace dustbench::gpu
