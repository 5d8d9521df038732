// Compiles every shader with every set of definitions with the reference compiler, because Mesa accepts code that other
// drivers refuse.
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
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

EShLanguage stageOf(const std::string& file) {
    static const std::map<fs::path, EShLanguage> stages{
        {".vert", EShLangVertex}, {".frag", EShLangFragment}, {".comp", EShLangCompute}};
    return stages.at(fs::path(file).extension());
}

/// What the reference compiler says about the stages of a program and their interfaces. Empty: it accepts them.
std::string faultsOf(const CapturedProgram& program) {
    std::vector<std::unique_ptr<glslang::TShader>> stages;
    glslang::TProgram linked;
    std::string faults;
    for (const CapturedShader& shader : program) {
        const std::unique_ptr<glslang::TShader>& stage =
            stages.emplace_back(std::make_unique<glslang::TShader>(stageOf(shader.file)));
        const char *const text = shader.source.c_str(), *const name = shader.file.c_str();
        stage->setStringsWithLengthsAndNames(&text, nullptr, &name, 1);
        if (!stage->parse(GetDefaultResources(), 100, false, EShMsgDefault)) faults += stage->getInfoLog();
        linked.addShader(stage.get());
    }
    if (faults.empty() && !linked.link(EShMsgDefault)) faults = program.front().file + ": " + linked.getInfoLog();
    return faults;
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
    glslang::InitializeProcess();
    for (const CapturedProgram& program : capturedPrograms()) EXPECT_EQ(faultsOf(program), "");
    glslang::FinalizeProcess();
}

TEST(Shaders, AreRefusedIfAStageOrAnInterfaceIsInvalid) {
    glslang::InitializeProcess();
    const auto withColour = [](const std::string& type, const std::string& value) {
        return CapturedProgram{
            {"a.vert", "#version 450 core\nout vec4 colour;\nvoid main() { colour = gl_Position = vec4(1); }\n"},
            {"a.frag",
             "#version 450 core\nin " + type + " colour;\nout vec4 shown;\nvoid main() { shown = " + value + "; }\n"}};
    };
    EXPECT_EQ(faultsOf(withColour("vec4", "colour")), "");
    EXPECT_THAT(faultsOf(withColour("vec4", "color")), testing::HasSubstr("a.frag:4: 'color' : undeclared identifier"));
    EXPECT_THAT(faultsOf(withColour("vec3", "vec4(colour, 1)")), testing::HasSubstr("Types must match"));
    glslang::FinalizeProcess();
}

}  // namespace dustbench::shaders
