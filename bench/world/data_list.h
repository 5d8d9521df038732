// Lists the scenes and drives in data/, each with a one-line description.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace dustbench::world {

struct DataEntry {
    std::string id;
    std::string description;  ///< for an unreadable file: the reason
    std::int64_t panels = 0;  ///< for a scene
};

/// Sorted by id; descriptions are keys of the scene files.
[[nodiscard]] std::vector<DataEntry> listScenes();
/// Sorted by id; the descriptions are in data/drives/drives.toml.
[[nodiscard]] std::vector<DataEntry> listDrives();

}  // namespace dustbench::world
