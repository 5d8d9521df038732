#include "bench/view/view_state.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/results/shell_words.h"
#include "bench/world/world.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/testing/test_input_error.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;

/// A valid value that is not the default.
std::string otherValue(const Parameter& parameter) {
    switch (parameter.type) {
        case ParameterType::integer: {
            const double up = std::stod(parameter.initial) + 1;
            return files::csvNumber(up <= parameter.maximum ? up : parameter.minimum);
        }
        case ParameterType::real: {
            const double share = 0.3 * parameter.minimum + 0.7 * parameter.maximum;
            return files::csvNumber(share == std::stod(parameter.initial) ? parameter.maximum : share);
        }
        case ParameterType::boolean:
            return parameter.initial == "on" ? "off" : "on";
        case ParameterType::choice:
            for (const std::string& choice : parameter.choices)
                if (choice != parameter.initial) return choice;
            return parameter.initial;
        case ParameterType::cells:
            return "16x24x32";
        case ParameterType::changes:
            return "0.5s:velocity.speed=8;1s:velocity.speed=3";
    }
    return {};
}

/// A state in which everything except the method's parameters differs from its default.
ViewState unusual(const std::string& method) {
    ViewState state;
    state.scene = "dir with 'quotes'/scene.toml";
    state.drive = "slalom";
    state.cameraPath = "0,1,2,3,4,5,6,50;2,1,2,9,4,5,6,50.25";
    state.world = {{"particles", "3000"}, {"preroll", "0.5"}};
    state.seed = 1'234'567'890'123;
    state.size = {321, 123};
    state.threads = 2;
    state.warmup = 3;
    state.frame = 77;
    state.a.method = method;
    return state;
}

void expectSameText(const ViewState& state) {
    const std::string line = commandLine(state, Half::a, "out/view");
    EXPECT_EQ(stateOfCommandLine(line), state) << line;
    EXPECT_EQ(stateOfToml(toToml(state), "state.toml"), state) << toToml(state);
    EXPECT_EQ(results::canonicalKey(runOf(stateOfCommandLine(line), Half::a)),
              results::canonicalKey(runOf(state, Half::a)));
}

TEST(ViewState, OfEveryMethodAndParameterIsItsText) {
    for (const MethodInfo& method : methods()) {
        expectSameText(normalised(unusual(method.id)));
        ViewState all = unusual(method.id);
        for (const Parameter& parameter : method.parameters.all()) {
            ViewState one = unusual(method.id);
            one.a.parameters[parameter.name] = all.a.parameters[parameter.name] = otherValue(parameter);
            SCOPED_TRACE(method.id + " " + parameter.name + "=" + otherValue(parameter));
            expectSameText(normalised(one));
            const auto kept = normalised(one).a.parameters;
            EXPECT_EQ(kept.contains(parameter.name), otherValue(parameter) != parameter.initial);
        }
        expectSameText(normalised(all));
        for (const Parameter& parameter : world::worldParameters().all()) {
            if (method.parameters.find(parameter.name)) continue;
            ViewState one = unusual(method.id);
            one.world[parameter.name] = otherValue(parameter);
            expectSameText(normalised(one));
        }
    }
}

TEST(ViewState, OfTwoHalvesIsItsToml) {
    ViewState state = unusual(methods().front().id);
    for (const MethodInfo& method : methods()) {
        state.b = HalfState{method.id, {}};
        for (const Parameter& parameter : method.parameters.all())
            state.b->parameters[parameter.name] = otherValue(parameter);
        const ViewState written = normalised(state);
        EXPECT_EQ(stateOfToml(toToml(written), "state.toml"), written);
        EXPECT_EQ(half(stateOfCommandLine(commandLine(written, Half::b, "o")), Half::a), *written.b);
    }
}

TEST(ViewState, OfDefaultsNamesNoParameters) {
    ViewState state;
    state.a.method = methods().front().id;
    for (const Parameter& parameter : methods().front().parameters.all())
        state.a.parameters[parameter.name] = parameter.initial;
    for (const Parameter& parameter : world::worldParameters().all()) state.world[parameter.name] = parameter.initial;
    EXPECT_THAT(commandLine(state, Half::a, "o"), ::testing::Not(HasSubstr("-P")));
    EXPECT_EQ(toToml(normalised(state)).find("parameters"), std::string::npos);
}

TEST(ViewState, KeepsAValueThatAPresetWouldChange) {
    for (const MethodInfo& method : methods())
        for (const Preset& preset : method.parameters.presets()) {
            const auto& [name, text] = preset.defaults.front();
            const std::string initial = method.parameters.find(name)->initial;
            if (initial == text) continue;
            ViewState state = unusual(method.id);
            state.a.parameters = {{preset.parameter, preset.word}, {name, initial}};
            EXPECT_EQ(normalised(state).a.parameters.count(name), 1u) << method.id << " " << name;
            state.a.parameters[name] = text;
            EXPECT_EQ(normalised(state).a.parameters.count(name), 0u) << method.id << " " << name;
            expectSameText(normalised(state));
        }
}

