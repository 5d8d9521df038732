#include "methods/volume/volume.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::volume {
namespace {

using testing::HasSubstr;

constexpr double opacity = 0.8, radius = 1;
const glm::dvec3 centre(0.07, 0.1, -0.05);

double share(double middle, double low, double edge) {
    const double scale = 1 / (std::numbers::sqrt2 * maths::puffDeviationMetres(radius));
    return 0.5 * (std::erf((low + edge - middle) * scale) - std::erf((low - middle) * scale));
}

/// A Gaussian puff as a grid of cells within ±2.5 m, each with its average; `factor` times as dense. Averaging and
/// linear interpolation widen it: its variance grows by h²/12 and h²/6 for cells of edge h.
std::string puffFile(const TestFolder& folder, const std::string& name, int cells, double factor = 1,
                     const std::string& more = "") {
    const double edge = 5.0 / cells, mass = maths::puffMassSquareMetres(opacity, radius);
    std::string values;
    for (int z = 0; z < cells; ++z)
        for (int y = 0; y < cells; ++y)
            for (int x = 0; x < cells; ++x)
                values += fmt::format(
                    "{:.7g} ", factor * mass / std::pow(edge, 3) * share(centre.x, -2.5 + x * edge, edge) *
                                   share(centre.y, -2.5 + y * edge, edge) * share(centre.z, -2.5 + z * edge, edge));
    const std::string extent = fmt::format("0 {0} 0 {0} 0 {0}", cells);
    return folder
        .write(name, fmt::format("<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData "
                                 "WholeExtent=\"{}\" Origin=\"-2.5 -2.5 -2.5\" Spacing=\"{} {} {}\"><Piece "
                                 "Extent=\"{}\"><CellData><DataArray type=\"Float32\" Name=\"density\" "
                                 "format=\"ascii\">{}</DataArray>{}</CellData></Piece></ImageData></VTKFile>",
                                 extent, edge, edge, edge, extent, values, more))
        .string();
}

class ShownVolume : public testing::Test {
 protected:
    [[nodiscard]] static std::unique_ptr<Method> made(
        const std::string& file, const std::vector<std::pair<std::string, std::string>>& set = {}) {
        const MethodInfo info = describe();
        ParameterValues values(info.parameters);
        values.set("volume", file);
        values.set("stop_alpha", "1");
        for (const auto& [name, text] : set) values.set(name, text);
        return info.create(values);
    }
    /// The picture of a frame.
    pictures::Image pictureOf(Method& method, std::int64_t frame = 0) {
        if (frame == 0) method.prepare(moment_.scene, {}, TestMoment::device());
        const Frame first = moment_.frame();
        const Frame now{frame, first.stepSeconds, first.state, first.dust, first.view, first.clock};
        method.update(now);
        return moment_.picture([&](gpu::Layer& layer) { method.draw(now, layer); });
    }
    [[nodiscard]] std::optional<FactValue> fact(const Method& method, const std::string& name, std::int64_t frame) {
        const MethodInfo info = describe();
        Facts facts(info.facts, FactOver::lastFrame);
        const Frame first = moment_.frame();
        method.report({frame, first.stepSeconds, first.state, first.dust, first.view, first.clock}, facts);
        return facts.value(name);
    }
    [[nodiscard]] double real(const Method& method, const std::string& name, std::int64_t frame = 0) {
        return std::get<double>(*fact(method, name, frame));
    }
    /// The maximum difference of alpha from the closed form of the puff, `factor` times as dense.
    [[nodiscard]] double worst(const pictures::Image& picture, double factor = 1) const {
        double maximum = 0;
        const scene::View& view = moment_.view;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 along = glm::normalize(glm::dvec3(view.rayDirection(x + 0.5, y + 0.5)));
                const glm::dvec3 to = centre - view.camera.eye;
                const double foot = glm::dot(to, along), b = glm::length(to - foot * along);
                const double forward = glm::dot(along, glm::normalize(view.camera.target - view.camera.eye));
                const double depth = maths::rayOpticalDepth(opacity, radius, b, foot, 0, moment_.wallAt(x) / forward);
                const auto at = static_cast<std::size_t>(y * view.width + x);
                maximum = std::max(maximum,
                                   std::abs(static_cast<double>(picture.pixels[at].a) + std::expm1(-factor * depth)));
            }
        return maximum;
    }

