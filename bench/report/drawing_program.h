// Calls the programs that draw the report's files: node and rsvg-convert.
//
// Threads: the main thread, as runChild().
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dustbench::report {

/// `argv[0]` is the name of a program on the PATH. Its stderr is written to `log`. Throws InputError if it fails, or
/// with the name of the Debian package if it is not installed.
void callDrawingProgram(std::vector<std::string> argv, const std::string& package, const std::filesystem::path& log);

/// `format` is png or pdf; a .png has `zoom` pixels per pixel of the SVG.
void convertSvg(const std::filesystem::path& svg, const std::string& format, int zoom,
                const std::filesystem::path& file, const std::filesystem::path& log);

}  // namespace dustbench::report
