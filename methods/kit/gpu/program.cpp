#include "methods/kit/gpu/program.h"

#include <epoxy/gl.h>

#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>
#include <utility>

#include "methods/kit/gpu/debug_output.h"

namespace dustbench::gpu {
namespace {

GLenum stageOf(std::string_view file) {
    if (file.ends_with(".vert")) return GL_VERTEX_SHADER;
    if (file.ends_with(".frag")) return GL_FRAGMENT_SHADER;
    if (file.ends_with(".comp")) return GL_COMPUTE_SHADER;
    throw std::invalid_argument("shader '" + std::string(file) + "': expected .vert, .frag or .comp");
}

std::string logOf(GLuint name, decltype(glGetShaderiv) getParameter, decltype(glGetShaderInfoLog) getLog) {
    GLint length = 0;
    getParameter(name, GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
    GLsizei written = 0;
    getLog(name, length, &written, log.data());
    log.resize(static_cast<std::size_t>(written));
    return log;
}

std::function<void(std::string_view, std::span<const CompiledShader>)>& programListener() {
    static std::function<void(std::string_view, std::span<const CompiledShader>)> one;
    return one;
}

Name compile(const CompiledShader& shader) {
    const GLuint name = glCreateShader(stageOf(shader.file.name));
    Name owned(name, [](std::uint32_t value) { glDeleteShader(value); });
    const char* source = shader.source.c_str();
    glShaderSource(name, 1, &source, nullptr);
    glCompileShader(name);
    GLint compiled = GL_FALSE;
    glGetShaderiv(name, GL_COMPILE_STATUS, &compiled);
    if (!compiled)
        throw std::runtime_error("shader " + std::string(shader.file.name) + " does not compile:\n" +
                                 logOf(name, glGetShaderiv, glGetShaderInfoLog));
    return owned;
}

}  // namespace

void listenToPrograms(std::function<void(std::string_view, std::span<const CompiledShader>)> listener) {
    programListener() = std::move(listener);
}

Program::Program(Device&, std::string_view label, std::span<const ShaderFile> files,
                 const std::map<std::string, std::string>& definitions)
    : label_(label) {
    std::string preamble = "#version 450 core\n";
    for (const auto& [key, value] : definitions) preamble += "#define " + key + " " + value + "\n";
    for (const ShaderFile& file : files)
        if (file.name.ends_with(".glsl")) preamble += "#line 1\n" + std::string(file.text) + "\n";

    std::vector<CompiledShader> sources;
    for (const ShaderFile& file : files)
        if (!file.name.ends_with(".glsl")) sources.push_back({file, preamble + "#line 1\n" + std::string(file.text)});
    if (programListener()) programListener()(label, sources);

    const GLuint name = glCreateProgram();
    name_ = Name(name, [](std::uint32_t value) { glDeleteProgram(value); });
    glObjectLabel(GL_PROGRAM, name, static_cast<GLsizei>(label.size()), label.data());
    std::vector<Name> shaders;
    for (const CompiledShader& source : sources) {
        shaders.push_back(compile(source));
        glAttachShader(name, shaders.back().get());
    }
    glLinkProgram(name);
    GLint linked = GL_FALSE;
    glGetProgramiv(name, GL_LINK_STATUS, &linked);
    if (!linked)
        throw std::runtime_error("program '" + label_ + "' does not link:\n" +
                                 logOf(name, glGetProgramiv, glGetProgramInfoLog));
    for (const Name& shader : shaders) glDetachShader(name, shader.get());
}

int Program::location(std::string_view uniform) {
    if (const auto known = locations_.find(uniform); known != locations_.end()) return known->second;
    const std::string text(uniform);
    const int found = glGetUniformLocation(name_.get(), text.c_str());
    if (found < 0) throw std::invalid_argument("program '" + label_ + "' has no uniform '" + text + "'");
    return locations_.emplace(text, found).first->second;
}

void Program::set(std::string_view uniform, float value) {
    glProgramUniform1f(name_.get(), location(uniform), value);
}

void Program::set(std::string_view uniform, int value) {
    glProgramUniform1i(name_.get(), location(uniform), value);
}

void Program::set(std::string_view uniform, glm::ivec3 value) {
    glProgramUniform3iv(name_.get(), location(uniform), 1, glm::value_ptr(value));
}

void Program::set(std::string_view uniform, glm::vec2 value) {
    glProgramUniform2fv(name_.get(), location(uniform), 1, glm::value_ptr(value));
}

void Program::set(std::string_view uniform, glm::vec3 value) {
    glProgramUniform3fv(name_.get(), location(uniform), 1, glm::value_ptr(value));
}

void Program::set(std::string_view uniform, glm::vec4 value) {
    glProgramUniform4fv(name_.get(), location(uniform), 1, glm::value_ptr(value));
}

void Program::set(std::string_view uniform, const glm::mat4& value) {
    glProgramUniformMatrix4fv(name_.get(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

void Program::use() const {
    glUseProgram(name_.get());
}

void Program::dispatch(int groupsX, int groupsY, int groupsZ) const {
    use();
    glDispatchCompute(static_cast<GLuint>(groupsX), static_cast<GLuint>(groupsY), static_cast<GLuint>(groupsZ));
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    throwOnDebugOutput(label_);
}

void Program::dispatchIndirect(const Buffer& groups, std::size_t firstByte) const {
    use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, groups.name().get());
    glDispatchComputeIndirect(static_cast<GLintptr>(firstByte));
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
    throwOnDebugOutput(label_);
}

}  // namespace dustbench::gpu
