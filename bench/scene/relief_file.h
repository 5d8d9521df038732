// Reads a relief from TOML: its heights and colours as pictures. `data/reliefs/bricks.toml` documents the keys.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "methods/contract/scene.h"

namespace dustbench::bench {

struct ReliefFile {
    std::string description;
    std::shared_ptr<const scene::Relief> relief;
    std::vector<std::filesystem::path> files;  ///< this file and the pictures that it names
};

/// Throws InputError with the file and what was expected.
[[nodiscard]] ReliefFile readRelief(const std::filesystem::path& file);

}  // namespace dustbench::bench
