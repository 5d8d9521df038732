// Compiles every shader with every set of definitions with the reference compiler, because Mesa accepts code that other
// drivers refuse.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "source_folder.h"
#include "tests/shaders/captured_programs.h"

namespace dustbench::shaders {
namespace {
namespace fs = std::filesystem;

/// The shader files of the tree and their texts, including shared parts (.glsl).
const std::map<std::string, std::string>& shaderFiles() {
    static const std::map<std::string, std::string> all = [] {
        const std::set<std::string> kinds{".vert", ".frag", ".comp", ".glsl"};
        const fs::path root = DUSTBENCH_SOURCE_DIR;
        std::map<std::string, std::string> files;
        for (const char* folder : {"methods", "bench"})
            for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
                if (!kinds.contains(entry.path().extension())) continue;
                std::ifstream stream(entry.path(), std::ios::binary);
                files[entry.path().lexically_relative(root).generic_string()] = {std::istreambuf_iterator<char>(stream),
                                                                                 {}};
            }
        return files;
    }();
    return all;
}

/// The captured sources that contain a file.
std::set<std::string> sourcesWith(const std::string& text) {
    std::set<std::string> sources;
    for (const CapturedProgram& program : capturedPrograms())
        for (const CapturedShader& shader : program)
            if (shader.source.find(text) != std::string::npos) sources.insert(shader.source);
    return sources;
}

std::set<std::string> namesIn(const std::string& text, const std::string& pattern) {
    const std::regex expression(pattern);
    std::set<std::string> names;
    for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) names.insert((*at)[1]);
    return names;
}

/// The value of a name in a source's definition lines, with a space before it; nothing if it is not defined.
std::string valueOf(const std::string& name, const std::string& source) {
    const std::string line = "\n#define " + name + " ";
    const std::size_t at = source.find(line);
    if (at == std::string::npos) return "";
    const std::size_t start = at + line.size() - 1;
    return source.substr(start, source.find('\n', start) - start);
}

struct Validated {
    int status = 0;
    std::string output;
};

/// Compiles and links the stages of a program. The files have recognisable names.
Validated validate(const CapturedProgram& program, const fs::path& folder) {
    fs::create_directories(folder);
    std::string command = "glslangValidator -l";
    for (const CapturedShader& shader : program) {
        const fs::path file = folder / fs::path(shader.file).filename();
        std::ofstream(file, std::ios::binary) << shader.source;
        command += " '" + file.string() + "'";
    }
    Validated result;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return {-1, "no process"};
    std::array<char, 4096> buffer;
    while (const std::size_t got = fread(buffer.data(), 1, buffer.size(), pipe))
        result.output.append(buffer.data(), got);
    result.status = pclose(pipe);
    return result;
}

}  // namespace

TEST(Shaders, AreAllGivenToOpenGl) {
    ASSERT_GT(shaderFiles().size(), 40u);
    for (const auto& [file, text] : shaderFiles())
        EXPECT_FALSE(sourcesWith(text).empty())
            << file << " is never compiled: make captured_programs.cpp draw with it";
}

TEST(Shaders, AreGivenWithAndWithoutEachDefinitionThatTheyAskFor) {
    std::set<std::string> ownNames;  // defined by the files themselves
    for (const auto& [file, text] : shaderFiles()) ownNames.merge(namesIn(text, R"(#define\s+(\w+))"));
    for (const auto& [file, text] : shaderFiles()) {
        const std::set<std::string> sources = sourcesWith(text);
        for (const char* pattern :
             {R"(#ifn?def\s+(\w+))", R"(\bdefined\s*\(?\s*(\w+))", R"(#(?:el)?if\s+(\w+)\s*[=!<>])"})
            for (const std::string& name : namesIn(text, pattern)) {
                if (ownNames.contains(name)) continue;
                std::set<std::string> values;
                for (const std::string& source : sources) values.insert(valueOf(name, source));
                EXPECT_GE(values.size(), 2u)
                    << file << ": " << name << " never changes: make captured_programs.cpp draw with another value";
            }
    }
}

TEST(Shaders, AreValidGlsl) {
    const fs::path folder = fs::path(testing::TempDir()) / ("dustbench-shaders-" + std::to_string(getpid()));
    std::size_t number = 0;
    for (const CapturedProgram& program : capturedPrograms()) {
        const auto [status, output] = validate(program, folder / std::to_string(number++));
        ASSERT_EQ(output.find("not found"), std::string::npos) << output << "install glslang-tools";
        EXPECT_EQ(status, 0) << output;
    }
    if (!HasFailure()) fs::remove_all(folder);
}

}  // namespace dustbench::shaders
