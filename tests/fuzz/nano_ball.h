// A small ball of fog in a file of NanoVDB, to mutate.
#pragma once

#include <filesystem>

namespace dustbench::fuzz {

void writeNanoBall(const std::filesystem::path& file);

}  // namespace dustbench::fuzz