TEST(ViewState, OfALineHasTheRunsLastFrameAndItsWarmUp) {
    const std::string method = methods().front().id;
    const ViewState state = stateOfCommandLine("build/release/dustbench run --method=" + method +
                                               " -P particles=5 --out o --metrics --sync stage --images 4");
    EXPECT_EQ(state.frame, results::RunSpec().frames - 1);
    EXPECT_EQ(state.warmup, results::RunSpec().warmup);
    EXPECT_EQ(state.size, results::RunSpec().size);
    EXPECT_EQ(state.world.at("particles"), "5");
    EXPECT_EQ(runOf(state, Half::a).frames, results::RunSpec().frames);
}

TEST(ViewState, SaysWhatIsWrongWithALine) {
    const std::string run = "dustbench run --method " + methods().front().id + " ";
    const auto message = [](const std::string& line) { return inputError([&] { (void)stateOfCommandLine(line); }); };
    EXPECT_THAT(message(""), HasSubstr("expected 'dustbench run'"));
    EXPECT_THAT(message("dustbench suite x"), HasSubstr("got 'suite'"));
    EXPECT_THAT(message("dustbench run --out o"), HasSubstr("--method is required"));
    EXPECT_THAT(message(run + "--sed 5"), HasSubstr("'--seed'"));
    EXPECT_THAT(message(run + "--seed"), HasSubstr("--seed: got nothing"));
    EXPECT_THAT(message(run + "--seed -4"), HasSubstr("--seed: got '-4', allowed: integer 0 or more"));
    EXPECT_THAT(message(run + "-P particle=5"), HasSubstr("'particles'"));
    EXPECT_THAT(message(run + "-P particles=5,6"), HasSubstr("got 2 values, expected one"));
    EXPECT_THAT(message(run + "-P particles"), HasSubstr("name=value"));
    EXPECT_THAT(message(run + "-P seed=1 -P seed=1"), HasSubstr("twice"));
    EXPECT_THAT(message(run + "--camera-path 0,1"), HasSubstr("expected 8"));
    EXPECT_THAT(message(run + "'"), HasSubstr("is not closed"));
    EXPECT_THAT(message("dustbench run --method bilbord"), HasSubstr("unknown method"));
}

TEST(ViewState, SaysWhatIsWrongWithAFile) {
    const std::string a = "[a]\nmethod = \"" + methods().front().id + "\"\n";
    const auto message = [](const std::string& toml) { return inputError([&] { (void)stateOfToml(toml, "s.toml"); }); };
    EXPECT_THAT(message("scen = \"plain\"\n" + a), HasSubstr("s.toml:1: "));
    EXPECT_THAT(message("size = \"5\"\n" + a), HasSubstr("WIDTHxHEIGHT"));
    EXPECT_THAT(message(a + "[world]\nparticles = -1\n"), HasSubstr("particles"));
    EXPECT_THAT(message(a + "[a.parameters]\nnothing = 1\n"), HasSubstr("nothing"));
    EXPECT_THAT(message("[a]\nmethod = \"bilbord\"\n"), HasSubstr("unknown method"));
    EXPECT_THAT(message(""), HasSubstr("'a'"));
}

TEST(ViewState, OfTheKeyboardIsNoRun) {
    ViewState state;
    state.a.method = methods().front().id;
    state.drive = keyboardDrive;
    EXPECT_THAT(inputError([&] { (void)commandLine(state, Half::a, "o"); }), HasSubstr("save the recording"));
    EXPECT_EQ(stateOfToml(toToml(state), "s.toml"), state);
}

TEST(ViewState, TheExactPictureIsHalfBAlone) {
    ViewState state = unusual(methods().front().id);
    state.b = HalfState{exactPicture, {}};
    EXPECT_TRUE(showsExact(state));
    state = normalised(state);
    EXPECT_EQ(stateOfToml(toToml(state), "state.toml"), state) << toToml(state);
    EXPECT_THAT(inputError([&] { (void)runOf(state, Half::b); }), HasSubstr("no run draws the ground truth"));
    EXPECT_FALSE(showsExact(stateOfCommandLine(commandLine(state, Half::a, "o"))));
    ViewState wrong = state;
    wrong.b->parameters["soft"] = "on";
    EXPECT_THAT(inputError([&] { (void)normalised(wrong); }), HasSubstr("'soft', allowed: none"));
    wrong = state;
    wrong.a.method = exactPicture;
    EXPECT_THAT(inputError([&] { (void)normalised(wrong); }), HasSubstr("half A: got 'exact'"));
    const std::string toml = "[a]\nmethod = \"exact\"\n";
    EXPECT_THAT(inputError([&] { (void)stateOfToml(toml, "x.toml"); }), HasSubstr("x.toml"));
}

}  // namespace
}  // namespace dustbench::view
