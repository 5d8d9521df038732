// A linked program built from shader files.
//
// Owns: the OpenGL program. The files carry no #version line: version 450 core, the definitions given here and the
// shared `.glsl` pieces are prepended, so that compile errors name the file and its own line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/ownership.h"
#include "methods/kit/gpu/shader_file.h"

namespace dustbench::gpu {

class DUSTBENCH_API Program {
 public:
    Program() = default;
    /// The file extension selects the stage: .vert .frag .comp; .glsl pieces are prepended to each stage. `definitions`
    /// become `#define NAME VALUE` lines. Throws std::runtime_error with the driver's log.
    Program(Device& device, std::string_view label, std::initializer_list<ShaderFile> files,
            const std::map<std::string, std::string>& definitions = {})
        : Program(device, label, std::span<const ShaderFile>(files.begin(), files.size()), definitions) {}
    Program(Device& device, std::string_view label, std::span<const ShaderFile> files,
            const std::map<std::string, std::string>& definitions);

    /// Sets a uniform. Throws std::invalid_argument if the program has no uniform of that name.
    void set(std::string_view uniform, float value);
    void set(std::string_view uniform, int value);
    void set(std::string_view uniform, glm::ivec3 value);
    void set(std::string_view uniform, glm::vec2 value);
    void set(std::string_view uniform, glm::vec3 value);
    void set(std::string_view uniform, glm::vec4 value);
    void set(std::string_view uniform, const glm::mat4& value);

    void use() const;
    /// Runs a compute program over the given work groups and makes its writes visible to subsequent commands.
    void dispatch(int groupsX, int groupsY, int groupsZ) const;
    /// The same, with the three numbers of work groups read from a buffer when the command runs.
    void dispatchIndirect(const Buffer& groups, std::size_t firstByte) const;

 private:
    [[nodiscard]] int location(std::string_view uniform);

    Name name_;
    std::string label_;
    std::map<std::string, int, std::less<>> locations_;
};

/// A shader as passed to OpenGL: the file and everything prepended to it.
struct CompiledShader {
    ShaderFile file;
    std::string source;
};
/// Calls `listener` with the shaders of every program made from now on, before OpenGL compiles them. For tests; an
/// empty listener removes it.
void listenToPrograms(std::function<void(std::string_view label, std::span<const CompiledShader>)> listener);

}  // namespace dustbench::gpu
