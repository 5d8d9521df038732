// Measures what more arithmetic costs a device, and what more bytes (claim R27).
//
// A kernel reads 16 bytes a thread, computes with them and writes 16 bytes, over arrays that no cache holds. Its time
// is compared with that of twice the arithmetic on the same bytes, and of the same arithmetic with twice the bytes. The
// arithmetic is that of a look-up of four values between eight cells, 4 × 7 × 2 multiplications with additions, which
// MacCormack makes twice where semi-Lagrangian makes it once.
//
// Threads: that of the device. Source: Senger2009, 4.1.2.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::bandwidth {

/// The experiment `bandwidth`, by OpenGL. Medians over rounds:
///     arithmetic    time with twice the arithmetic / with twice the bytes
///     arithmetic_alone, bytes_alone   each over the time without either
///     control_compute   as `arithmetic`, where a thread computes so long that its bytes do not count
///     control_copy      as `arithmetic`, where a thread makes one operation
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::bandwidth
