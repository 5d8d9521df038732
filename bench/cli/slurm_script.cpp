#include "bench/cli/slurm_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/results/shell_words.h"

namespace dustbench::cli {
namespace {

/// Overhead of starting a run, and of a shard. Generous: a task that Slurm kills loses a run, one that ends early loses
/// nothing.
constexpr double secondsAroundRun = 15, secondsAroundShard = 120;

/// Letters, digits and a few characters without a special meaning for Slurm, which interprets % in file names.
std::string plainName(const std::string& text) {
    std::string plain = text;
    std::ranges::replace_if(
        plain,
        [](char letter) {
            return !std::isalnum(static_cast<unsigned char>(letter)) && letter != '-' && letter != '_' && letter != '.';
        },
        '_');
    return plain;
}

/// `1-02:30:00`
std::string slurmTime(double seconds) {
    const auto minutes = static_cast<long long>(std::ceil(seconds / 60));
    return fmt::format("{}-{:02}:{:02}:00", minutes / (24 * 60), minutes / 60 % 24, minutes % 60);
}

}  // namespace

std::vector<std::string> withoutOptions(const std::vector<std::string>& words,
                                        const std::vector<std::string>& options) {
    std::vector<std::string> rest;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string name = words[i].substr(0, words[i].find('='));
        if (std::ranges::find(options, name) == options.end())
            rest.push_back(words[i]);
        else if (name == words[i])
            ++i;
    }
    return rest;
}

std::string slurmScript(const SlurmJob& job) {
    const double around = secondsAroundRun + job.cooldownSeconds;
    const double seconds =
        secondsAroundShard + static_cast<double>(job.maximumRunsOfShard) * (job.timeoutSeconds + around);
    std::string arguments;
    for (const std::string& word : job.arguments) arguments += " " + bench::shellQuoted(word);
    return fmt::format(
        R"script(#!/bin/bash
#SBATCH --job-name=dustbench-{name}
#SBATCH --array=1-{shards}
#SBATCH --nodes=1
#SBATCH --exclusive
#SBATCH --time={time}
#SBATCH --output=dustbench-{name}-%A_%a.log
#
# {runs} runs in {shards} shards, {most} in the largest. The time limit is what they may take at most: {timeout:g} s a run and
# {around:g} s around it (--timeout), {extra:g} s a shard.
#
#     bash THIS_FILE      submits this array, and after it a job that merges the shards into the results folder
#     sbatch THIS_FILE    submits the array alone
#
# Shards that were stopped go on when this is done again. After the merge, `dustbench suite` with the same options and
# --out prints the tables; it finds nothing to do. All nodes must see these paths:
dustbench={program}
folder={folder}
out={out}

set -euo pipefail
if [[ -n ${{SLURM_ARRAY_TASK_ID:-}} ]]; then
    cd "$folder"
    exec "$dustbench"{arguments} \
        --shard "$SLURM_ARRAY_TASK_ID/{shards}" --out "$out/shards/$SLURM_ARRAY_TASK_ID-of-{shards}"
fi

array="$(sbatch --parsable "$0")"
array="${{array%%;*}}" # a cluster's name may follow
merge=("$dustbench" merge --out "$out")
for ((shard = 1; shard <= {shards}; ++shard)); do
    merge+=("$out/shards/$shard-of-{shards}")
done
merging="$({{ echo '#!/bin/bash' && printf 'exec' && printf ' %q' "${{merge[@]}}" && echo; }} |
    sbatch --parsable --dependency="afterany:$array" --job-name=dustbench-{name}-merge --nodes=1 --ntasks=1 \
        --output=dustbench-{name}-%j-merge.log)"
echo "$array ${{merging%%;*}}"
)script",
        fmt::arg("name", plainName(job.name)), fmt::arg("shards", job.shards), fmt::arg("time", slurmTime(seconds)),
        fmt::arg("runs", job.runs), fmt::arg("most", job.maximumRunsOfShard), fmt::arg("timeout", job.timeoutSeconds),
        fmt::arg("around", around), fmt::arg("extra", secondsAroundShard),
        fmt::arg("program", bench::shellQuoted(job.program)), fmt::arg("folder", bench::shellQuoted(job.folder)),
        fmt::arg("out", bench::shellQuoted(job.out)), fmt::arg("arguments", arguments));
}

}  // namespace dustbench::cli
