// The part of a result that every machine reproduces bit for bit: the hash of the state after the last frame.
//
// Threads: any.
#pragma once

#include <string>
#include <vector>

#include "bench/results/run_spec.h"
#include "bench/results/stored_run.h"

namespace dustbench::bench {

/// Runs of one simulation, which differ only in repetition, threads, pictures or metrics.
struct ExactRun {
    std::vector<std::string> runIds;    ///< runs that are done
    std::string stateHash, methodHash;  ///< the same for all of them
    RunSpec spec;                       ///< the minimum to repeat them: no pictures, volumes or metrics
};

/// Groups the runs that are done, in the order of run ids. Throws InputError if two runs of one simulation have
/// different hashes, or if a run has no key.
[[nodiscard]] std::vector<ExactRun> exactRuns(const StoredRuns& runs);

/// `state_hash is 1, expected 2; method_hash …`; empty if both are the same.
[[nodiscard]] std::string hashDifference(const StoredRun& got, const ExactRun& expected);

}  // namespace dustbench::bench
