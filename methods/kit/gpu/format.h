// Texture formats of the project, named after OpenGL's.
#pragma once

#include <cstddef>

namespace dustbench::gpu {

enum class Format { rgba8, srgba8, rgba16F, rgba32F, r8, r16F, r32F, depth32F };

/// Bytes of one texel.
[[nodiscard]] constexpr std::size_t bytesPerTexel(Format format) {
    switch (format) {
        case Format::r8:
            return 1;
        case Format::r16F:
            return 2;
        case Format::rgba8:
        case Format::srgba8:
        case Format::r32F:
        case Format::depth32F:
            return 4;
        case Format::rgba16F:
            return 8;
        case Format::rgba32F:
            return 16;
    }
    return 0;
}

}  // namespace dustbench::gpu
