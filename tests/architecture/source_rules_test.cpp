// Tests of the checker: each rule reports a file that violates it and accepts one that does not.
#include "tests/architecture/source_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dustbench::architecture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Faults includesOf(const std::string& path, const std::string& target) {
    return includeFaults({path, "// Sorts.\n#include \"" + target + "\"\n"});
}

std::string unnamed(const std::string& inside, const std::string& space = "a") {
    return "namespace " + space + " {\nnamespace {\n" + inside + "\n}  // namespace\n\nint outside;\n}  // namespace " +
           space + "\n";
}

std::vector<std::string> namesIn(const std::string& inside) {
    std::vector<std::string> names;
    for (const OwnName& own : ownNames(unnamed(inside))) names.push_back(own.name);
    return names;
}

}  // namespace

TEST(SourceRules, RefuseAMethodThatIncludesAnother) {
    EXPECT_THAT(includesOf("methods/billboard/a.cpp", "methods/relief/b.h"),
                ElementsAre("methods/billboard/a.cpp:2: must not include 'methods/relief/b.h'"));
    EXPECT_THAT(includesOf("methods/billboard/a_test.cpp", "methods/relief/b.h"), SizeIs(1));
    EXPECT_THAT(includesOf("methods/billboard/parts/a.cpp", "methods/billboards/b.h"), SizeIs(1));
}

TEST(SourceRules, LetAMethodIncludeItselfAndWhatIsShared) {
    EXPECT_THAT(includesOf("methods/billboard/a.cpp", "methods/billboard/parts/b.h"), IsEmpty());
    EXPECT_THAT(includesOf("methods/billboard/a.cpp", "methods/kit/gpu/device.h"), IsEmpty());
    EXPECT_THAT(includesOf("methods/billboard/a.cpp", "billboard_shaders.h"), IsEmpty());
    EXPECT_THAT(includeFaults({"methods/billboard/a.cpp", "#include <vector>\n"}), IsEmpty());
}

TEST(SourceRules, RefuseTheHarnessInMethods) {
    EXPECT_THAT(includesOf("methods/billboard/a.cpp", "bench/world/world.h"), SizeIs(1));
    EXPECT_THAT(includesOf("methods/kit/draw/a.h", "bench/world/world.h"), SizeIs(1));
    EXPECT_THAT(includesOf("methods/kit/draw/a.h", "tests/architecture/source_rules.h"), SizeIs(1));
}

TEST(SourceRules, RefuseAMethodInWhatIsShared) {
    EXPECT_THAT(includesOf("methods/kit/draw/a.cpp", "methods/billboard/b.h"), SizeIs(1));
    EXPECT_THAT(includesOf("methods/kit/draw/a.cpp", "methods/kit/gpu/b.h"), IsEmpty());
    EXPECT_THAT(includesOf("methods/kit/draw/a.cpp", "methods/contract/b.h"), IsEmpty());
    EXPECT_THAT(includesOf("methods/contract/a.cpp", "methods/kit/gpu/b.h"), SizeIs(1));
    EXPECT_THAT(includesOf("methods/contract/a.cpp", "methods/billboard/b.h"), SizeIs(1));
    EXPECT_THAT(includesOf("methods/contract/a_test.cpp", "methods/kit/testing/b.h"), IsEmpty());
    EXPECT_THAT(includesOf("methods/contract/a.cpp", "methods/kit/testing/b.h"), SizeIs(1));
    EXPECT_THAT(includesOf("methods/contract/a_test.cpp", "methods/kit/gpu/b.h"), SizeIs(1));
}

TEST(SourceRules, LetTheHarnessKnowMethodsThroughTheRegistryAlone) {
    EXPECT_THAT(includesOf("bench/run/a.cpp", "methods/billboard/b.h"), SizeIs(1));
    EXPECT_THAT(includesOf("bench/run/a.cpp", "methods/contract/registry.h"), IsEmpty());
    EXPECT_THAT(includesOf("bench/run/a.cpp", "bench/world/world.h"), IsEmpty());
    EXPECT_THAT(includesOf("bench/world/a.cpp", "bench/run/executor.h"), SizeIs(1));
    EXPECT_THAT(includesOf("bench/results/a.cpp", "bench/suite/suite.h"), SizeIs(1));
}

