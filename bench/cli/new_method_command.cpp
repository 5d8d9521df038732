// `dustbench new-method`: creates the project of a method that is built outside this tree.
#include <fmt/format.h>

#include <array>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <regex>

#include "bench/cli/commands.h"
#include "bench/export/whole_file.h"
#include "bench/results/shell_words.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::cli {
namespace fs = std::filesystem;
namespace {

/// A file of data/templates/method, and its name in the project.
struct TemplateFile {
    const char* from;
    const char* to;
};
constexpr std::array<TemplateFile, 3> templateFiles{
    {{"CMakeLists.txt", "CMakeLists.txt"}, {"method.cpp", "@ID@.cpp"}, {"method_test.cpp", "@ID@_test.cpp"}}};

/// `soft_dust` becomes the class `SoftDust`, and below the title `Soft dust`.
std::string className(const std::string& id) {
    std::string name;
    bool isStart = true;
    for (const char c : id) {
        if (c != '_') name += isStart ? static_cast<char>(std::toupper(c)) : c;
        isStart = c == '_';
    }
    return name;
}
std::string title(const std::string& id) {
    std::string text = id;
    std::ranges::replace(text, '_', ' ');
    text.front() = static_cast<char>(std::toupper(text.front()));
    return text;
}

std::string filledIn(std::string text, const std::string& id) {
    for (const auto& [mark, value] :
         {std::pair<std::string, std::string>{"@ID@", id}, {"@CLASS@", className(id)}, {"@TITLE@", title(id)}})
        for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size())
            text.replace(at, mark.size(), value);
    return text;
}

void requireNew(const std::string& id) {
    static const std::regex allowed("[a-z][a-z0-9_]*");
    if (!std::regex_match(id, allowed))
        throw InputError(fmt::format("method '{}': allowed: lower-case letters, digits and '_', a letter first", id));
    if (id.ends_with("_test") || id.ends_with("_bench"))
        throw InputError(
            fmt::format("method '{}': this ending is reserved for tests and benchmarks; choose another name", id));
    if (std::ranges::find(methods(), id, &MethodInfo::id) != methods().end())
        throw InputError(fmt::format("method '{}' already exists, see `dustbench list methods {}`", id, id));
    if (fs::exists(fs::symlink_status(id)))
        throw InputError(fmt::format("folder '{}' already exists; choose a new name", id));
}

/// The option by which CMake finds this installation: ` -DCMAKE_PREFIX_PATH=/opt/dustbench`; empty for the prefixes
/// that CMake searches by default.
std::string prefixOption() {
    const fs::path prefix = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
    if (!fs::exists(prefix / "lib/cmake/dustbench/dustbenchConfig.cmake"))
        return " -DCMAKE_PREFIX_PATH=WHERE_DUSTBENCH_IS_INSTALLED";
    if (prefix == "/usr" || prefix == "/usr/local") return "";
    return " -DCMAKE_PREFIX_PATH=" + results::shellQuoted(prefix.string());
}

int newMethod(const std::string& id) {
    requireNew(id);
    fs::create_directory(id);
    for (const TemplateFile& file : templateFiles) {
        const fs::path from = files::dataPath(fs::path("templates/method") / file.from);
        if (from.empty()) throw InputError(fmt::format("data: the file templates/method/{} is missing", file.from));
        exports::writeWhole(fs::path(id) / filledIn(file.to, id), filledIn(files::wholeText(from, "template"), id));
    }
    std::cout << fmt::format(
        "Created the project {0}/. Build and test it, then run the method with dustbench:\n"
        "    cmake -S {0} -B {0}/build{1} && cmake --build {0}/build && ctest --test-dir {0}/build\n"
        "    dustbench run --method-path {0}/build --method {0} --out out/{0}\n",
        id, prefixOption());
    return exitOk;
}

}  // namespace

Command newMethodCommand() {
    auto id = std::make_shared<std::string>();
    return {"new-method", "Create the project of a new method, which draws dots, with its test",
            "Creates the folder ID in the working directory.",
            [id](Arguments& arguments) {
                arguments.required("id", "", "id of the method: lower-case letters, digits and '_'", *id);
            },
            [id] { return newMethod(*id); }};
}

}  // namespace dustbench::cli
