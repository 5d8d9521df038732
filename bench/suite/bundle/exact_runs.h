// What of a result every machine repeats bit for bit: the state after the last frame, as its hash.
//
// Threads: any.
#pragma once

#include <string>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Runs that simulate the same and differ in repetition, threads, pictures or metrics alone.
struct ExactRun {
    std::vector<std::string> runIds;    ///< of those that are done
    std::string stateHash, methodHash;  ///< that they all have
    RunSpec spec;                       ///< the least that repeats them: no pictures, no volumes, no metrics
};

/// In the order of run ids, only of runs that are done. Throws InputError if two runs of one simulation have different
/// hashes, or a run does not say what was measured.
[[nodiscard]] std::vector<ExactRun> exactRuns(const StoredRuns& runs);

/// `state_hash is 1, expected 2; method_hash …`; empty if both are the same.
[[nodiscard]] std::string hashDifference(const StoredRun& got, const ExactRun& expected);

}  // namespace dustbench::bench
