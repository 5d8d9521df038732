// For tests: an empty folder that is removed with its object, and the problems of a report as one text.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "bench/report/report_data.h"

namespace dustbench::report {

class Folder {
 public:
    Folder() : path_(std::filesystem::path(testing::TempDir()) / fmt::format("report-{}-{}", getpid(), ++made)) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name) << text;
    }

 private:
    inline static int made = 0;
    std::filesystem::path path_;
};

inline std::string problemsOf(const ReportData& data) {
    return fmt::format("{}", fmt::join(data.problems, "\n"));
}

}  // namespace dustbench::report