    TestFolder folder_;
    TestMoment moment_{0, 64, 48, {0.3, 0.2, 6}, {-0.05, -0.03, -1}};
};

TEST_F(ShownVolume, EqualsTheClosedFormOfAPuffByEveryRenderer) {
    const std::string file = puffFile(folder_, "puff.vti", 50);
    struct Case {
        const char *name, *value;
        double worst;
    };
    moment_.setWall(6.2, 32);  // through its middle: hides half of it
    for (const auto& [name, value, bound] : {Case{"backend", "cpu", 0.006}, Case{"backend", "gl", 0.006},
                                             Case{"renderer", "slices", 0.012}, Case{"renderer", "splat", 0.09}}) {
        const auto method = made(file, {{name, value}});
        EXPECT_LT(worst(pictureOf(*method)), bound) << name << "=" << value;
        EXPECT_NEAR(real(*method, "volume_mass"), maths::puffMassSquareMetres(opacity, radius), 1e-4) << value;
    }
}

double difference(const pictures::Image& a, const pictures::Image& b) {
    double maximum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 4; ++channel)
            maximum = std::max(maximum, static_cast<double>(std::abs(a.pixels[i][channel] - b.pixels[i][channel])));
    return maximum;
}

/// Temperatures of 20³ cells, hot on one side, and a transfer function that shows them as fire.
std::string hotFile(const TestFolder& folder) {
    std::string hot = "<DataArray type=\"Float32\" Name=\"temperature\" format=\"ascii\">";
    for (int i = 0; i < 20 * 20 * 20; ++i) hot += i % 20 < 10 ? "300 " : std::to_string(900 + i % 600) + " ";
    (void)puffFile(folder, "fire.vti", 20, 1, hot + "</DataArray>");
    folder.write("flame.toml",
                 "[[row]]\nreaction = 0.0\nemission = [0, 0, 0]\n[[row]]\nreaction = 1.0\nemission = [9, 3, 0]\n");
    return folder
        .write("v.toml",
               "files = \"fire.vti\"\n[look]\nalbedo = [0.2, 0.3, 0]\nfire = \"flame.toml\"\ncold = 300\nhot = 1500\n"
               "shadow_cells = 3\n")
        .string();
}

TEST_F(ShownVolume, IsTheSameSparseAndDense) {
    // A puff touches the faces of its box; an odd number of cells is not a whole number of bricks.
    moment_.setWall(6.2, 32);
    const std::string hot = hotFile(folder_);
    (void)puffFile(folder_, "a.vti", 27, 1);
    (void)puffFile(folder_, "b.vti", 27, 3);
    const auto series =
        folder_.write("s.series", R"({"files": [{"name": "a.vti", "time": 7}, {"name": "b.vti", "time": 8}]})");
    for (const std::string& file : {std::string("cloud"), puffFile(folder_, "puff.vti", 27), hot, series.string()})
        for (const char* backend : {"cpu", "gl"}) {
            const auto dense = made(file, {{"backend", backend}}),
                       sparse = made(file, {{"backend", backend}, {"storage", "sparse"}});
            for (const std::int64_t frame : {0, 15, 45, 90}) {
                const pictures::Image expected = pictureOf(*dense, frame);
                EXPECT_LT(difference(pictureOf(*sparse, frame), expected), 1e-5) << file << ' ' << backend << frame;
                const double mass = real(*dense, "volume_mass", frame);
                EXPECT_NEAR(real(*sparse, "volume_mass", frame), mass, 1e-6 * mass);
                EXPECT_EQ(real(*sparse, "volume_held", frame), real(*dense, "volume_held", frame));
                EXPECT_EQ(sparse->primitives() > 0, dense->primitives() > 0);
            }
        }
}

