// Test fixture: calls the built program as a user would.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "methods/contract/registry.h"

namespace dustbench::cli {
namespace fs = std::filesystem;

inline std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Called {
    int code = -1;
    std::string out, err;
};

class Dustbench : public testing::Test {
 protected:
    void SetUp() override {
        folder_ =
            fs::path(testing::TempDir()) /
            fmt::format("dustbench-{}-{}", testing::UnitTest::GetInstance()->current_test_info()->name(), getpid());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] Called call(const std::string& arguments) const { return callAs(DUSTBENCH_PROGRAM, arguments); }
    /// A copy of the program.
    [[nodiscard]] Called callAs(const std::string& program, const std::string& arguments) const {
        const std::string command = fmt::format("'{}' {} >'{}' 2>'{}'", program, arguments,
                                                (folder_ / "stdout").string(), (folder_ / "stderr").string());
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(folder_ / "stdout"),
                contentOf(folder_ / "stderr")};
    }
    [[nodiscard]] std::string out() const { return (folder_ / "out").string(); }
    /// A run short enough for a test, drawn by the first available method.
    [[nodiscard]] Called shortRun(const std::string& more) const {
        return call(fmt::format("run --method {} --size 96x72 --warmup 2 -P preroll=0.2 -P particles=200 {}",
                                methods().front().id, more));
    }
    [[nodiscard]] std::vector<fs::path> runs(const std::string& folder) const {
        std::vector<fs::path> list;
        for (const auto& entry : fs::directory_iterator(fs::path(folder) / "runs")) list.push_back(entry.path());
        return list;
    }

    fs::path folder_;
};

}  // namespace dustbench::cli
