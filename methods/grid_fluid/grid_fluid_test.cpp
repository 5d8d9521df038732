#include "methods/grid_fluid/grid_fluid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "methods/contract/volume.h"
#include "methods/grid_fluid/emitters.h"
#include "methods/grid_fluid/fluid_setup.h"
#include "methods/grid_fluid/test_bodies.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/maths/transmittance.h"
#include "methods/kit/testing/test_folder.h"
#include "methods/kit/testing/test_input_error.h"
#include "methods/kit/testing/test_moment.h"

namespace dustbench::grid_fluid {
namespace {

GridFluidSettings settingsOf(const char* fluid, glm::ivec3 cells) {
    GridFluidSettings settings;
    settings.setup = readFluid(files::dataFolder() / "fluids" / (std::string(fluid) + ".toml"));
    settings.solver.forces = settings.setup.forces;
    settings.solver.box.cells = cells;
    settings.solver.box.spacingMetres = settings.setup.lengthMetres / cells.x;
    settings.solver.keepsDensity = settings.setup.keepsDensity;
    settings.solver.advection.limit = flow::Limit::revert;
    settings.picture.backend = raycast::Backend::gl;
    return settings;
}

/// A vehicle, a ball of 1.2 m, that drives along +X at 12 m/s over dust of identical puffs.
class Drive : public TestMoment {
 public:
    static constexpr std::size_t puffs = 240;

    Drive() : TestMoment(puffs, 120, 90, {0, 3, 20}, {0, -0.1, -1}) {
        scene::Mesh body = ball(10), wheel;
        wheel.append(body, glm::mat4(placed({}, 0.33)));
        for (glm::vec3& position : body.positions) position += glm::vec3(1, 1.3f, 0);
        scene.vehicle = scene::VehicleModel{
            {}, {"ball", std::make_shared<scene::Mesh>(body)}, {"wheel", std::make_shared<scene::Mesh>(wheel)}};
        state.vehicle.speed = 12;
        for (std::size_t i = 0; i < puffs; ++i) {
            dust.radius[i] = 1;
            dust.opacity[i] = 0.1f;
            dust.lifetime[i] = 4;
            dust.age[i] = i == 0 ? 0.001f : 1;  // one birth per step: 60 per second, 240 alive
        }
        move();
    }
    void go(GridFluid& method, int steps) {
        for (int step = 0; step < steps; ++step) {
            state.timeSeconds += 1.0 / 60;
            state.vehicle.position.x += 12.0 / 60;
            move();
            method.update(frame());
        }
    }

