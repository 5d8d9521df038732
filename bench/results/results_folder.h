// The folder given by `--out`: one folder per run, which appears by one rename, and summary.csv over all runs.
//
// Owns: a lock on the folder, so that two programs never write to the same one. Threads: one at a time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/export/whole_file.h"
#include "bench/results/stored_run.h"

namespace dustbench::results {

class ResultsFolder {
 public:
    /// Creates the folder, checks that it is writable, removes leftovers of interrupted runs, and reads the existing
    /// runs; runs with a damaged run.json or an altered output are set aside. Throws InputError if it is not writable
    /// or another program is writing to it.
    explicit ResultsFolder(std::filesystem::path folder);
    /// Removes the folder if this object created it and nothing was written into it.
    ~ResultsFolder();
    ResultsFolder(const ResultsFolder&) = delete;
    ResultsFolder& operator=(const ResultsFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
    [[nodiscard]] std::filesystem::path runFolder(const std::string& runId) const { return folder_ / "runs" / runId; }
    /// By run id.
    [[nodiscard]] const StoredRuns& runs() const { return runs_; }
    /// One sentence for each run that was set aside: the reason, and its new name in runs/.
    [[nodiscard]] const std::vector<std::string>& setAside() const { return setAside_; }

    /// Creates a hidden folder in which the run is written until it is complete.
    [[nodiscard]] std::filesystem::path beginRun(const std::string& runId);
    /// Publishes the hidden folder, with its run.json, as the run's result, replacing an older result with the same id.
    /// Then rewrites summary.csv.
    void publish(const std::string& runId);
    /// The same without rewriting summary.csv, for publishing many runs.
    void place(const std::string& runId);
    void discard(const std::string& runId);

    /// Writes summaryCsv of all runs with their method times (compared_runs.h).
    void writeSummary();

 private:
    [[nodiscard]] std::filesystem::path hidden(const std::string& runId) const;
    void readRuns();
    void cleanUp();

    std::filesystem::path folder_;
    int lock_ = -1;
    bool isNew_ = false;
    StoredRuns runs_;
    std::vector<std::string> setAside_;
};

/// The hidden folder of the reference images that the runs of a ResultsFolder share, from the folder that `beginRun`
/// returned. It is removed with the ResultsFolder.
[[nodiscard]] std::filesystem::path referencesBeside(const std::filesystem::path& runFolder);

/// summary.csv as text: the runs one row each, ordered by id; p.… columns are the union of all parameters.
[[nodiscard]] std::string summaryCsv(const StoredRuns& runs);

}  // namespace dustbench::results
