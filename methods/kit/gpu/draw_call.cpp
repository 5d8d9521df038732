#include "methods/kit/gpu/draw_call.h"

#include <epoxy/gl.h>

#include <utility>

#include "methods/kit/gpu/debug_output.h"

namespace dustbench::gpu {
namespace {

void enable(GLenum capability, bool on) {
    on ? glEnable(capability) : glDisable(capability);
}

GLenum modeOf(Primitives primitives) {
    switch (primitives) {
        case Primitives::triangles:
            return GL_TRIANGLES;
        case Primitives::triangleStrip:
            return GL_TRIANGLE_STRIP;
        case Primitives::points:
            return GL_POINTS;
        case Primitives::lines:
            return GL_LINES;
    }
    return GL_TRIANGLES;
}

void finish(const DrawState& state, const char* what) {
    if (state.storesToBuffers) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    throwOnDebugOutput(what);
}

std::pair<GLenum, GLenum> factorsOf(Blend blend) {
    switch (blend) {
        case Blend::none:
            return {GL_ONE, GL_ZERO};
        case Blend::premultiplied:
            return {GL_ONE, GL_ONE_MINUS_SRC_ALPHA};
        case Blend::additive:
            return {GL_ONE, GL_ONE};
        case Blend::revealing:
            return {GL_ZERO, GL_ONE_MINUS_SRC_COLOR};
    }
    return {GL_ONE, GL_ZERO};
}

void prepare(const Program& program, const VertexArray& vertices, const DrawState& state) {
    enable(GL_DEPTH_TEST, state.depthTest || state.depthWrite);
    glDepthFunc(state.depthTest ? GL_GEQUAL : GL_ALWAYS);
    glDepthMask(state.depthWrite ? GL_TRUE : GL_FALSE);
    enable(GL_CULL_FACE, state.cullBackFaces);
    enable(GL_BLEND, state.blend != Blend::none);
    const auto [source, destination] = factorsOf(state.blend);
    glBlendFunc(source, destination);
    if (state.blendOfOutput1) {
        const auto [source1, destination1] = factorsOf(*state.blendOfOutput1);
        glBlendFunci(1, source1, destination1);
    }
    program.use();
    vertices.bind();
}

}  // namespace

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

void draw(const Program& program, const VertexArray& vertices, const DrawState& state, Primitives primitives,
          int vertexCount, int instances) {
    if (vertexCount <= 0 || instances <= 0) return;
    prepare(program, vertices, state);
    glDrawArraysInstanced(modeOf(primitives), 0, vertexCount, instances);
    finish(state, "draw");
}

void drawIndexed(const Program& program, const VertexArray& vertices, const DrawState& state, Primitives primitives,
                 int indexCount, int instances) {
    if (indexCount <= 0 || instances <= 0) return;
    prepare(program, vertices, state);
    glDrawElementsInstanced(modeOf(primitives), indexCount, GL_UNSIGNED_INT, nullptr, instances);
    finish(state, "indexed draw");
}

void drawIndexedIndirect(const Program& program, const VertexArray& vertices, const DrawState& state,
                         Primitives primitives, const Buffer& arguments, std::size_t firstByte) {
    prepare(program, vertices, state);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, arguments.name().get());
    glDrawElementsIndirect(modeOf(primitives), GL_UNSIGNED_INT, reinterpret_cast<const void*>(firstByte));
    finish(state, "indirect draw");
}

}  // namespace dustbench::gpu
