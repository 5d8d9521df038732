// The rule on names in unnamed namespaces, applied to small files.
#include "tests/architecture/own_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dustbench::architecture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string unnamed(const std::string& inside, const std::string& space = "a") {
    return "namespace " + space + " {\nnamespace {\n" + inside + "\n}  // namespace\n\nint outside;\n}  // namespace " +
           space + "\n";
}

std::vector<std::string> namesIn(const std::string& inside) {
    std::vector<std::string> names;
    for (const OwnName& own : ownNames(unnamed(inside))) names.push_back(own.name);
    return names;
}

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

}  // namespace
}  // namespace dustbench::architecture
