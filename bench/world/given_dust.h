// Dust from a file instead of the scene's own, and the frame of the run that shows its first moment.
#pragma once

#include <cstdint>
#include <string>

namespace dustbench::world {

struct GivenDust {
    std::string file;     ///< empty: the scene's own dust
    std::string columns;  ///< DustColumns::parse
    /// Steps after the preroll that also show the first moment.
    std::int64_t warmup = 0;
    /// Number of frames from frame 0 on that the file must cover; 0: any, and the last moment stays.
    std::int64_t frames = 0;
};

}  // namespace dustbench::world
