// Facts that methods of transparency share: what their intermediate targets hold, and what fragments move there.
#pragma once

#include "methods/contract/facts.h"

namespace dustbench::draw {

[[nodiscard]] inline FactInfo bitsPerPixel() {
    return {"bits_per_pixel", "bit", FactOver::lastFrame,
            "storage of the intermediate targets per pixel of the picture; of lists, the part in use"};
}

/// By the formats and passes, not measured. A read-modify-write counts twice; what stays in an invocation does not
/// count.
[[nodiscard]] inline FactInfo bytesPerFragment() {
    return {"bytes_per_fragment", "byte", FactOver::lastFrame,
            "bytes that a fragment reads from and writes to the targets of all passes, by their formats; caches save a "
            "part of them. Times the fragments per pixel: bandwidth per pixel"};
}

}  // namespace dustbench::draw
