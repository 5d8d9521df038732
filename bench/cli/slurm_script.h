// Generates a Slurm array job for a suite: one task per shard, followed by a job that merges the results.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dustbench::cli {

struct SlurmJob {
    std::string name;                    ///< of the suite
    std::string program, folder, out;    ///< absolute; `folder` is the working directory of the command
    std::vector<std::string> arguments;  ///< of `dustbench`, without --out, --slurm and --shard
    int shards = 1;
    std::size_t runs = 0, maximumRunsOfShard = 0;
    double timeoutSeconds = 0;   ///< of one run
    double cooldownSeconds = 0;  ///< between two runs
};

/// A bash script. `sbatch` accepts it as an array job; run directly, it submits itself and the merge job.
[[nodiscard]] std::string slurmScript(const SlurmJob& job);

/// The arguments of a `dustbench` command without some options and their values.
[[nodiscard]] std::vector<std::string> withoutOptions(const std::vector<std::string>& words,
                                                      const std::vector<std::string>& options);

}  // namespace dustbench::cli
