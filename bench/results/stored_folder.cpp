#include "bench/results/stored_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/results/method_time.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace fs = std::filesystem;

StoredRun readRunFolder(const fs::path& folder) {
    StoredRun run = readRunFile(folder / "run.json");
    if (run.runId != folder.filename())
        throw InputError(fmt::format("'{}': contains the run '{}', expected the run that the folder is named after",
                                     (folder / "run.json").string(), run.runId));
    if (!run.outputs) return run;
    if (const std::string why = whyAltered(*run.outputs, folder); !why.empty())
        throw InputError(fmt::format("'{}': {}", folder.string(), why));
    return run;
}

std::string saysNothingOfOutputs(const StoredRuns& runs) {
    const auto count = std::ranges::count_if(
        runs, [](const auto& entry) { return entry.second.status == RunStatus::done && !entry.second.outputs; });
    if (count == 0) return "";
    return fmt::format(
        "{} of {} runs are from an older build that did not record the SHA-256 of their files, so changes to "
        "these files cannot be detected",
        count, runs.size());
}

StoredRuns readStoredRuns(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder / "runs", error))
        throw InputError(
            fmt::format("'{}': is not a results folder, expected it to contain a folder 'runs'", folder.string()));
    StoredRuns runs;
    fs::directory_iterator entry(folder / "runs", error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (name.starts_with('.') || entry->is_regular_file(error)) continue;  // a stray file is not a run
        runs.emplace(name, readRunFolder(entry->path()));
    }
    if (error) throw InputError(fmt::format("'{}': cannot be read: {}", folder.string(), error.message()));
    addMethodTimes(runs);
    return runs;
}

}  // namespace dustbench::bench
