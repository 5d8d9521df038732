// A paper in data/papers/: its description and the suites that are its experiments.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dustbench::bench {

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

/// A file of the paper's folder; empty where it has none. Papers do not mix: all files of one come from the first
/// folder of data that has `papers/<id>`.
[[nodiscard]] std::filesystem::path paperFile(const std::string& id, const std::string& name);

/// Ids of the papers in the folders of data, sorted.
[[nodiscard]] std::vector<std::string> listPapers();

/// Throws InputError for an unknown id (with the nearest), or an error in its paper.toml.
[[nodiscard]] Paper loadPaper(const std::string& id);

}  // namespace dustbench::bench
