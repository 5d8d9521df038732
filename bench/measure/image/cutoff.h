// Cut-off: hard edges in a method's picture where dust meets the ground or a solid, and not in the reference.
//
//     cutoff = RMS of |∇[(α − α_free) − (R − R_free)]|      _free: drawn without the scene's depth
//
// over the pixels with dust (α_free or R_free > 0.01), so that empty parts of the picture do not lower the value. ∇ is
// the difference to the pixel on the right and to the one below: a hard edge is one pixel wide, and central differences
// would halve it. The last column and the last row, which lack these neighbours, are excluded.
//
// Units: alpha per pixel; range 0..2√2. Threads: pure.
#pragma once

#include "bench/measure/image/plane.h"

namespace dustbench::bench {

/// Empty if no dust is in view. The map is |∇[…]| where there is dust, else 0. Throws InputError if the sizes differ.
[[nodiscard]] Measured cutoff(const Plane& alpha, const Plane& alphaFree, const Plane& referenceAlpha,
                              const Plane& referenceAlphaFree);

}  // namespace dustbench::bench
