// Test helper: runs the system's Python, which has OpenVDB's module, on a file.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "methods/kit/testing/test_folder.h"

namespace dustbench {

/// Runs the script with the system's Python interpreter and returns its output. A non-zero exit (including a missing
/// module) is a test failure that shows the error output.
inline std::string python(const TestFolder& folder, const std::string& script, const std::filesystem::path& argument) {
    const auto file = folder.write("script.py", script);
    const auto said = folder.path() / "said", complained = folder.path() / "complained";
    const std::string command = "/usr/bin/python3 '" + file.string() + "' '" + argument.string() + "' >'" +
                                said.string() + "' 2>'" + complained.string() + "'";
    const int status = std::system(command.c_str());
    const auto content = [](const std::filesystem::path& from) {
        std::ifstream stream(from, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    EXPECT_EQ(status, 0) << content(complained);
    const std::string text = content(said);
    for (const auto& each : {file, said, complained}) std::filesystem::remove(each);
    return text;
}

}  // namespace dustbench
