// Reads the moments of dust that a path names: one file of particles, a series (`.pvd`, `.series`) or a table with a
// column of times.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/scene/dust_moment.h"

namespace dustbench::bench {

struct DustFiles {
    std::vector<DustMoment> moments;           ///< in the order of the series
    std::vector<std::filesystem::path> files;  ///< all files read, the series first
    std::optional<glm::vec3> albedo{};         ///< from a volume; empty: the scene's
};

/// `.vtp`, `.vdb`, `.csv`, `.pvd`, `.series`; or several of the first three by a `*` in the file's name; or a volume,
/// from which particles are made (volume_dust.h) and which has no columns. Throws InputError, one line with the file.
[[nodiscard]] DustFiles readDustFiles(const std::filesystem::path& path, const DustColumns& columns, bool hasColumns);

/// Memory of the moments. Throws InputError if it exceeds files::limits::dustBytes.
void requireDustFits(double particles, const std::filesystem::path& path);

}  // namespace dustbench::bench
