// Measures the cost of more arithmetic and of more memory traffic on a device (claim R27).
//
// A kernel reads 16 bytes per thread, computes with them and writes 16 bytes, over arrays larger than any cache. Its
// time is compared with that of twice the arithmetic on the same bytes, and of the same arithmetic with twice the
// bytes. The arithmetic is an interpolation of four values between eight cells, 4 × 7 × 2 multiply-adds. MacCormack
// performs it twice, semi-Lagrangian advection once.
//
// Threads: that of the device. Source: Senger2009, 4.1.2.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::bandwidth {

/// The experiment `bandwidth`, by OpenGL. Medians over rounds:
///     arithmetic    time with twice the arithmetic / with twice the bytes
///     arithmetic_alone, bytes_alone   each divided by the time without either
///     control_compute   as `arithmetic`, with so much arithmetic per thread that its bytes do not matter
///     control_copy      as `arithmetic`, with one operation per thread
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::bandwidth
