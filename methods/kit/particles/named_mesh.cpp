#include "methods/kit/particles/named_mesh.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/meshes/mesh_file.h"

namespace dustbench::particles {
namespace {

constexpr const char* folder = "shapes/meshes";
constexpr const char* extension = ".ply";

}  // namespace

void declareMesh(ParameterSet& set) {
    set.dataFile("mesh", "hare", folder, extension, files::listData(folder, extension),
                 "a mesh of data/shapes/meshes, or the path of an OBJ, PLY or STL file")
        .real("scale", 1, 1e-6, 1e6, "", "factor on the mesh's size")
        .boolean("open", false, "also accepts a surface with holes");
}

std::vector<std::array<glm::vec3, 3>> trianglesOf(const ParameterValues& values) {
    const std::string& name = values.choice("mesh");
    const scene::Mesh mesh = meshes::readMesh(files::findData("mesh", folder, name, extension), glm::vec3(1));
    const auto scale = static_cast<float>(values.real("scale"));
    std::vector<std::array<glm::vec3, 3>> triangles;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::vec3, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = scale * mesh.positions[mesh.indices[i + k]];
        if (areaOf(triangle) > 0) triangles.push_back(triangle);
    }
    if (triangles.empty())
        throw InputError("parameter mesh: '" + name + "' has no triangle with an area, allowed: a surface");
    if (const std::size_t open = meshes::openEdges(mesh); open > 0 && !values.boolean("open"))
        throw InputError("parameter mesh: '" + name + "' has a hole (" + std::to_string(open) +
                         " open edges), allowed: a closed surface, or open = true");
    return triangles;
}

}  // namespace dustbench::particles
