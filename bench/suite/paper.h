// A paper of data/papers/: what it is and which suites are its experiments.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dustbench::bench {

struct Paper {
    std::string id;
    std::string title;
    std::string authors;
    std::int64_t year = 0;  ///< 0: not known
    std::string venue;
    std::string key;  ///< in data/references.bib
    std::string summary;
    std::vector<std::string> suites;
    std::vector<std::string> experiments;  ///< statistical ones, by name
};

/// Ids of the papers in the data folder, sorted.
[[nodiscard]] std::vector<std::string> listPapers();

/// Throws InputError: an unknown id with the nearest, or what is wrong with its paper.toml.
[[nodiscard]] Paper loadPaper(const std::string& id);

}  // namespace dustbench::bench