TEST(SourceRules, GiveEachModuleOfTheHarnessItsNamespace) {
    const auto faults = [](const std::string& path, const std::string& space) {
        return namespaceFaults({path, "namespace " + space + " {\nint a;\n}  // namespace " + space + "\n"});
    };
    EXPECT_THAT(faults("bench/run/a.cpp", "dustbench::run"), IsEmpty());
    EXPECT_THAT(faults("bench/export/a_test.cpp", "dustbench::exports::vdb"), IsEmpty());
    EXPECT_THAT(faults("bench/view/panels/a.h", "dustbench::view"), IsEmpty());
    EXPECT_THAT(faults("bench/run/a.h", "dustbench::gpu"), IsEmpty()) << "declares a type of the kit";
    EXPECT_THAT(faults("methods/relief/a.h", "dustbench::run"), IsEmpty());
    EXPECT_THAT(faults("bench/run/a.cpp", "dustbench::suite"),
                ElementsAre("bench/run/a.cpp:1: got namespace dustbench::suite, expected dustbench::run"));
    EXPECT_THAT(faults("bench/run/a.cpp", "dustbench"), SizeIs(1));
    EXPECT_THAT(faults("bench/attic/a.cpp", "dustbench::attic"), SizeIs(1));
}

TEST(SourceRules, KeepTheContractFreeOfAllButTheStandardLibraryAndGlm) {
    const auto faults = [](const std::string& line) {
        return contractFaults({"methods/contract/a.h", "// Sorts.\n#include " + line + "\n"});
    };
    EXPECT_THAT(faults("<string_view>"), IsEmpty());
    EXPECT_THAT(faults("<glm/glm.hpp>"), IsEmpty());
    EXPECT_THAT(faults("\"methods/contract/b.h\""), IsEmpty());
    EXPECT_THAT(faults("\"methods/kit/gpu/device.h\""), SizeIs(1));
    EXPECT_THAT(faults("<fmt/format.h>"), SizeIs(1));
    EXPECT_THAT(faults("<epoxy/gl.h>"), SizeIs(1));
}

TEST(SourceRules, CountTheUsersOfAKitFolderThroughOtherFolders) {
    const auto users = kitUsers({{"methods/kit/files/a.h", ""},
                                 {"methods/kit/gpu/a.h", "#include \"methods/kit/memory/a.h\"\n"},
                                 {"methods/kit/memory/a.h", ""},
                                 {"methods/one/a.cpp", "#include \"methods/kit/gpu/a.h\"\n"},
                                 {"bench/run/a.cpp", "#include \"methods/kit/memory/a.h\"\n"},
                                 {"tests/b/a.cpp", "#include \"methods/kit/files/a.h\"\n"}});
    EXPECT_THAT(users.at("files"), IsEmpty());
    EXPECT_THAT(users.at("gpu"), ElementsAre("methods/one"));
    EXPECT_THAT(users.at("memory"), ElementsAre("bench", "methods/one"));
}

TEST(SourceRules, RefusePathsThatClimb) {
    EXPECT_THAT(includesOf("methods/billboard/a.cpp", "../relief/b.h"), SizeIs(1));
    EXPECT_THAT(includesOf("bench/run/a.cpp", "methods/kit/../relief/b.h"), SizeIs(1));
}

TEST(SourceRules, FindRawOpenGlInCode) {
    const auto faults = [](const std::string& text) { return openGlFaults({"methods/billboard/a.cpp", text}); };
    EXPECT_THAT(faults("void f() {\n    glDrawArrays (0, 0, 3);\n}\n"),
                ElementsAre(HasSubstr("methods/billboard/a.cpp:2: ")));
    EXPECT_THAT(faults("GLuint name = 0;"), SizeIs(1));
    EXPECT_THAT(faults("GLsizeiptr size = 0;"), SizeIs(1));
    EXPECT_THAT(faults("#include <epoxy/gl.h>\n"), SizeIs(1));
    EXPECT_THAT(faults("/* a */ glFinish();"), SizeIs(1));
    EXPECT_THAT(faults("f(\"// \"); glFinish();"), SizeIs(1));
    EXPECT_THAT(faults("f('\"'); glFinish(); f('\"');"), SizeIs(1));
    EXPECT_THAT(faults("f(1'000); glFinish(); f(2'000);"), SizeIs(1));
}

