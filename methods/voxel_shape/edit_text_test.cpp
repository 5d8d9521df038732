// Checks that edits as words on the command line equal the tables of a shape file, and that `dustbench shape` saves
// them.
#include "methods/voxel_shape/edit_text.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <random>

#include "methods/contract/registry.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_builder.h"
#include "methods/voxel_shape/voxels/voxel_file.h"

namespace dustbench::voxel_shape {
namespace shape {
ToolInfo describe();
}
namespace {

namespace fs = std::filesystem;

const std::string block = "description = \"\"\nparticles = 512\n[grid]\ncells = [8, 8, 8]\nedge_metres = 0.25\n";
const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class Services final : public ExperimentContext {
 public:
    [[nodiscard]] std::uint64_t seed() const override { return 1; }
    [[nodiscard]] bool quick() const override { return true; }
    [[nodiscard]] gpu::Device& device() override { return TestMoment::device(); }
    [[nodiscard]] std::unique_ptr<ExperimentWorld> world(const std::string&, const std::map<std::string, std::string>&,
                                                         int, int) override {
        throw InputError("no world here");
    }
};

std::vector<std::vector<std::string>> call(const std::vector<ToolArgument>& arguments) {
    Services services;
    return shape::describe().run(services, arguments);
}

VoxelGrid voxelsOf(MemoryLedger& ledger, const fs::path& file) {
    Shape shape = readShape(file);
    shape.track.followsVehicle = false;
    return buildShape(ledger, shape, {}, TestMoment::device(), 1).grid();
}

/// Checks that the voxels are equal except for densities and file names.
void expectSame(const VoxelGrid& a, const VoxelGrid& b) {
    ASSERT_EQ(a.lattice().counts, b.lattice().counts);
    EXPECT_EQ(a.active().size(), b.active().size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.lattice().size(); ++i) {
        const Voxel &p = a.voxels()[i], &q = b.voxels()[i];
        different += p.isActive() != q.isActive() ||
                     (p.isActive() && (p.colour.colour() != q.colour.colour() || p.force != q.force ||
                                       p.forceKind() != q.forceKind() || p.maximumDensity != q.maximumDensity));
    }
    EXPECT_EQ(different, 0u);
}

TEST(EditText, ContainsWhatTheRegionsOfAShapeFileContain) {
    const VoxelEdit sphere = readEditWords(EditKind::paint, "--paint", "sphere=0.5,1,-0.5,0.7 colour=1,0,0"),
                    spelledOut =
                        readEditWords(EditKind::paint, "--paint", "centre=0.5,1,-0.5 radius_metres=0.7 colour=1,0,0"),
                    box = readEditWords(EditKind::carve, "--carve", "box=-1,0,-0.5,0.25,1,1"),
                    corners = readEditWords(EditKind::carve, "--carve", "min=-1,0,-0.5 max=0.25,1,1");
    std::mt19937_64 chance(5);
    std::uniform_real_distribution<float> anywhere(-1.5f, 1.5f);
    int inSphere = 0, inBox = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 p(anywhere(chance), anywhere(chance), anywhere(chance));
        const bool near = glm::distance(p, glm::vec3(0.5f, 1, -0.5f)) <= 0.7f;
        const bool within = p.x >= -1 && p.x <= 0.25f && p.y >= 0 && p.y <= 1 && p.z >= -0.5f && p.z <= 1;
        EXPECT_EQ(sphere.contains(p), near);
        EXPECT_EQ(spelledOut.contains(p), near);
        EXPECT_EQ(box.contains(p), within);
        EXPECT_EQ(corners.contains(p), within);
        inSphere += near;
        inBox += within;
    }
    EXPECT_GT(inSphere, 50);
    EXPECT_GT(inBox, 50);
}

TEST(EditText, SavedAsAShapeFileAndAsVoxelsIsTheSameShape) {
    const TestFolder folder;
    fs::create_directories(folder.path() / "shapes");
    fs::create_directories(folder.path() / "out");
    folder.write("shapes/corner.obj", tetrahedron);
    folder.write("shapes/block.toml", "save_voxels_as = \"side.vti\"\n" + block +
                                          "[[edit]]\nmesh = \"corner.obj\"\nposition = [-1, 0, -1]\n"
                                          "colour = [0, 1, 0]\n");
    const std::string source = (folder.path() / "shapes/block.toml").string(),
                      toml = (folder.path() / "out/edited.toml").string(),
                      vti = (folder.path() / "out/edited.vti").string();
    const std::vector<ToolArgument> edits{
        {"file", source},
        {"--carve", "mesh=" + (folder.path() / "shapes/corner.obj").string() + " position=0,1,0"},
        {"--paint", "sphere=0.5,0.5,0.5,0.6 colour=0,0,1"},
        {"--paint", "sphere=0.5,0.5,0.5,0.3 colour=1,0,0"},
        {"--force", "box=-1,1.5,-1,1,2,1 kind=gravity radians_per_second=3"}};
    for (const std::string& out : {toml, vti}) {
        std::vector<ToolArgument> arguments = edits;
        arguments.push_back({"--save", out});
        const auto table = call(arguments);
        EXPECT_EQ(table[1][1], "512");
        EXPECT_LT(std::stoi(table[1][2]), 512);
    }
    EXPECT_FALSE(fs::exists(folder.path() / "shapes/side.vti")) << "showing and saving writes only --save";
    EXPECT_EQ(readShape(toml).savedVoxels, "") << "the edited shape does not overwrite the other's voxels";
    MemoryLedger ledger;
    const VoxelGrid fromText = voxelsOf(ledger, toml), fromVoxels = readVoxels(ledger, vti);
    expectSame(fromText, fromVoxels);
    const glm::vec3 middle(0.5f), rim(0.5f, 0.9f, 0.5f);
    const auto colourAt = [&](const glm::vec3& p) {
        const Lattice& lattice = fromText.lattice();
        return fromText.at(glm::ivec3(lattice.toVoxels(p))).colour.colour();
    };
    EXPECT_GT(colourAt(middle).r, 0.99f) << "the later edit wins";
    EXPECT_GT(colourAt(rim).b, 0.99f);
}

TEST(EditText, FilledVoxelsLookLikeTheNearestAndHoldParticles) {
    const TestFolder folder;
    const std::string source = folder.write("block.toml", "colour = [0.2, 0.4, 0.6]\n" + block).string(),
                      hollow = (folder.path() / "hollow.vti").string(), whole = (folder.path() / "whole.vti").string();
    call({{"file", source}, {"--carve", "sphere=0,1,0,0.6"}, {"--save", hollow}});
    call({{"file", hollow}, {"--fill", "sphere=0,1,0,0.6"}, {"--save", whole}});
    MemoryLedger ledger;
    const VoxelGrid carved = readVoxels(ledger, hollow), filled = readVoxels(ledger, whole);
    EXPECT_LT(carved.active().size(), 512u);
    ASSERT_EQ(filled.active().size(), 512u);
    for (const std::uint32_t i : filled.active()) {
        EXPECT_NEAR(filled.voxels()[i].colour.colour().b, 0.6f, 1e-4f);
        EXPECT_GT(filled.voxels()[i].colour.colour().a, 0.1f);
        EXPECT_GE(filled.voxels()[i].maximumDensity, 1u);
    }
}

TEST(EditText, BadInputIsSaidAndNothingIsWritten) {
    const TestFolder folder;
    const std::string source = folder.write("block.toml", block).string(), out = (folder.path() / "o.toml").string();
    const std::string open = folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
    const std::vector<std::array<std::string, 3>> mistakes{
        {"--paint", "sphere=0,1,0,0.5 color=1,0,0", "did you mean 'colour'"},
        {"--paint", "sphere=0,1,0,0 colour=1,0,0", "radius_metres"},
        {"--paint", "sphere=0,1,0 colour=1,0,0", "expected 4 numbers"},
        {"--paint", "sphere=0,1,0,inf colour=1,0,0", "expected 4 numbers"},
        {"--paint", "sphere=0,1,0,0.5 colour=1,0,2", "colour"},
        {"--paint", "sphere=0,1,0,0.5 colour=1,0,0 colour=0,1,0", "twice"},
        {"--paint", "sphere=0,1,0,0.5", "nothing to change"},
        {"--paint", "colour=1,0,0", "no region"},
        {"--carve", "box=1,1,1,0,0,0", "min lies beyond"},
        {"--carve", "sphere=0,1,0,0.5 colour=1,0,0", "unknown word"},
        {"--carve", "sphere=0,1,0,9", "no active voxel"},
        {"--carve", "sphere=9,1,0,0.5", "contains no voxel"},
        {"--carve", "mesh=" + open, "3 open edges"},
        {"--carve", "mesh=" + (folder.path() / "missing.obj").string(), "missing.obj"},
        {"--force", "sphere=0,1,0,0.5 kind=gravty", "did you mean 'gravity'"},
        {"--force", "sphere=0,1,0,0.5 kind=linear axis=0,1,0", "axis"}};
    for (const auto& [option, words, expected] : mistakes) {
        const std::string message = inputError([&, &o = option, &w = words] {
            call({{"file", source}, {o, w}, {"--save", out}});
        });
        EXPECT_NE(message.find(expected), std::string::npos) << option << " " << words << ": " << message;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    for (const std::string& bad : {folder.path().string() + "/o.ply", folder.path().string() + "/nowhere/o.toml"})
        EXPECT_NE(inputError([&] { call({{"file", source}, {"--save", bad}}); }), "") << bad;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_TRUE(entry.path() == source || entry.path() == open) << entry.path();
}

}  // namespace
}  // namespace dustbench::voxel_shape