/// Keeps a copy of the grid that is handed over.
struct Kept final : VolumeVisitor {
    void puffs(const Puffs&) override {}
    void octree(const OctreeVolume&) override {}
    void grid(const GridVolume& volume) override {
        place = volume;
        extinction.assign(volume.extinctionPerMetre.begin(), volume.extinctionPerMetre.end());
    }
    GridVolume place{};
    std::vector<float> extinction;
};

TEST_F(ShownVolume, IsHandedOverTheSameSparseAndDense) {
    Kept kept[2];
    for (const bool sparse : {false, true}) {
        const auto method = made("cloud", {{"storage", sparse ? "sparse" : "dense"}, {"extinction", "3"}});
        (void)pictureOf(*method);
        method->volume(moment_.frame(), kept[sparse ? 1 : 0]);
    }
    EXPECT_EQ(kept[0].place.cells, kept[1].place.cells);
    EXPECT_EQ(kept[0].place.originMetres, kept[1].place.originMetres);
    EXPECT_EQ(kept[0].place.spacingMetres, kept[1].place.spacingMetres);
    EXPECT_EQ(kept[0].extinction, kept[1].extinction);
}

TEST_F(ShownVolume, SparseTakesLessMemoryWhereMostOfTheBoxIsEmpty) {
    std::string values;
    for (int i = 0; i < 64 * 64 * 64; ++i) values += i == 777 || i == 64 * 64 * 64 - 5 ? "1 " : "0 ";
    const std::string file =
        folder_
            .write("two.vti",
                   "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\"><ImageData "
                   "WholeExtent=\"0 64 0 64 0 64\" Origin=\"-1 -1 -1\" Spacing=\"0.03 0.03 0.03\"><Piece "
                   "Extent=\"0 64 0 64 0 64\"><CellData><DataArray type=\"Float32\" Name=\"density\" "
                   "format=\"ascii\">" +
                       values + "</DataArray></CellData></Piece></ImageData></VTKFile>")
            .string();
    const auto bytes = [&](const char* storage, const char* backend) {
        const auto method = made(file, {{"storage", storage}, {"backend", backend}});
        (void)pictureOf(*method);
        std::size_t sum = 0;
        for (const auto& entry : method->memory()) sum += entry.cpuBytes + entry.gpuBytes;
        return sum;
    };
    for (const char* backend : {"cpu", "gl"})
        EXPECT_LT(2 * bytes("sparse", backend), bytes("dense", backend)) << backend;
}

TEST_F(ShownVolume, SparseRefusesOtherRenderersAndFiltersWhenItIsMade) {
    for (const auto& [name, value] :
         {std::pair("renderer", "slices"), std::pair("renderer", "splat"), std::pair("renderer", "isosurface"),
          std::pair("filter", "cubic"), std::pair("filter", "nearest")})
        EXPECT_THAT(inputError([&] {
                        (void)made("cloud", {{"storage", "sparse"}, {name, value}});
                    }),
                    HasSubstr(fmt::format("parameter {}: got {} with storage=sparse, allowed: ", name, value)));
}

TEST_F(ShownVolume, ErrsByTheSquareOfTheCellsEdge) {
    const auto error = [&](int cells) {
        return worst(
            pictureOf(*made(puffFile(folder_, "puff.vti", cells), {{"step_cells", "0.25"}, {"jitter", "off"}})));
    };
    const double ratio = error(12) / error(24);
    EXPECT_GT(ratio, 3.2);
    EXPECT_LT(ratio, 5);
}

TEST_F(ShownVolume, IsAsDenseAsTheFileAndTheParameterSay) {
    (void)puffFile(folder_, "puff.vti", 40);
    const auto setup = folder_.write("v.toml", "files = \"puff.vti\"\n[look]\nextinction_per_metre = 0.5\n").string();
    EXPECT_LT(worst(pictureOf(*made(setup)), 0.5), 0.006);
    EXPECT_LT(worst(pictureOf(*made(setup, {{"extinction", "2"}})), 2), 0.008);
}

