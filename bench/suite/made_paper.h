// For tests: a paper of a single folder, which replaces all data.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "bench/results/temporary_folder.h"

namespace dustbench::suite {

/// The paper `mud`. Its paper.toml ends with the given keys. Sets DUSTBENCH_DATA as long as it lives.
class MadePaper {
 public:
    explicit MadePaper(const std::string& keys) {
        if (const char* before = std::getenv("DUSTBENCH_DATA")) before_ = before;
        std::filesystem::create_directories(folder_.path() / "papers/mud");
        write("paper.toml",
              "id = \"mud\"\ntitle = \"\"\nauthors = \"\"\nvenue = \"\"\nkey = \"\"\nsummary = \"\"\n" + keys);
        setenv("DUSTBENCH_DATA", folder_.path().c_str(), 1);
    }
    ~MadePaper() { before_ ? setenv("DUSTBENCH_DATA", before_->c_str(), 1) : unsetenv("DUSTBENCH_DATA"); }
    MadePaper(const MadePaper&) = delete;
    MadePaper& operator=(const MadePaper&) = delete;

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.path() / "papers/mud" / name) << text;
    }

 private:
    results::TemporaryFolder folder_;
    std::optional<std::string> before_;
};

}  // namespace dustbench::suite