TEST(SourceRules, LeaveOpenGlAloneInCommentsTextsAndTheGpuLayer) {
    const auto faults = [](const std::string& text) { return openGlFaults({"bench/run/a.cpp", text}); };
    EXPECT_THAT(faults("// as glDrawArrays() would\n"), IsEmpty());
    EXPECT_THAT(faults("/* GLuint\n glFinish() */ int a;"), IsEmpty());
    EXPECT_THAT(faults("f(\"glFinish() \\\" GLuint\");"), IsEmpty());
    EXPECT_THAT(faults("f(R\"x(glFinish() \" )\" )x\");"), IsEmpty());
    EXPECT_THAT(faults("glm::vec3 globalGLuint; eglue(); angle(2);"), IsEmpty());
    EXPECT_THAT(openGlFaults({"methods/kit/gpu/a.cpp", "glFinish();"}), IsEmpty());
}

TEST(SourceRules, WantAReasonPast400Lines) {
    std::string text;
    for (int i = 0; i < 400; ++i) text += "int a;\n";
    EXPECT_THAT(lengthFaults({"bench/a.cpp", text}), IsEmpty());
    EXPECT_THAT(lengthFaults({"bench/a.cpp", text + "int b;\n"}), ElementsAre(HasSubstr("401 lines")));
    EXPECT_THAT(lengthFaults({"bench/a.cpp", "// Over 400 lines: one table, easier to read whole.\n" + text}),
                IsEmpty());
    EXPECT_THAT(lengthFaults({"bench/a.cpp", "// Over 400 lines: \n" + text}), SizeIs(1));
}

TEST(SourceRules, WantAHeaderToSayWhatItIsFor) {
    EXPECT_THAT(purposeFaults({"bench/a.h", "// Sorts by distance.\n#pragma once\n"}), IsEmpty());
    EXPECT_THAT(purposeFaults({"bench/a.h", "#pragma once\n"}), SizeIs(1));
    EXPECT_THAT(purposeFaults({"bench/a.h", ""}), SizeIs(1));
    EXPECT_THAT(purposeFaults({"bench/a.cpp", "int a;\n"}), IsEmpty());
}

TEST(SourceRules, WantEveryCitationInTheBibliography) {
    const auto keys =
        bibliographyKeys("% a comment\n@article{Wang2004,\n  title = {SSIM},\n}\n @misc { Carr:2006 , a}\n");
    EXPECT_THAT(keys, ElementsAre("Carr:2006", "Wang2004"));
    EXPECT_THAT(citationFaults({"bench/a.h", "// Source: Wang2004, Eq. 13. Departs: no mask.\n"}, keys), IsEmpty());
    EXPECT_THAT(citationFaults({"bench/a.h", "// Source: Carr:2006.\n"}, keys), IsEmpty());
    EXPECT_THAT(citationFaults({"bench/a.h", "int a;  ///< Source: Wang2005, Eq. 13.\n"}, keys),
                ElementsAre("bench/a.h:1: 'Wang2005' is not in data/references.bib"));
    EXPECT_THAT(citationFaults({"bench/a.h", "// Source: Wang2004, Eq. 13; Wang2005, ch. 2; no mask.\n"}, keys),
                SizeIs(1));
    EXPECT_THAT(citationFaults({"methods/a/a.cpp", "info.source = \"Wang2005\";\n"}, keys), SizeIs(1));
    EXPECT_THAT(citationFaults({"methods/a/a.cpp", "info.source = \"Wang2004\";\n"}, keys), IsEmpty());
    EXPECT_THAT(citationFaults({"a.cpp", "info.source = \"Wang2004, 4.2 and 4.3\";\n"}, keys), IsEmpty());
    EXPECT_THAT(citationFaults({"a.cpp", "info.source = \"Wang2004, 4.2; Wang2005, 2.1\";\n"}, keys), SizeIs(1));
}

