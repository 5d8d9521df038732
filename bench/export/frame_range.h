// The frames of a run to export: from a first frame, in steps, up to an exclusive end.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace dustbench::bench {

/// Never empty: `first` is always included.
struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;  ///< the last frame included
    std::int64_t step = 1;

    [[nodiscard]] bool contains(std::int64_t frame) const {
        return frame >= first && frame <= last && (frame - first) % step == 0;
    }
    [[nodiscard]] std::int64_t count() const { return (last - first) / step + 1; }
    /// `A:B:STEP`; equal ranges have equal text.
    [[nodiscard]] std::string text() const;
};

/// `A:B:STEP` excluding B, `A:B` for every frame, or only `A`. Throws InputError with a message starting with `what`.
[[nodiscard]] FrameRange parseFrameRange(std::string_view what, std::string_view text);

}  // namespace dustbench::bench
