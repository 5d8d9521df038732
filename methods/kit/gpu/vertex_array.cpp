#include "methods/kit/gpu/vertex_array.h"

#include <epoxy/gl.h>

namespace dustbench::gpu {

VertexArray::VertexArray(Device&) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    name_ = Name(name, [](std::uint32_t value) { glDeleteVertexArrays(1, &value); });
}

void VertexArray::attribute(int location, int components, const Buffer& buffer, std::size_t stride, std::size_t offset,
                            Advance advance) {
    const auto slot = static_cast<GLuint>(location);  // one binding point per attribute, so that buffers are never
                                                      // mixed up
    glVertexArrayVertexBuffer(name_.get(), slot, buffer.name().get(), 0, static_cast<GLsizei>(stride));
    glEnableVertexArrayAttrib(name_.get(), slot);
    glVertexArrayAttribFormat(name_.get(), slot, components, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
    glVertexArrayAttribBinding(name_.get(), slot, slot);
    glVertexArrayBindingDivisor(name_.get(), slot, advance == Advance::perInstance ? 1 : 0);
}

void VertexArray::indices(const Buffer& buffer) {
    glVertexArrayElementBuffer(name_.get(), buffer.name().get());
}

void VertexArray::bind() const {
    glBindVertexArray(name_.get());
}

}  // namespace dustbench::gpu
