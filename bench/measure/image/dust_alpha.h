// The alpha above which a pixel counts as dust, for all metrics that exclude empty parts of the picture.
#pragma once

namespace dustbench::bench {

/// Two and a half steps of an 8-bit picture over black.
inline constexpr float dustAlpha = 0.01f;

}  // namespace dustbench::bench
