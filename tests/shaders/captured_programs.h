// Every program that the methods and the harness give to OpenGL, with every set of definitions that parameters, scenes
// and dust lead to.
//
// Threads: the OpenGL thread's.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dustbench::shaders {

struct CapturedShader {
    std::string file;    ///< `draw/lines.vert`, as errors name it
    std::string source;  ///< the whole text that OpenGL gets
    friend auto operator<=>(const CapturedShader&, const CapturedShader&) = default;
};

/// The stages of a program, in order.
using CapturedProgram = std::vector<CapturedShader>;

/// Draws with every method under many combinations of its parameters. Takes some seconds; the result is kept.
[[nodiscard]] const std::set<CapturedProgram>& capturedPrograms();

}  // namespace dustbench::shaders
