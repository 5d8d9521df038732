// Checks that the pixels drawn by a stage are finite.
#pragma once

#include <cstdint>
#include <string_view>

#include "methods/contract/stage_clock.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// Throws SimulationError with the number of non-finite pixels and the first of them, from the top left:
/// `frame 119: the method's layer is not finite in 3 pixels, first in (12, 40): red is nan (stage draw)`.
void requireFinite(const pictures::Image& picture, std::int64_t frame, Stage stage, std::string_view what);

}  // namespace dustbench::bench
