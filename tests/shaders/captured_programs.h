// Captures every program that methods and harness pass to OpenGL, with every set of definitions that results from
// parameters, scenes and dust.
//
// Threads: the OpenGL thread's.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dustbench::shaders {

struct CapturedShader {
    std::string file;    ///< `draw/lines.vert`, as in error messages
    std::string source;  ///< the complete text passed to OpenGL
    friend auto operator<=>(const CapturedShader&, const CapturedShader&) = default;
};

/// The stages of a program, in order.
using CapturedProgram = std::vector<CapturedShader>;

/// Draws with every method and many combinations of its parameters. Takes some seconds; the result is cached.
[[nodiscard]] const std::set<CapturedProgram>& capturedPrograms();

}  // namespace dustbench::shaders