TEST(SourceRules, MatchPatternsWithinOneFolder) {
    const auto names = quotedNames("| `scenes/*.toml` | ours |\n`references.bib`, `papers/*/paper.toml`\n");
    EXPECT_THAT(names, ElementsAre("scenes/*.toml", "references.bib", "papers/*/paper.toml"));
    EXPECT_TRUE(isNamed("scenes/flat.toml", names));
    EXPECT_TRUE(isNamed("references.bib", names));
    EXPECT_TRUE(isNamed("papers/carr2006/paper.toml", names));
    EXPECT_FALSE(isNamed("scenes/deep/flat.toml", names));
    EXPECT_FALSE(isNamed("scenes/flat.png", names));
    EXPECT_FALSE(isNamed("papers/carr2006/more/paper.toml", names));
}

// --- Names in unnamed namespaces

TEST(OwnNames, AreThoseOfTypesFunctionsAndVariables) {
    EXPECT_THAT(namesIn("struct Row {"), ElementsAre("Row"));
    EXPECT_THAT(namesIn("enum class Kind : int { one };"), ElementsAre("Kind"));
    EXPECT_THAT(namesIn("using Words = std::vector<int>;"), ElementsAre("Words"));
    EXPECT_THAT(namesIn("std::map<std::string, int> definitions(const Style& style) {"), ElementsAre("definitions"));
    EXPECT_THAT(namesIn("const Settings& checked(const Settings& s) {"), ElementsAre("checked"));
    EXPECT_THAT(namesIn("constexpr std::array<int, 2> sizes{1, 2};"), ElementsAre("sizes"));
    EXPECT_THAT(namesIn("constexpr const char* text = \"int other = 1;\";"), ElementsAre("text"));
    EXPECT_THAT(namesIn("template <typename T>\nT half(T value) {\n    return value / 2;\n}"), ElementsAre("half"));
    EXPECT_THAT(namesIn("[[nodiscard]] int a();\nint b() {\n}\nint c;"), ElementsAre("b", "c"));
}

TEST(OwnNames, AreNotThoseOfMembersTestsTextsAndOthers) {
    EXPECT_THAT(namesIn("void Row::add(int value) {"), IsEmpty());
    EXPECT_THAT(namesIn("TEST(Row, Adds) {\n    int value = 1;\n}"), IsEmpty());
    EXPECT_THAT(namesIn("using testing::IsEmpty;\nusing namespace shaders;\nnamespace fs = std::filesystem;"),
                IsEmpty());
    EXPECT_THAT(namesIn("// int comment;\nconst auto text = R\"(\nint raw = 1;\n)\";"), ElementsAre("text"));
}

TEST(OwnNames, MayNotBeThoseOfAnotherFileOfTheModule) {
    const auto faults = [](const std::string& one, const std::string& other, const std::string& space = "a") {
        return sharedNameFaults({{one, unnamed("int f() {")}, {other, unnamed("\nint f(double x) {", space)}});
    };
    EXPECT_THAT(
        faults("bench/run/one.cpp", "bench/run/two.cpp"),
        ElementsAre("bench/run/two.cpp:4: 'f' is also a name in bench/run/one.cpp, with which it may be compiled"));
    EXPECT_THAT(faults("methods/kit/a/one.cpp", "methods/kit/a/parts/force/two.cpp"), ElementsAre(HasSubstr("'f'")));
    EXPECT_THAT(faults("bench/run/one_test.cpp", "bench/run/two_test.cpp"), ElementsAre(HasSubstr("'f'")));
    EXPECT_THAT(faults("bench/run/one.cpp", "bench/run/two.cpp", "b"), IsEmpty());
    EXPECT_THAT(faults("bench/run/one.cpp", "bench/run/one_test.cpp"), IsEmpty());
    EXPECT_THAT(faults("bench/run/one.cpp", "bench/view/two.cpp"), IsEmpty());
    EXPECT_THAT(sharedNameFaults({{"bench/run/one.cpp", unnamed("int f(int x) {\nint f(double x) {")}}), IsEmpty());
}

}  // namespace dustbench::architecture
