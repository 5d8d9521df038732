#include "methods/kit/gpu/buffer.h"

#include <epoxy/gl.h>

#include <stdexcept>
#include <string>

#include "methods/kit/gpu/debug_output.h"

namespace dustbench::gpu {
namespace {

Name makeBuffer(std::string_view label, std::size_t bytes) {
    GLuint name = 0;
    glCreateBuffers(1, &name);
    Name owned(name, [](std::uint32_t value) { glDeleteBuffers(1, &value); });
    if (bytes > 0)
        glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes), nullptr,
                             GL_DYNAMIC_STORAGE_BIT | GL_MAP_WRITE_BIT | GL_MAP_READ_BIT);
    requireAllocated(label, bytes);
    glObjectLabel(GL_BUFFER, name, static_cast<GLsizei>(label.size()), label.data());
    throwOnDebugOutput(label);
    return owned;
}

void requireFit(std::size_t wanted, std::size_t have) {
    if (wanted > have)
        throw std::out_of_range("GPU buffer of " + std::to_string(have) + " bytes cannot hold " +
                                std::to_string(wanted));
}

}  // namespace

Buffer::Buffer(Device& device, std::string_view label, std::size_t bytes)
    : name_(makeBuffer(label, bytes)), booking_(device.ledger().account(label), bytes) {}

void Buffer::writeBytes(const void* data, std::size_t bytes, std::size_t from) {
    requireFit(from + bytes, this->bytes());
    if (bytes > 0) glNamedBufferSubData(name_.get(), static_cast<GLintptr>(from), static_cast<GLsizeiptr>(bytes), data);
    throwOnDebugOutput("writing a buffer");
}

void Buffer::readBytes(void* data, std::size_t bytes) const {
    requireFit(bytes, this->bytes());
    if (bytes > 0) glGetNamedBufferSubData(name_.get(), 0, static_cast<GLsizeiptr>(bytes), data);
}

void Buffer::copyFrom(const Buffer& other, std::size_t bytes) {
    requireFit(bytes, this->bytes());
    requireFit(bytes, other.bytes());
    if (bytes > 0) glCopyNamedBufferSubData(other.name_.get(), name_.get(), 0, 0, static_cast<GLsizeiptr>(bytes));
    throwOnDebugOutput("copying a buffer");
}

void Buffer::clear() {
    const std::uint32_t zero = 0;
    if (bytes() % sizeof(zero) == 0)
        glClearNamedBufferData(name_.get(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &zero);
    else
        glClearNamedBufferData(name_.get(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, &zero);
    throwOnDebugOutput("clearing a buffer");
}

void* Buffer::mapForWriting(std::size_t bytes) {
    requireFit(bytes, this->bytes());
    void* memory = glMapNamedBufferRange(name_.get(), 0, static_cast<GLsizeiptr>(bytes),
                                         GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!memory) throw std::runtime_error("GPU buffer of " + std::to_string(this->bytes()) + " bytes cannot be mapped");
    return memory;
}

void Buffer::unmap() {
    glUnmapNamedBuffer(name_.get());
}

void Buffer::bindStorage(std::uint32_t binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name_.get());
}

void Buffer::bindUniform(std::uint32_t binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, name_.get());
}

}  // namespace dustbench::gpu
