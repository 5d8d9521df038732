#include "methods/kit/particles/part_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/test_world.h"
#include "methods/kit/testing/test_folder.h"
#include "source_folder.h"

namespace dustbench::particles {
namespace {

using test::everyForce;
using test::with;
using testing::AllOf;
using testing::HasSubstr;

std::string errorOf(const std::string& toml) {
    try {
        test::systemFrom(toml);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(PartToml, SavingAndLoadingGivesTheSameSystem) {
    const auto wheelDust = partsFromFile(DUSTBENCH_SOURCE_DIR "/data/particles/wheel_dust.toml");
    for (const std::string& toml : {everyForce, partsToToml(*wheelDust)}) {
        auto system = test::systemFrom(toml);
        auto again = test::systemFrom(system.toToml());
        EXPECT_EQ(again.toToml(), system.toToml());
        const auto scene = test::sceneWithCar();
        test::advance(system, scene, 100);
        test::advance(again, scene, 100);
        EXPECT_GT(system.store().size(), 0u);
        EXPECT_EQ(again.stateHash(), system.stateHash());
    }
}

TEST(PartToml, EveryPartOfTheTableSurvivesSavingAndLoading) {
    for (const PartInfo& info : partTable()) {
        auto parts = partsFromText(everyForce, "test.toml");
        if (info.name == "lifetime") parts->lives().clear();
        test::giveLattice(*parts, info);
        parts->set(info.create(ParameterValues(info.parameters)));
        const std::string saved = partsToToml(*parts);
        EXPECT_THAT(saved, HasSubstr("part = \"" + info.name + "\""));
        EXPECT_EQ(partsToToml(*partsFromText(saved, "saved.toml")), saved) << info.name;
    }
}

TEST(PartTable, NamesAreUniqueWithinTheirKindAndEveryThingHasHelp) {
    std::set<std::pair<PartKind, std::string>> names;
    for (const PartInfo& info : partTable()) {
        EXPECT_TRUE(names.emplace(info.kind, info.name).second) << info.name;
        EXPECT_FALSE(info.help.empty()) << info.name;
        for (const Parameter& parameter : info.parameters.all()) EXPECT_FALSE(parameter.help.empty()) << parameter.name;
        const auto part = makePart(info.kind, info.name);
        EXPECT_EQ(part->name(), info.name);
        EXPECT_EQ(part->kind(), info.kind);
    }
}

TEST(PartTable, HasEveryFileOfThePartsFolderAndNothingElse) {
    std::set<std::string> files, parts;
    const std::filesystem::path folder = DUSTBENCH_SOURCE_DIR "/methods/kit/particles/parts";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string file = entry.path().lexically_relative(folder).generic_string();
        if (file.ends_with(".cpp") && !file.ends_with("_test.cpp") && !file.ends_with("_bench.cpp")) files.insert(file);
    }
    for (const PartInfo& info : partTable()) parts.insert(std::string(kindName(info.kind)) + "/" + info.name + ".cpp");
    EXPECT_EQ(parts, files);
    EXPECT_GE(parts.size(), 16u);
}

TEST(PartTable, GoesKindByKindThenByName) {
    const auto place = [](const PartInfo& info) { return std::pair(info.kind, info.name); };
    EXPECT_TRUE(std::ranges::is_sorted(partTable(), {}, place));
}

TEST(PartToml, KeysOfATableStandForAllParametersAndTheirDefaultsCanBeWrittenInAFile) {
    for (const PartInfo& info : partTable()) {
        auto parts = partsFromText(everyForce, "test.toml");
        if (info.name == "lifetime") parts->lives().clear();
        test::giveLattice(*parts, info);
        parts->set(info.create(ParameterValues(info.parameters)));
        const std::string toml = partsToToml(*parts);
        for (const Parameter& key : tableKeys(info.parameters))
            EXPECT_THAT(toml, HasSubstr("\n" + key.name + " = " + valueToToml(key, key.initial) + "\n")) << info.name;
    }
    const auto keys = tableKeys(findPart(PartKind::velocity, "cone").parameters);
    EXPECT_EQ(keys.at(0).name, "mode");
    EXPECT_EQ(valueToToml(keys.at(0), keys.at(0).initial), "\"fixed\"");
    EXPECT_EQ(keys.at(1).name, "direction");
    EXPECT_EQ(keys.at(1).initial, "[0, 1, 0]");
}

TEST(PartToml, ErrorsNameFileAndLineAndTheNearestName) {
    EXPECT_THAT(errorOf(with(everyForce, "\"drag\"", "\"dragg\"")),
                AllOf(HasSubstr("test.toml:10: "), HasSubstr("force part 'dragg'"), HasSubstr("did you mean 'drag'")));
    EXPECT_THAT(errorOf(with(everyForce, "rate_per_metre", "rate_per_meter")),
                AllOf(HasSubstr("test.toml:2: "), HasSubstr("did you mean 'rate_per_metre'")));
    EXPECT_THAT(errorOf(with(everyForce, "rate_per_metre = 25", "rate_per_metre = -1")),
                AllOf(HasSubstr("test.toml:2: "), HasSubstr("got '-1'"), HasSubstr("allowed: number 0..")));
    EXPECT_THAT(errorOf(with(everyForce, "[-0.5, 0.8, 0.1]", "[1, 2]")),
                AllOf(HasSubstr("test.toml:4: "), HasSubstr("direction: got 2 values, expected 3")));
    EXPECT_THAT(errorOf(with(everyForce, "[-0.5, 0.8, 0.1]", "[0, 0, 0]")),
                AllOf(HasSubstr("test.toml:4: "), HasSubstr("direction")));
    EXPECT_THAT(errorOf(with(everyForce, "variation_seconds = 0.5", "variation_seconds = 0.8")),
                AllOf(HasSubstr("test.toml:7: "), HasSubstr("less than average_seconds")));
    EXPECT_THAT(errorOf(with(everyForce, "force = [", "forces = [")), HasSubstr("did you mean 'force'"));
    EXPECT_THAT(errorOf(with(everyForce, "size = {", "# ")), AllOf(HasSubstr("test.toml:"), HasSubstr("'size'")));
    EXPECT_THAT(errorOf(with(everyForce, "life = [ { part = \"lifetime\", ", "life = [] # ")),
                HasSubstr("sets lifetimes"));
    EXPECT_THAT(errorOf("size = 3"), HasSubstr("test.toml:1: "));
}

/// `parts` as one of several systems.
std::string named(const std::string& name, const std::string& parts = everyForce) {
    return "[[system]]\nname = \"" + name + "\"\n" + parts;
}

std::string systemsErrorOf(const std::string& toml) {
    try {
        (void)systemsFromText(toml, "two.toml");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

std::string saved(const std::vector<NamedParts>& systems) {
    std::vector<NamedPartsView> views;
    views.reserve(systems.size());
    for (const NamedParts& each : systems) views.push_back({each.name, *each.parts});
    return systemsToToml(views);
}

TEST(PartToml, SeveralSystemsSurviveSavingAndLoading) {
    const std::string two = named("smoke") + named("fire_2", with(everyForce, "\"linear\"", "\"constant\""));
    const auto systems = systemsFromText(two, "two.toml");
    ASSERT_EQ(systems.size(), 2u);
    EXPECT_EQ(systems[0].name, "smoke");
    EXPECT_EQ(systems[1].name, "fire_2");
    EXPECT_EQ(partsToToml(*systems[0].parts), partsToToml(*partsFromText(everyForce, "test.toml")));
    const auto again = systemsFromText(saved(systems), "saved.toml");
    EXPECT_EQ(saved(again), saved(systems));
    EXPECT_EQ(again[1].parts->size()->name(), "constant");
}

TEST(PartToml, AFileWithoutNamesIsOneSystemNamedAfterIt) {
    const auto systems = systemsFromText(everyForce, "data/dusty.toml");
    ASSERT_EQ(systems.size(), 1u);
    EXPECT_EQ(systems[0].name, "dusty");
    EXPECT_EQ(saved(systems), partsToToml(*systems[0].parts));
}

TEST(PartToml, ErrorsOfSeveralSystemsNameFileAndLine) {
    const std::string one = named("smoke");
    EXPECT_THAT(systemsErrorOf(one + one), AllOf(HasSubstr("two.toml:"), HasSubstr("two systems are named 'smoke'")));
    EXPECT_THAT(systemsErrorOf(with(one, "smoke", "Smoke")), HasSubstr("two.toml:2: key 'name': got 'Smoke'"));
    EXPECT_THAT(systemsErrorOf(with(one, "smoke", "size")), HasSubstr("not a kind of part"));
    EXPECT_THAT(systemsErrorOf(with(one, "name", "nam")), HasSubstr("'system.name' is missing"));
    EXPECT_THAT(systemsErrorOf(with(one, "\"drag\"", "\"dragg\"")), HasSubstr("did you mean 'drag'"));
    EXPECT_THAT(systemsErrorOf("system = []"), HasSubstr("one or more"));
    EXPECT_THAT(systemsErrorOf("wind = 3\n" + one), HasSubstr("'wind'"));
    EXPECT_THAT(errorOf(one + with(one, "smoke", "fire")), HasSubstr("got 2 particle systems, expected one"));
}

TEST(PartToml, MissingFileIsAnErrorWithItsName) {
    EXPECT_THROW(ParticleSystem::load("/no/such/dust.toml", 1), InputError);
}

TEST(PartToml, FilesThatAFileNamesLieBesideItAndElseAmongTheData) {
    namespace fs = std::filesystem;
    const TestFolder place;
    const fs::path& folder = place.path();
    fs::create_directories(folder / "meshes");
    fs::copy_file(DUSTBENCH_SOURCE_DIR "/data/shapes/meshes/hare.ply", folder / "meshes/own.ply");
    const auto read = [&](const std::string& mesh) {
        std::ofstream(folder / "mine.toml")
            << with(everyForce, "part = \"disc\", radius_metres = 0.2", "part = \"mesh\", mesh = \"" + mesh + "\"");
        return partsFromFile(folder / "mine.toml")->position()->values().choice("mesh");
    };
    EXPECT_EQ(read("hare"), "hare");
    EXPECT_EQ(read("meshes/own.ply"), (folder / "meshes/own.ply").string());
    EXPECT_EQ(read("./meshes/../meshes/own.ply"), (folder / "meshes/own.ply").string());
    EXPECT_THAT(read("hare.ply"), testing::EndsWith("data/shapes/meshes/hare.ply"));
    // The working directory has no influence.
    const fs::path before = fs::current_path();
    fs::current_path(folder / "meshes");
    EXPECT_THAT(
        [&] {
            try {
                return read("./own.ply");
            } catch (const InputError& error) {
                return std::string(error.what());
            }
        }(),
        AllOf(HasSubstr("mine.toml:"), HasSubstr("no such file, tried " + (folder / "own.ply").string())));
    EXPECT_EQ(read("meshes/own.ply"), (folder / "meshes/own.ply").string());
    fs::current_path(before);
    // Saved, it has the same meaning in any other folder.
    const auto system = systemsFromFile(folder / "mine.toml");
    const auto again = partsFromText(partsToToml(*system.front().parts), "elsewhere.toml");
    EXPECT_EQ(again->position()->values().choice("mesh"), (folder / "meshes/own.ply").string());
}

}  // namespace
}  // namespace dustbench::particles