TEST_F(ShownVolume, ChangesEvenlyBetweenItsMomentsAndHoldsTheLast) {
    (void)puffFile(folder_, "a.vti", 40, 1);
    (void)puffFile(folder_, "b.vti", 40, 3);
    const auto series =
        folder_.write("s.series", R"({"files": [{"name": "a.vti", "time": 7}, {"name": "b.vti", "time": 8}]})")
            .string();
    const auto method = made(series);
    EXPECT_LT(worst(pictureOf(*method), 1), 0.006);
    for (const std::int64_t frame : {15, 45})
        EXPECT_LT(worst(pictureOf(*method, frame), 1 + 2 * static_cast<double>(frame) / 60), 0.01) << frame;
    EXPECT_LT(worst(pictureOf(*method, 60), 3), 0.01);
    EXPECT_EQ(real(*method, "volume_held", 60), 0);
    EXPECT_LT(worst(pictureOf(*method, 90), 3), 0.01);
    EXPECT_NEAR(real(*method, "volume_held", 90), 0.5, 1e-9);
    // Preroll and warm-up show the first moment.
    EXPECT_LT(worst(pictureOf(*method, -20), 1), 0.006);
}

TEST_F(ShownVolume, ShowsTemperatureAsFireWhereItIsHot) {
    const std::string hot = "<DataArray type=\"Float32\" Name=\"temperature\" format=\"ascii\">" + [] {
        std::string values;
        for (int i = 0; i < 20 * 20 * 20; ++i) values += i % 20 < 10 ? "300 " : "1500 ";
        return values;
    }() + "</DataArray>";
    (void)puffFile(folder_, "fire.vti", 20, 1, hot);
    folder_.write("flame.toml",
                  "[[row]]\nreaction = 0.0\nemission = [0, 0, 0]\n[[row]]\nreaction = 1.0\nemission = [9, 3, 0]\n");
    const auto setup = folder_
                           .write("v.toml",
                                  "files = \"fire.vti\"\n[look]\nalbedo = [0, 0, 0]\nfire = \"flame.toml\"\n"
                                  "cold = 300\nhot = 1500\n")
                           .string();
    const pictures::Image picture = pictureOf(*made(setup));
    const auto sum = [&](int from, int to) {
        glm::vec3 total(0);
        for (int y = 0; y < 48; ++y)
            for (int x = from; x < to; ++x) total += glm::vec3(picture.pixels[static_cast<std::size_t>(y * 64 + x)]);
        return total;
    };
    EXPECT_GT(sum(36, 64).r, 20 * sum(0, 28).r);
    EXPECT_NEAR(static_cast<double>(sum(36, 64).r / sum(36, 64).g), 3, 0.01);
    (void)puffFile(folder_, "fire.vti", 20);
    EXPECT_THAT(inputError([&] { (void)pictureOf(*made(setup)); }),
                HasSubstr("fire.vti: it has no field of numbers 'temperature'"));
}

TEST_F(ShownVolume, ShadowsItselfInTheSunAndRefusesSplats) {
    const std::string file = puffFile(folder_, "puff.vti", 40);
    const pictures::Image unlit = pictureOf(*made(file));
    moment_.scene.lights.onDust = true;
    const pictures::Image lit = pictureOf(*made(file));
    double difference = 0;
    for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
        EXPECT_NEAR(static_cast<double>(lit.pixels[i].a), static_cast<double>(unlit.pixels[i].a), 1e-3);
        difference = std::max(difference, static_cast<double>(std::abs(lit.pixels[i].r - unlit.pixels[i].r)));
    }
    EXPECT_GT(difference, 0.02);
    EXPECT_THAT(inputError([&] {
                    (void)pictureOf(*made(file, {{"renderer", "splat"}}));
                }),
                HasSubstr("got splat with light=sun"));
}

}  // namespace
}  // namespace dustbench::volume
