// The scenes and drives that data/ offers, each with one line that says what it is.
#pragma once

#include <string>
#include <vector>

namespace dustbench::bench {

struct DataEntry {
    std::string id;
    std::string description;  ///< of a file that cannot be read: why
};

/// Sorted by id; the description is the scene's own key.
[[nodiscard]] std::vector<DataEntry> listScenes();
/// Sorted by id; the descriptions stand in data/drives/drives.toml.
[[nodiscard]] std::vector<DataEntry> listDrives();

}  // namespace dustbench::bench
