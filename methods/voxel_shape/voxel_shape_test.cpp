#include "methods/voxel_shape/voxel_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "methods/kit/files/data_folder.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_moment.h"
#include "methods/voxel_shape/shape.h"
#include "methods/voxel_shape/shape_builder.h"
#include "methods/voxel_shape/silhouette.h"
#include "methods/voxel_shape/voxels/test_meshes.h"

namespace dustbench::voxel_shape {
namespace {

Shape preset(const std::string& name) {
    return readShape(files::dataFolder() / "shapes" / (name + ".toml"));
}

/// A moment with a vehicle, viewed from the side: a ball of 2 m with balls as wheels.
class Moment : public TestMoment {
 public:
    Moment() : TestMoment(0, 480, 360, {0, 1.6, 9}, {0, 0, -1}) {
        scene::Mesh ball = sphereMesh(1, 12), wheel = sphereMesh(0.33f, 8);
        ball.normals.assign(ball.positions.size(), glm::vec3(0, 1, 0));
        wheel.normals.assign(wheel.positions.size(), glm::vec3(0, 1, 0));
        scene.vehicle = scene::VehicleModel{
            {}, {"ball", std::make_shared<scene::Mesh>(ball)}, {"wheel", std::make_shared<scene::Mesh>(wheel)}};
    }
    void run(VoxelShape& method, int steps, std::uint64_t seed = 1) {
        method.prepare(scene, {.seed = seed}, device());
        for (int step = 0; step < steps; ++step) method.update(frame());
    }
};

TEST(Presets, KeepTheSilhouettesOfTheirMeshes) {
    const std::pair<const char*, double> wanted[]{{"bunny", 0.9}, {"helicopter", 0.8}, {"figure", 0.8}, {"car", 0.8}};
    for (const auto& [name, minimum] : wanted) {
        Moment moment;
        Shape shape = preset(name);
        shape.track.keys = {{0, {0, 0, 0}, glm::radians(30.0), 1}};
        moment.view.camera.eye = {0, shape.source == Source::vehicle ? 0 : 1.4, 8};
        moment.view.camera.target = {0, shape.source == Source::vehicle ? 0 : 1.4, 0};
        VoxelShape method(shape);
        moment.run(method, 60);
        const pictures::Image image = moment.draw(method);
        ShapeTrack track(shape.track);
        const auto mask = silhouetteOf(meshOf(shape, moment.scene), track.advance(moment.state, 1), moment.view);
        const double overlap = overlapOf(mask, image).value();
        EXPECT_GE(overlap, minimum) << name;
        EXPECT_GT(std::ranges::count(mask, 1), 4000) << name;
        RecordProperty(std::string("silhouette_") + name, std::to_string(overlap));
    }
}

TEST(Presets, OfTheGridBurnAndFade) {
    for (const char* name : {"fire", "fade"}) {
        Moment moment;
        Shape shape = preset(name);
        shape.track.keys = {{}};
        moment.view.camera = {.eye = {0, 1, 5}, .target = {0, 1, 0}};
        VoxelShape method(shape);
        moment.run(method, 180);
        double light = 0, left = 0, right = 0;
        const pictures::Image image = moment.draw(method);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                light += static_cast<double>(image.at(x, y).r);
                (x < 240 ? left : right) += static_cast<double>(image.at(x, y).a);
            }
        EXPECT_GT(light, 100) << name;
        EXPECT_TRUE(!shape.look.additive || left + right == 0) << "light covers nothing";
        if (std::string(name) == "fade") {
            // On the left, particles appear far outside their voxel; on the right, none does.
            float leftmost = 0, rightmost = 0;
            for (const float x : method.system().particles().store.x) {
                leftmost = std::min(leftmost, x);
                rightmost = std::max(rightmost, x);
            }
            EXPECT_LT(leftmost, -1.5f);
            EXPECT_LT(rightmost, 1.05f);
        }
    }
}

TEST(VoxelShape, DrawsTheSameTwiceInEveryWay) {
    for (const Render render :
         {Render::points, Render::lines, Render::sprites, Render::billboards, Render::textured, Render::animated})
        for (const bool additive : {false, true}) {
            Moment moment;
            Shape shape = preset("car");
            shape.particles = 2000;
            shape.track.keys = {{}};
            shape.motion.birthSpeed = 1;
            shape.look.render = render;
            shape.look.additive = additive;
            VoxelShape method(shape);
            moment.run(method, 5);
            const pictures::Image first = moment.draw(method);
            EXPECT_EQ(first.pixels, moment.draw(method).pixels);
            const auto covered = std::ranges::count_if(first.pixels, [](const glm::vec4& p) { return p.b > 0; });
            EXPECT_GT(covered, 300) << static_cast<int>(render);
            EXPECT_EQ(method.primitives(), static_cast<std::int64_t>(method.system().particles().size()));
        }
}

TEST(VoxelShape, TellsItsMemoryAndItsStateBySeed) {
    Moment moment;
    Shape shape = preset("car");
    shape.resolution = 20;
    VoxelShape first(shape), again(shape), other(shape);
    moment.run(first, 3);
    moment.run(again, 3);
    moment.run(other, 3, 2);
    EXPECT_EQ(first.stateHash(), again.stateHash());
    EXPECT_NE(first.stateHash(), other.stateHash());
    std::size_t voxels = 0, gpu = 0;
    for (const MemoryUse& use : first.memory()) {
        if (use.structure == "voxels") voxels += use.cpuBytes;
        gpu += use.gpuBytes;
    }
    EXPECT_EQ(voxels, 64 * first.system().grid().lattice().size());
    EXPECT_GE(gpu, static_cast<std::size_t>(first.primitives()) * 32);
}

TEST(DrawOrder, SortsTheNearestLastAndTheOthersNot) {
    MemoryLedger ledger;
    DrawOrder order(ledger);
    const std::vector<float> x{5, 1, 4, 2, 3, 9}, zero(6, 0);
    Look look;
    look.order = Order::nearest;
    look.nearest = 3;
    const auto got = order.of(look, {x, zero, zero}, {});
    EXPECT_EQ(std::vector<std::uint32_t>(got.begin(), got.end()), (std::vector<std::uint32_t>{0, 2, 5, 4, 3, 1}));
}

TEST(DrawOrder, KeepsAnOrderForSomeFramesWhoeverComesAndGoes) {
    MemoryLedger ledger;
    DrawOrder order(ledger);
    Look look;
    look.order = Order::every;
    look.every = 3;
    const auto of = [&](const std::vector<float>& x) {
        const std::vector<float> zero(x.size(), 0);
        const auto got = order.of(look, {x, zero, zero}, {});
        return std::vector<std::uint32_t>(got.begin(), got.end());
    };
    using List = std::vector<std::uint32_t>;
    EXPECT_EQ(of({1, 3, 2}), (List{1, 2, 0}));
    EXPECT_EQ(of({3, 2, 1, 9}), (List{1, 2, 0, 3}));
    EXPECT_EQ(of({3, 2}), (List{1, 0}));
    EXPECT_EQ(of({3, 2}), (List{0, 1}));
}

TEST(ShapeFile, SaysInOneLineWhatIsWrong) {
    const TestFolder folder;
    Moment moment;
    const auto message = [&](const std::string& text) {
        const auto file = folder.write("s.toml", "description = \"\"\n" + text);
        return inputError([&] {
            MemoryLedger ledger;
            (void)buildShape(ledger, readShape(file), moment.scene, Moment::device(), 1);
        });
    };
    const auto expect = [&](const std::string& text, const std::string& part) {
        const std::string got = message(text);
        EXPECT_NE(got.find(part), std::string::npos) << got;
    };
    folder.write("wall.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const std::string grid = "[grid]\ncells = [2, 1, 1]\nedge_metres = 1\n";
    expect("", "expected exactly one of mesh, [grid] and voxels_from");
    expect("voxels_from = \"no.vti\"\n", "'no.vti': no such file, tried ");
    folder.write("bad.vti", "no voxels\n");
    expect("voxels_from = \"bad.vti\"\n", "bad.vti: not a complete VTK image data file");
    expect("voxels_from = \"bad.vti\"\nparticles = 3\n", "particles are not allowed with it");
    expect("mesh = \"vehicle\"\nresolution = 300\n", "resolution");
    expect("mesh = \"vehicle\"\nresolutoin = 30\n", "resolutoin");
    expect("mesh = \"none.ply\"\n", "none.ply");
    expect("mesh = \"wall.obj\"\nfill = \"solid\"\n", "encloses nothing");
    expect("mesh = \"vehicle\"\nfill = \"solid\"\nvoxeliser = \"slices\"\n", "conservative");
    expect(grid + "[voxels]\nopacity = 2\n", "opacity");
    expect(grid + "[voxels]\nforce = { kind = \"helix\", axis = [0, 0, 0] }\n", "axis");
    expect(grid + "[[edit]]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n", "changes nothing");
    expect(grid + "[[edit]]\nmin = [1, 0, 0]\nmax = [0, 1, 1]\nopacity = 0.1\n", "beyond its max");
    expect(grid + "[[edit]]\nmin = [0, 0, 0]\nradius_metres = 1\nopacity = 0.1\n", "either a box");
    expect(grid + "[[edit]]\ncentre = [9, 0, 0]\nradius_metres = 1\nopacity = 0.1\n", "contains no voxel");
    expect(grid + "[[edit]]\ncentre = [0, 0, 0]\nradius_metres = 5\nactive = false\nopacity = 0.1\n",
           "contradicts itself");
    expect(grid + "[[edit]]\ncentre = [0, 0, 0]\nradius_metres = 5\nactive = false\n", "no active voxel");
    expect(grid + "[place]\n[[place.key]]\ntime_seconds = 2\n[[place.key]]\ntime_seconds = 1\n", "increase from 0");
}

TEST(ShapeFile, EditsSetWhatTheySay) {
    const TestFolder folder;
    Moment moment;
    const auto file = folder.write("s.toml",
                                   "description = \"\"\nparticles = 100\n[grid]\ncells = [4, 1, 1]\nedge_metres = 1\n"
                                   "[[edit]]\nmin = [-2, 0, -1]\nmax = [-1, 1, 1]\nactive = false\n"
                                   "[[edit]]\nmin = [-1, 0, -1]\nmax = [0, 1, 1]\ncolour = [1, 0, 0]\n"
                                   "maximum_density = 7\n"
                                   "[[edit]]\ncentre = [1.5, 0.5, 0]\nradius_metres = 0.1\nsize_voxels = 3\n"
                                   "force = { kind = \"spiral\", axis = [0, 0, 0.5], radians_per_second = 4 }\n");
    MemoryLedger ledger;
    const ShapeSystem system = buildShape(ledger, readShape(file), moment.scene, Moment::device(), 1);
    EXPECT_FALSE(system.grid().at({0, 0, 0}).isActive());
    EXPECT_EQ(system.grid().at({1, 0, 0}).colour.colour(),
              glm::vec4(1, 0, 0, PackedColour({0, 0, 0, 0.5f}).colour().a));
    EXPECT_EQ(system.grid().at({1, 0, 0}).maximumDensity, 7u);
    EXPECT_EQ(system.grid().at({2, 0, 0}).maximumDensity, 33u);
    EXPECT_EQ(system.grid().at({3, 0, 0}).sizeMetres, 3);
    EXPECT_EQ(system.grid().at({3, 0, 0}).forceKind(), Force::spiral);
    EXPECT_FLOAT_EQ(system.grid().at({3, 0, 0}).force.z, 4);
}

TEST(ShapeFile, TakesUpVoxelsThatWereSaved) {
    const TestFolder folder;
    Moment moment;
    const std::string text =
        "description = \"\"\n[grid]\ncells = [4, 2, 1]\nedge_metres = 1\n[voxels]\nsize_voxels = 0.3\n";
    const auto build = [&](const std::string& name, const std::string& content) {
        MemoryLedger ledger;
        const auto file = folder.write(name, content);
        const ShapeSystem system = buildShape(ledger, readShape(file), moment.scene, Moment::device(), 1);
        return std::vector<Voxel>(system.grid().voxels().begin(), system.grid().voxels().end());
    };
    const auto saved = build("first.toml", "save_voxels_as = \"voxels.vti\"\n" + text);
    const auto again = build("second.toml", "description = \"\"\nvoxels_from = \"voxels.vti\"\n");
    ASSERT_EQ(again.size(), saved.size());
    for (std::size_t i = 0; i < saved.size(); ++i) {
        EXPECT_EQ(again[i].sizeMetres, saved[i].sizeMetres);
        EXPECT_EQ(again[i].maximumDensity, saved[i].maximumDensity);
    }
    EXPECT_EQ(build("third.toml",
                    "description = \"\"\nvoxels_from = \"voxels.vti\"\n"
                    "[[edit]]\nmin = [-2, 0, -1]\nmax = [-1, 1, 1]\nopacity = 0.1\n")[0]
                      .colour.blueOpacity >>
                  16,
              6554u);
}

TEST(ShapeFile, WritesVoxelsBelowItsFolderAlone) {
    const TestFolder folder;
    std::filesystem::create_directories(folder.path() / "shapes" / "sub");
    std::filesystem::create_directory_symlink("/", folder.path() / "shapes" / "root");
    std::filesystem::create_symlink("../precious.vti", folder.path() / "shapes" / "link.vti");
    folder.write("precious.vti", "precious");
    const auto read = [&](const std::string& name) {
        return readShape(folder.write("shapes/a.toml", "description = \"\"\nsave_voxels_as = \"" + name +
                                                           "\"\n[grid]\ncells = [4, 2, 1]\nedge_metres = 1\n"));
    };
    for (const char* name : {"v.vti", "sub/v.vti", "sub/../v.vti", "./v.vti", "new/v.vti"})
        EXPECT_EQ(read(name).savedVoxels, folder.path() / "shapes" / name);
    for (const char* name : {"../v.vti", "/tmp/v.vti", "sub/../../v.vti", "root/tmp/v.vti", "link.vti", "v.txt",
                             "a.toml", "sub", ".", "..", "/"})
        EXPECT_NE(inputError([&] { (void)read(name); }).find("in the folder of the shape's file or below"),
                  std::string::npos)
            << name;
}

}  // namespace
}  // namespace dustbench::voxel_shape
