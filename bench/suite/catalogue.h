// Lists what this build and its data provide, for `dustbench list` and its JSON.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "methods/contract/parameters.h"

namespace dustbench::suite {

struct CatalogueItem {
    std::string kind;  ///< one of catalogueKinds()
    std::string id;    ///< `kind/name` for a part
    std::string title;
    std::string summary;
    std::string source;                   ///< key in data/references.bib, with the section for a part; may be empty
    std::vector<Parameter> parameters{};  ///< for a part: the keys of its table
    std::int64_t panels = 0;              ///< for a scene
    std::string origin{};                 ///< for an external method: its library; otherwise empty
};

/// `methods scenes drives suites experiments metrics parts`
[[nodiscard]] const std::vector<std::string>& catalogueKinds();

/// Sorted by id; metrics in the order of summary.csv, parts grouped by kind.
[[nodiscard]] std::vector<CatalogueItem> catalogue(const std::string& kind);

/// Throws InputError with the nearest id.
[[nodiscard]] CatalogueItem findItem(const std::string& kind, const std::vector<CatalogueItem>& items,
                                     const std::string& id);

/// Parameters of the world, the same for every method.
[[nodiscard]] const std::vector<Parameter>& worldParameterList();

/// An array of objects.
[[nodiscard]] std::string catalogueJson(const std::vector<CatalogueItem>& items);

}  // namespace dustbench::suite
