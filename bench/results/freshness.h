// Checks whether a stored result is outdated: whether the same run would now use another program or other input files.
//
// Threads: one at a time; every file is read once.
#pragma once

#include <map>
#include <string>

#include "bench/results/stored_run.h"

namespace dustbench::results {

class Freshness {
 public:
    /// Compares with this program, unless a build id is given.
    explicit Freshness(std::string buildId = measure::buildFacts().buildId) : buildId_(std::move(buildId)) {}

    /// Why the result is outdated, as the end of a sentence; empty if it is not. Runs that did not complete are never
    /// outdated.
    [[nodiscard]] std::string whyOutdated(const StoredRun& run);

 private:
    [[nodiscard]] const std::string& hashOf(const std::string& input);

    std::string buildId_;
    std::map<std::string, std::string> hashes_;  ///< by file name; empty: unreadable
    std::map<std::string, std::string> names_;   ///< hashes of the names found by searches, by path
};

}  // namespace dustbench::results
