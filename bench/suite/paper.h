// A paper in data/papers/: its description and its experiments, which are suites.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dustbench::suite {

struct Paper {
    std::string id;
    std::string title;
    std::string authors;
    std::int64_t year = 0;  ///< 0: unknown
    std::string venue;
    std::string key;  ///< in data/references.bib
    std::string summary;
    std::vector<std::string> suites;
    std::vector<std::string> experiments;  ///< statistical ones, by name
    std::vector<std::string> controls;     ///< suites that only the claims' controls need
};

/// A file of the paper's folder; empty if it does not exist. All files of a paper come from the first data folder that
/// contains `papers/<id>`.
[[nodiscard]] std::filesystem::path paperFile(const std::string& id, const std::string& name);

/// Ids of the papers in the data folders, sorted.
[[nodiscard]] std::vector<std::string> listPapers();

/// Names of all experiments of the methods (methods/contract/experiment.h).
[[nodiscard]] std::vector<std::string> experimentNames();

/// Throws InputError for an unknown id (with the nearest), or an error in its paper.toml.
[[nodiscard]] Paper loadPaper(const std::string& id);

}  // namespace dustbench::suite
