// Meshes, lit by the scene and scaled to the radius of the particle.
#include <algorithm>
#include "methods/kit/particles/render_part.h"

#include "methods/kit/files/data_folder.h"

namespace dustbench::particles::parts::render::objects {
namespace {

struct Traits {
    static constexpr Primitive primitive = Primitive::objects;

    static void declare(ParameterSet& set) {
        std::vector<std::string> names = files::listData("scenes/meshes", ".obj");
        if (std::ranges::find(names, "sphere") == names.end()) names.emplace_back("sphere");
        set.dataFile("mesh", "sphere", "scenes/meshes", ".obj", names, "mesh drawn in place of each particle")
            .boolean("along_velocity", false, "turns the mesh so that its x axis follows the velocity");
    }
    static void complete(Look& look, const ParameterValues& values) {
        look.mesh = values.choice("mesh");
        look.alongVelocity = values.boolean("along_velocity");
    }
};

}  // namespace

PartInfo describe() {
    return LookPart<Traits>::describe("a mesh in place of each particle", "Thesis, 4.1.7", Blending::alpha);
}

}  // namespace dustbench::particles::parts::render::objects
