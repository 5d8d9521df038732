// A compute program with one thread per item of a grid.
//
// Threads: the OpenGL thread's.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <map>
#include <string>
#include <string_view>

#include "methods/grid_fluid/flow/fluid_box.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::grid_fluid::flow_gl {

/// The boundary conditions of the six sides, as a GLSL array.
[[nodiscard]] inline std::string sidesText(const flow::Sides& sides) {
    std::string text = "int[6](";
    for (std::size_t side = 0; side < sides.size(); ++side)
        text += (side > 0 ? ", " : "") + std::to_string(static_cast<int>(sides[side]));
    return text + ")";
}

class Kernel {
 public:
    static constexpr glm::ivec3 group{32, 4, 1};  ///< threads of a work group, as in grid.glsl
    static constexpr int column = 16;

    /// The last file is the program itself; the others are included before it.
    Kernel(gpu::Device& device, std::initializer_list<gpu::ShaderFile> files,
           const std::map<std::string, std::string>& definitions = {})
        : program_(device, std::prev(files.end())->name, files, definitions) {}

    template <typename Value>
    void set(std::string_view uniform, const Value& value) {
        program_.set(uniform, value);
    }
    /// Number of work groups along each axis for this many items.
    [[nodiscard]] static glm::ivec3 groupsFor(const glm::ivec3& items) { return (items + group - 1) / group; }
    /// Number of items if each thread processes a short column of cells along z.
    [[nodiscard]] static glm::ivec3 columnsOf(const glm::ivec3& cells) {
        return {cells.x, cells.y, (cells.z + column - 1) / column};
    }
    void run(const glm::ivec3& items) const {
        const glm::ivec3 groups = groupsFor(items);
        program_.dispatch(groups.x, groups.y, groups.z);
    }
    /// Arranges groups in rows, since OpenGL guarantees only 65,535 along an axis. May dispatch some extra groups.
    void runGroups(int count) const {
        constexpr int maximum = 32768;
        program_.dispatch(std::min(count, maximum), (count + maximum - 1) / maximum, 1);
    }

 private:
    gpu::Program program_;
};

}  // namespace dustbench::grid_fluid::flow_gl
