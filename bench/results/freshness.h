// Whether a stored result is what the same run would give today: same program, same input files.
//
// Threads: one at a time; every file is read once.
#pragma once

#include <map>
#include <string>

#include "bench/results/stored_run.h"

namespace dustbench::bench {

class Freshness {
 public:
    /// Against this program, unless told another's build id.
    explicit Freshness(std::string buildId = buildFacts().buildId) : buildId_(std::move(buildId)) {}

    /// Why the result is outdated, as the end of a sentence; empty where it is not. A run that did not end well has no
    /// result that could be.
    [[nodiscard]] std::string whyOutdated(const StoredRun& run);

 private:
    [[nodiscard]] const std::string& hashOf(const std::string& input);

    std::string buildId_;
    std::map<std::string, std::string> hashes_;  ///< by name; empty: it cannot be read
};

}  // namespace dustbench::bench
