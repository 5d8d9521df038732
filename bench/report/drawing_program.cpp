#include "bench/report/drawing_program.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "bench/run/child_process.h"
#include "methods/contract/errors.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

constexpr double longestSeconds = 120;

fs::path findProgram(const std::string& name, const std::string& package) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (fs::is_regular_file(fs::path(folder) / name)) return fs::path(folder) / name;
    throw InputError(fmt::format("drawing a file needs '{}', which is not installed; on Debian, install the package {}",
                                 name, package));
}

}  // namespace

void callDrawingProgram(std::vector<std::string> argv, const std::string& package, const fs::path& log) {
    argv.front() = findProgram(argv.front(), package).string();
    const run::ChildOutcome outcome =
        run::runChild({argv, log, longestSeconds, [](std::string_view) {}, [] { return false; }});
    if (!outcome.succeeded()) throw InputError(fmt::format("'{}' drew nothing: {}", argv.front(), outcome.reason()));
}

void convertSvg(const fs::path& svg, const std::string& format, int zoom, const fs::path& file, const fs::path& log) {
    // `--unlimited`: embedded pictures exceed libxml2's default limit for attributes.
    std::vector<std::string> convert{"rsvg-convert", "--unlimited", "--format", format};
    if (format == "png")
        convert.insert(convert.end(), {"--zoom", fmt::format("{}", zoom), "--background-color", "white"});
    convert.insert(convert.end(), {"--output", file.string(), svg.string()});
    callDrawingProgram(convert, "librsvg2-bin", log);
}

}  // namespace dustbench::report
