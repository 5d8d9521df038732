// The folder that `--out` names: one folder per run, which appears by one rename, and summary.csv over all of them.
//
// Owns: a lock on the folder, so that two programs never write into one. Threads: one at a time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/export/whole_file.h"
#include "bench/results/stored_run.h"

namespace dustbench::bench {

class ResultsFolder {
 public:
    /// Makes the folder, checks that it can be written, removes what killed runs left behind, and reads the runs that
    /// are there; those whose run.json is damaged are set aside. Throws InputError where it cannot be written or
    /// another program is writing into it.
    explicit ResultsFolder(std::filesystem::path folder);
    ~ResultsFolder();
    ResultsFolder(const ResultsFolder&) = delete;
    ResultsFolder& operator=(const ResultsFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
    [[nodiscard]] std::filesystem::path runFolder(const std::string& runId) const { return folder_ / "runs" / runId; }
    /// By run id.
    [[nodiscard]] const StoredRuns& runs() const { return runs_; }
    /// A sentence for each run that was set aside: why, and under which name it lies in runs/ now.
    [[nodiscard]] const std::vector<std::string>& setAside() const { return setAside_; }

    /// A new hidden folder in which the run is written until it is complete.
    [[nodiscard]] std::filesystem::path beginRun(const std::string& runId);
    /// Makes the hidden folder, with its run.json, the run's; an older result under the same id goes. Then rewrites
    /// summary.csv.
    void publish(const std::string& runId);
    /// The same without summary.csv, for whoever has many of them.
    void place(const std::string& runId);
    void discard(const std::string& runId);

    /// All runs that are there, one row each, in the order of their ids; p.… columns are the union of all parameters.
    void writeSummary() const;

 private:
    [[nodiscard]] std::filesystem::path hidden(const std::string& runId) const;
    void readRuns();
    void cleanUp();

    std::filesystem::path folder_;
    int lock_ = -1;
    StoredRuns runs_;
    std::vector<std::string> setAside_;
};

}  // namespace dustbench::bench
