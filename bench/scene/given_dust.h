// Dust from a file in place of the scene's own, and which frame of the run is its first moment.
#pragma once

#include <cstdint>
#include <string>

namespace dustbench::bench {

struct GivenDust {
    std::string file;     ///< empty: the scene's own dust
    std::string columns;  ///< DustColumns::parse
    /// Steps after the preroll that hold the first moment as well.
    std::int64_t warmup = 0;
    /// Frames from frame 0 on that must be there; 0: any number, and the last moment holds.
    std::int64_t frames = 0;
};

}  // namespace dustbench::bench
