// From which alpha on a pixel counts as dust, for all metrics that leave empty picture out.
#pragma once

namespace dustbench::bench {

/// Alphas above it are dust: two and a half steps of an 8-bit picture over black.
inline constexpr float dustAlpha = 0.01f;

}  // namespace dustbench::bench
