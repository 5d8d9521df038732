#include "bench/results/stored_folder.h"

#include <fmt/format.h>

#include "bench/results/method_time.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace fs = std::filesystem;

StoredRuns readStoredRuns(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder / "runs", error))
        throw InputError(fmt::format("'{}': is no folder of results, expected a folder 'runs' in it", folder.string()));
    StoredRuns runs;
    fs::directory_iterator entry(folder / "runs", error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (name.starts_with('.')) continue;
        StoredRun run = readRunFile(entry->path() / "run.json");
        if (run.runId != name)
            throw InputError(fmt::format("'{}': holds the run '{}', expected the one that its folder is named after",
                                         (entry->path() / "run.json").string(), run.runId));
        runs.emplace(name, std::move(run));
    }
    if (error) throw InputError(fmt::format("'{}': cannot be read: {}", folder.string(), error.message()));
    addMethodTimes(runs);
    return runs;
}

}  // namespace dustbench::bench