 private:
    void move() {
        for (std::size_t w = 0; w < 4; ++w) {
            scene::WheelState& wheel = state.vehicle.wheels[w];
            wheel.contact = state.vehicle.position + glm::dvec3(w < 2 ? 2.6 : 0, 0, w % 2 == 0 ? -0.8 : 0.8);
            wheel.hub = wheel.contact + glm::dvec3(0, 0.33, 0);
            wheel.velocity = {12, 0, 0};
        }
    }
};

TEST(DustMass, IsThatOfTheSharedCloudWhileAllIsWithinTheBox) {
    Drive drive;
    EXPECT_EQ(bornWithin(drive.dust, 1.0 / 60), 1u);
    EXPECT_NEAR(meanLifetimeSeconds(drive.dust), 4, 1e-6);
    const double puff = maths::puffMassSquareMetres(0.1, 1);
    EXPECT_NEAR(meanPuffMassSquareMetres(drive.dust), puff, 1e-6 * puff);

    GridFluidSettings settings = settingsOf("dust", {64, 16, 32});
    settings.solver.box.spacingMetres = 0.4;
    GridFluid method(settings);
    method.prepare(drive.scene, {}, Drive::device());
    drive.go(method, 30);
    // d(mass)/dt = births·puff − mass/lifetime
    const double expected = 60 * puff * 4 * (1 - std::exp(-0.5 / 4));
    EXPECT_NEAR(method.opticalMassSquareMetres(), expected, 0.03 * expected);
    const MethodInfo info = describe();
    Facts facts(info.facts, FactOver::lastFrame);
    method.report(drive.frame(), facts);
    const double share = std::get<double>(facts.value("mass_kept").value());
    EXPECT_NEAR(share, expected / (240 * puff), 0.03 * expected / (240 * puff));
    const auto fact = [&](const char* name) { return std::get<double>(facts.value(name).value()); };
    EXPECT_GT(fact("flow_divergence"), 0);
    EXPECT_LE(fact("flow_divergence"), 1.01 * static_cast<double>(settings.solver.divergencePerStep));
    for (const char* noise : {"flow_noise_speed", "flow_noise_density"}) {
        EXPECT_GT(fact(noise), 0) << noise;
        EXPECT_LT(fact(noise), 0.05) << noise;  // random numbers give 0.2
    }
}

/// Returns whether the cells of the flow are in GPU memory.
bool isSolvedOnGpu(const GridFluid& method) {
    const MemoryReport report = method.memory();
    return std::ranges::any_of(report,
                               [](const MemoryUse& use) { return use.structure == "fluid cells" && use.gpuBytes > 0; });
}

TEST(GridFluid, FollowsTheVehicleByWholeCellsAndHandsOverAllItHas) {
    class Collector final : public VolumeVisitor {
     public:
        void puffs(const Puffs&) override { ADD_FAILURE() << "puffs"; }
        void octree(const OctreeVolume&) override { ADD_FAILURE() << "octree"; }
        void grid(const GridVolume& volume) override {
            if (volume.fields.empty()) {  // a tile of the trail
                for (const float extinction : volume.extinctionPerMetre)
                    massOfTrail += static_cast<double>(extinction) * std::pow(volume.spacingMetres, 3);
                return;
            }
            ++grids;
            originMetres = volume.originMetres;
            mass = inside = massOfTrail = 0;
            names.clear();
            const std::size_t cells = volume.extinctionPerMetre.size();
            EXPECT_EQ(cells, 48u * 16 * 32);
            for (const float extinction : volume.extinctionPerMetre)
                mass += static_cast<double>(extinction) * std::pow(volume.spacingMetres, 3);
            for (const GridField& field : volume.fields) {
                EXPECT_EQ(field.values.size(), cells * static_cast<std::size_t>(field.components)) << field.name;
                names.emplace_back(field.name);
                if (field.name != "solids") continue;
                for (const float solid : field.values) inside += static_cast<double>(solid);
            }
        }
        int grids = 0;
        glm::dvec3 originMetres{0};
        double mass = 0, inside = 0, massOfTrail = 0;
        std::vector<std::string> names;
    } collector;
    Drive drive;
    GridFluidSettings settings = settingsOf("dust", {48, 16, 32});
    settings.solver.box.spacingMetres = 0.25;
    GridFluid method(settings);
    method.prepare(drive.scene, {}, Drive::device());
    drive.go(method, 12);
    method.volume(drive.frame(), collector);
    const double first = collector.originMetres.x;
    drive.go(method, 30);
    method.volume(drive.frame(), collector);
    const double moved = (collector.originMetres.x - first) / 0.25;
    EXPECT_NEAR(moved, std::round(moved), 1e-9);
    EXPECT_NEAR(moved, 24, 4);
    EXPECT_EQ(collector.originMetres.y, 0);
    EXPECT_EQ(collector.grids, 2);
    EXPECT_NEAR(collector.mass + collector.massOfTrail, method.opticalMassSquareMetres(), 1e-4 * collector.mass);
    EXPECT_EQ(collector.names, (std::vector<std::string>{"density", "temperature", "reaction", "velocity",
                                                         "face_speeds", "pressure", "solids"}));
    // The body and its four wheels, apart from their overlap.
    const double volume = collector.inside * std::pow(0.25, 3);
    EXPECT_NEAR(volume, 4.0 / 3 * std::numbers::pi * (1 + 4 * std::pow(0.33, 3)), 0.6);

    // It appears at its position, and two drawings are identical.
    const pictures::Image picture = drive.draw(method), again = drive.draw(method);
    EXPECT_GT(method.primitives(), 0);
    EXPECT_EQ(picture.pixels, again.pixels);
    double alpha = 0;
    for (const glm::vec4& pixel : picture.pixels) alpha += static_cast<double>(pixel.a);
    EXPECT_GT(alpha, 1);
}

TEST(GridFluid, KeepsTheDustThatItsBoxLeavesBehind) {
    const MethodInfo info = describe();
    const auto factsAfter = [&](SolverBackend solver, bool trail, int steps) {
        Drive drive;
        drive.scene.wind = {0.6f, 0, -0.9f};
        GridFluidSettings settings = settingsOf("dust", {48, 16, 32});
        settings.solver.box.spacingMetres = 0.25;
        settings.solverBackend = solver;
        settings.trail = trail;
        GridFluid method(settings);
        method.prepare(drive.scene, {}, Drive::device());
        drive.go(method, steps);
        Facts facts(info.facts, FactOver::lastFrame);
        method.report(drive.frame(), facts);
        return facts;
    };
    // Dust of constant rate and lifetime T reaches rate·T·(1 − e^(−t/T)) of rate·T after t.
    const double expected = 1 - std::exp(-2.5 / 4);
    const FactInfo& lost = *std::ranges::find(info.facts, "mass_lost", &FactInfo::name);
    for (const SolverBackend solver : {SolverBackend::cpu, SolverBackend::openGl}) {
        const Facts facts = factsAfter(solver, true, 150);  // 30 m: two and a half boxes
        EXPECT_LT(std::get<double>(facts.value("mass_lost").value()), 0.003);
        EXPECT_NEAR(std::get<double>(facts.value("mass_kept").value()), expected, 0.02 * expected);
    }
    EXPECT_FALSE(lost.valid.contains(0.011)) << "a run that loses more is not valid";
    const Facts without = factsAfter(SolverBackend::cpu, false, 150);
    EXPECT_FALSE(without.value("mass_lost")) << "without a trail there is no such value";
    EXPECT_LT(std::get<double>(without.value("mass_kept").value()), 0.6 * expected);
}

TEST(GridFluid, IsTheSameAgainAndFollowsItsSeed) {
    const auto hashOf = [](std::uint64_t seed) {
        TestMoment moment(0, 32, 32, {0, 2, 8}, {0, 0, -1});
        moment.scene.solids = {{"hare", std::make_shared<scene::Mesh>(ball(8))}};
        moment.scene.solidPoses = {{glm::mat4(placed({0, 0.8, 0}, 0.5)), {}, {}}};
        GridFluidSettings settings = settingsOf("fire", {16, 24, 16});
        GridFluid method(settings);
        method.prepare(moment.scene, {.seed = seed}, TestMoment::device());
        for (int step = 0; step < 5; ++step) method.update(moment.frame());
        return method.stateHash();
    };
    EXPECT_EQ(hashOf(1), hashOf(1));
    EXPECT_NE(hashOf(1), hashOf(2));
}

TEST(GridFluid, IsDrawnAlikeByEitherSolver) {
    const auto pictureOf = [](SolverBackend solver, raycast::Backend backend, double& mass) {
        TestMoment moment(0, 64, 64, {0, 1.2, 4}, {0, 0, -1});
        moment.scene.solids = {{"hare", std::make_shared<scene::Mesh>(ball(8))}};
        moment.scene.solidPoses = {{glm::mat4(placed({0, 0.8, 0}, 0.5)), {}, {}}};
        GridFluidSettings settings = settingsOf("fire", {20, 28, 20});
        settings.setup.look.fire = "";  // smoke, and its shadow
        settings.setup.look.extinctionPerMetre = 20;
        settings.picture.extinctionPerMetre = 20;
        settings.picture.shadowCells = 2;
        settings.picture.backend = backend;
        settings.solverBackend = solver;
        GridFluid method(settings);
        method.prepare(moment.scene, {}, TestMoment::device());
        EXPECT_EQ(isSolvedOnGpu(method), solver == SolverBackend::openGl);
        for (int step = 0; step < 5; ++step) method.update(moment.frame());
        mass = method.opticalMassSquareMetres();
        return moment.draw(method);
    };
    for (const raycast::Backend backend : {raycast::Backend::cpu, raycast::Backend::gl}) {
        double mass = 0, massOnGpu = 0;
        const pictures::Image expected = pictureOf(SolverBackend::cpu, backend, mass);
        const pictures::Image picture = pictureOf(SolverBackend::openGl, backend, massOnGpu);
        EXPECT_NEAR(massOnGpu, mass, 1e-4 * mass);
        float maximum = 0, off = 0;
        for (std::size_t p = 0; p < expected.pixels.size(); ++p) {
            maximum = std::max(maximum, expected.pixels[p].a);
            const glm::vec4 difference = glm::abs(picture.pixels[p] - expected.pixels[p]);
            off = std::max({off, difference.r, difference.g, difference.b, difference.a});
        }
        EXPECT_GT(maximum, 0.1f);
        EXPECT_LE(off, 1e-3f);
    }
}

TEST(GridFluid, ShowsNothingWhereCorrectionsWithoutALimitPullItBelow0) {
    class Lowest final : public VolumeVisitor {
     public:
        void puffs(const Puffs&) override {}
        void octree(const OctreeVolume&) override {}
        void grid(const GridVolume& volume) override {
            stored = std::min(stored, std::ranges::min(volume.fields[0].values));
            seen = std::min(seen, std::ranges::min(volume.extinctionPerMetre));
        }
        float stored = 0, seen = 0;
    };
    for (const SolverBackend solver : {SolverBackend::cpu, SolverBackend::openGl}) {
        TestMoment moment(0, 64, 64, {0, 1.2, 4}, {0, 0, -1});
        moment.scene.solids = {{"hare", std::make_shared<scene::Mesh>(ball(8))}};
        moment.scene.solidPoses = {{glm::mat4(placed({0, 0.8, 0}, 0.5)), {}, {}}};
        GridFluidSettings settings = settingsOf("fire", {20, 28, 20});
        settings.solver.advection.limit = flow::Limit::none;
        settings.solverBackend = solver;
        GridFluid method(settings);
        method.prepare(moment.scene, {}, TestMoment::device());
        for (int step = 0; step < 12; ++step) method.update(moment.frame());
        Lowest lowest;
        method.volume(moment.frame(), lowest);
        EXPECT_LT(lowest.stored, 0);
        EXPECT_EQ(lowest.seen, 0);
        EXPECT_NO_THROW(moment.draw(method));
    }
}

TEST(GridFluid, IsSolvedWhereThePictureIsMadeUnlessToldOtherwise) {
    TestMoment moment(0, 8, 8, {0, 2, 8}, {0, 0, -1});
    const bool hardware = !TestMoment::device().isSoftware();
    for (const raycast::Backend backend : {raycast::Backend::automatic, raycast::Backend::cpu, raycast::Backend::gl}) {
        GridFluidSettings settings = settingsOf("plume", {16, 16, 16});
        settings.picture.backend = backend;
        settings.solverBackend = SolverBackend::automatic;
        GridFluid method(settings);
        method.prepare(moment.scene, {}, TestMoment::device());
        EXPECT_EQ(isSolvedOnGpu(method), hardware && backend != raycast::Backend::cpu);
    }
    GridFluidSettings settings = settingsOf("plume", {16, 16, 16});
    settings.solverBackend = SolverBackend::openGl;
    GridFluid method(settings);
    method.prepare(moment.scene, {}, TestMoment::device());
    std::size_t onGpu = 0;
    for (const MemoryUse& use : method.memory()) onGpu += use.gpuBytes;
    EXPECT_GE(onGpu, 16u * 16 * 16 * (3 * 24 + 4 + 12 + 4));  // three fields, kinds, pressure and the displayed field
}

TEST(GridFluid, RefusesWhatCannotFlow) {
    TestMoment moment(0, 32, 32, {0, 2, 8}, {0, 0, -1});
    moment.scene.id = "bare";
    const auto refusal = [&](GridFluidSettings settings, int steps = 0) {
        return inputError([&] {
            GridFluid method(settings);
            method.prepare(moment.scene, {}, TestMoment::device());
            for (int step = 0; step < steps; ++step) method.update(moment.frame());
        });
    };
    EXPECT_NE(refusal(settingsOf("fire", {16, 16, 16})).find("unknown solid of scene 'bare' 'hare'"),
              std::string::npos);
    EXPECT_NE(refusal(settingsOf("dust", {16, 16, 16})).find("no vehicle"), std::string::npos);
    GridFluidSettings outside = settingsOf("plume", {16, 16, 16});
    outside.setup.middleMetres = {50, 0, 0};
    EXPECT_NE(refusal(outside).find("all of its sources lie outside the box"), std::string::npos);
    GridFluidSettings fast = settingsOf("plume", {16, 16, 16});
    fast.solver.forces.buoyancyPerKelvin = 1e6f;
    EXPECT_NE(refusal(fast, 2).find("allowed: at most 100"), std::string::npos);
    moment.scene.solids = {{"rock", std::make_shared<scene::Mesh>(ball(8))}};
    moment.scene.solidPoses = {{glm::mat4(placed({0, 0, 0}, 20)), {}, {}}};
    EXPECT_NE(refusal(settingsOf("plume", {16, 16, 16}), 1).find("the whole box is solid"), std::string::npos);
}

TEST(Emitters, SwingAsASineWithinTheirChance) {
    scene::Scene scene;
    scene::SceneState state;
    SourceSetup setup;
    setup.densityPerSecond = 10;
    setup.swing = 0.4f;
    setup.swingSeconds = 0.5f;
    const auto strengths = [&](float chance, std::uint64_t seed) {
        setup.chance = chance;
        const std::vector<SourceSetup> setups{setup};
        Emitters emitters(setups, scene, seed);
        std::vector<double> found;
        for (int step = 0; step < 60; ++step) {
            state.timeSeconds = step / 60.0;
            const flow::FluidSource& source = emitters.at(state, step, 1.0 / 60, 0).front();
            found.push_back(static_cast<double>(source.densityPerSecond) / 10);
        }
        return found;
    };
    const std::vector<double> sine = strengths(0, 1), noisy = strengths(0.3f, 1);
    // A sine around 0.8 with amplitude 0.2 and a period of 30 steps: values half a period apart have a fixed sum.
    EXPECT_NEAR(*std::ranges::max_element(sine), 1, 0.002);
    EXPECT_NEAR(*std::ranges::min_element(sine), 0.6, 0.002);
    for (std::size_t step = 0; step + 30 < sine.size(); ++step) {
        EXPECT_NEAR(sine[step] + sine[step + 15], 1.6, 1e-5);
        EXPECT_NEAR(sine[step], sine[step + 30], 1e-5);
    }
    double apart = 0;
    for (std::size_t step = 0; step < sine.size(); ++step) {
        const double ratio = noisy[step] / sine[step];
        EXPECT_GE(ratio, 0.7 - 1e-6);
        EXPECT_LE(ratio, 1.3 + 1e-6);
        apart = std::max(apart, std::abs(ratio - 1));
    }
    EXPECT_GT(apart, 0.2);
    EXPECT_EQ(noisy, strengths(0.3f, 1));
    EXPECT_NE(noisy, strengths(0.3f, 2));
}

TEST(FluidFile, SaysWhatIsWrongWithFileAndLine) {
    TestFolder folder;
    const auto refusal = [&](const std::string& text) {
        return inputError([&] { (void)readFluid(folder.write("x.toml", "description = \"x\"\n" + text)); });
    };
    const std::string box = "[box]\nlength_metres = 2\n", source = "[[source]]\nat = \"wheels\"\nradius_metres = 1\n";
    EXPECT_EQ(readFluid(folder.write("good.toml", "description = \"x\"\n" + box + source)).lengthMetres, 2);
    EXPECT_NE(refusal(source).find("box"), std::string::npos);
    EXPECT_NE(refusal(box).find("[[source]]"), std::string::npos);
    EXPECT_NE(refusal("[box]\nlength_metres = 0\n" + source).find("x.toml:3"), std::string::npos);
    EXPECT_NE(refusal(box + source + "velocity = [1, 2, 1e9]\n").find("x.toml:7"), std::string::npos);
    EXPECT_NE(refusal(box + source + "swing = 1\n").find("swing"), std::string::npos);
    EXPECT_NE(refusal(box + "[flow]\nbuoyancy_per_kelvin = nan\n" + source).find("x.toml:5"), std::string::npos);
}

}  // namespace
}  // namespace dustbench::grid_fluid
