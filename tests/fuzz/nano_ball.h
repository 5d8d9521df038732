// Writes a small ball of fog as a NanoVDB file, to mutate.
#pragma once

#include <filesystem>

namespace dustbench::fuzz {

void writeNanoBall(const std::filesystem::path& file);

}  // namespace dustbench::fuzz
