// Which frames of a run are exported: from one frame on, every so many, up to one that is no longer meant.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dustbench::bench {

/// Never empty: `first` is always one of them.
struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;  ///< itself one of the frames
    std::int64_t step = 1;

    [[nodiscard]] bool contains(std::int64_t frame) const {
        return frame >= first && frame <= last && (frame - first) % step == 0;
    }
    [[nodiscard]] std::int64_t count() const { return (last - first) / step + 1; }
    /// `A:B:STEP`; ranges of the same frames have the same text.
    [[nodiscard]] std::string text() const;
};

/// `A:B:STEP` without B, `A:B` for every frame, or `A` alone. Throws InputError beginning with `what`.
[[nodiscard]] FrameRange parseFrameRange(std::string_view what, std::string_view text);

}  // namespace dustbench::bench
