// Compresses a picture file for the page.
#pragma once

#include <filesystem>
#include <string>

namespace dustbench::bench {

struct SmallPicture {
    std::string mediaType;  ///< `image/png`, `image/jpeg`
    std::string bytes;
    int width = 0, height = 0;
};

/// The unchanged file, or a JPEG if that is smaller. Throws InputError if it cannot be read.
[[nodiscard]] SmallPicture makeSmall(const std::filesystem::path& png);

}  // namespace dustbench::bench
