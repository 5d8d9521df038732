// Edits of a shape's file: spheres, boxes and meshes in which voxels change colour, activity or force, and are saved.
#include <gtest/gtest.h>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/maths/philox.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_builder.h"

namespace dustbench::voxel_shape {
namespace {

/// A block of 8³ voxels of 0.25 m from (−1, 0, −1) to (1, 2, 1).
const std::string editedBlock = "description = \"\"\nparticles = 512\n[grid]\ncells = [8, 8, 8]\nedge_metres = 0.25\n";

/// A closed tetrahedron: x, y, z ≥ 0 and x + y + z ≤ 1.
const std::string editedTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

ShapeSystem built(MemoryLedger& ledger, const std::filesystem::path& file) {
    return buildShape(ledger, readShape(file), {}, TestMoment::device(), 1);
}

TEST(ShapeEdit, OfAMeshMeetsTheVoxelsWhoseMiddlesLieInIt) {
    const TestFolder folder;
    folder.write("corner.obj", editedTetrahedron);
    const auto file = folder.write("world.toml", editedBlock +
                                                     "[place]\nfollow = \"world\"\n"
                                                     "[[edit]]\nmesh = \"corner.obj\"\nposition = [-1, 0, -1]\n"
                                                     "scale = 1.5\ncolour = [1, 0, 0]\n");
    MemoryLedger ledger;
    const ShapeSystem system = built(ledger, file);
    int red = 0;
    for (const std::uint32_t i : system.grid().active()) {
        const glm::vec3 p = system.grid().lattice().centre(system.grid().lattice().cell(i)) - glm::vec3(-1, 0, -1);
        const bool within = p.x + p.y + p.z < 1.5f;
        EXPECT_EQ(system.grid().voxels()[i].colour.colour().g < 0.01f, within) << p.x << " " << p.y << " " << p.z;
        red += within;
    }
    EXPECT_GT(red, 20);
}

TEST(ShapeEdit, CarvesPaintsAndPushesAndIsSavedAndReadBack) {
    const TestFolder folder;
    folder.write("corner.obj", editedTetrahedron);
    const std::string place = "[place]\nfollow = \"world\"\n";
    const auto first =
        folder.write("first.toml", "save_voxels_as = \"edited.vti\"\n" + editedBlock + place +
                                       "[[edit]]\nmesh = \"corner.obj\"\nposition = [-1, 0, -1]\nactive = false\n"
                                       "[[edit]]\ncentre = [0.5, 1.5, 0.5]\nradius_metres = 0.4\ncolour = [0, 0, 1]\n"
                                       "[[edit]]\nmin = [-1, 1.5, -1]\nmax = [1, 2, 1]\n"
                                       "force = { kind = \"gravity\", radians_per_second = 3 }\n");
    const auto second = folder.write("second.toml", "description = \"\"\nvoxels_from = \"edited.vti\"\n" + place);
    MemoryLedger ledger;
    const ShapeSystem edited = built(ledger, first), again = built(ledger, second);
    ASSERT_EQ(again.grid().active().size(), edited.grid().active().size());
    EXPECT_LT(edited.grid().active().size(), 512u);
    int blue = 0, pushed = 0;
    for (const std::uint32_t i : edited.grid().active()) {
        const Voxel &a = edited.grid().voxels()[i], &b = again.grid().voxels()[i];
        EXPECT_EQ(a.colour.colour(), b.colour.colour());
        EXPECT_EQ(a.forceKind(), b.forceKind());
        EXPECT_EQ(a.force, b.force);
        blue += a.colour.colour().r < 0.01f;
        pushed += a.forceKind() == Force::gravity;
    }
    EXPECT_EQ(blue, 8) << "those around the corner at its centre; the next ones are 0.41 m away";
    EXPECT_EQ(pushed, 2 * 64);
}

TEST(ShapeEdit, ASweptSphereIsTheUnionOfAllSpheresAlongItsLine) {
    const TestFolder folder;
    const auto file = folder.write("s.toml", editedBlock +
                                                 "[[edit]]\ncentre = [-0.5, 0.5, 0.2]\nto = [0.7, 1.3, -0.1]\n"
                                                 "radius_metres = 0.3\ncolour = [1, 0, 0]\n");
    const VoxelEdit edit = readShape(file).edits.at(0);
    int within = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        const auto u = maths::uniform4(7, 1, i);
        const glm::vec3 point = glm::vec3(-1.2f, 0, -0.8f) + glm::vec3(2.4f, 2, 1.6f) * glm::vec3(u[0], u[1], u[2]);
        float nearest = INFINITY;
        for (int k = 0; k <= 2000; ++k)
            nearest =
                std::min(nearest, glm::distance(point, glm::mix(edit.centre, edit.end, static_cast<float>(k) / 2000)));
        if (std::abs(nearest - 0.3f) > 1e-3f) {
            EXPECT_EQ(edit.contains(point), nearest < 0.3f) << nearest;
        }
        within += edit.contains(point);
    }
    EXPECT_GT(within, 200);
}

TEST(ShapeEdit, SaysThatAnOpenMeshHasNoInside) {
    const TestFolder folder;
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto file = folder.write("s.toml", editedBlock + "[[edit]]\nmesh = \"open.obj\"\ncolour = [1, 0, 0]\n");
    const std::string message = inputError([&] { (void)readShape(file); });
    EXPECT_NE(message.find("3 open edges"), std::string::npos) << message;
}

/// A helix around the row where there is a row, unless the voxel has a force.
TEST(RowForce, KeepsParticlesInTheSpikesOfTheirVoxels) {
    MemoryLedger ledger;
    Shape spikes = readShape(files::findData("shape", "shapes", "spikes_drawn", ".toml"));
    spikes.track.followsVehicle = false;
    const ShapeSystem system = buildShape(ledger, spikes, {}, TestMoment::device(), 1);
    for (const std::uint32_t i : system.grid().active()) {
        const Voxel& voxel = system.grid().voxels()[i];
        EXPECT_EQ(voxel.forceKind(), Force::helix);
        EXPECT_LT(glm::distance(voxel.force, glm::vec3(0, 3, 0)), 1e-5f);
        EXPECT_EQ(voxel.forceNumber, 0.005f);
    }
    const TestFolder folder;
    const auto own = folder.write("own.toml",
                                  "description = \"\"\nparticles = 60\n[grid]\ncells = [1, 9, 1]\nedge_metres = 0.1\n"
                                  "[voxels]\nforce = { kind = \"linear\", acceleration = [1, 0, 0] }\n"
                                  "[row_force]\n[place]\nfollow = \"world\"\n");
    const ShapeSystem kept = built(ledger, own);
    for (const std::uint32_t i : kept.grid().active()) EXPECT_EQ(kept.grid().voxels()[i].force, glm::vec3(1, 0, 0));
}

}  // namespace
}  // namespace dustbench::voxel_shape
