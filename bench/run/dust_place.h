// Where a run's shared dust is simulated: `dust_on` of the run, applied to its world and recorded.
//
// Threads: the OpenGL thread's.
#pragma once

#include <string>

#include "bench/measure/provenance.h"
#include "bench/results/run_spec.h"
#include "bench/scene/world.h"
#include "methods/kit/gpu/device.h"

namespace dustbench::bench {

/// Throws InputError, which names what has no shader, if the run requests the GPU for dust that cannot live there.
void requireDustPlace(const RunSpec& spec, const World& world);

/// Moves the dust to the device if the run requests it; `auto`: if the device is hardware and the dust can live there.
/// Call before the first step. Returns the choice and the reason: `gpu` and `hardware device`.
DustPlace placeDust(const RunSpec& spec, World& world, gpu::Device& device);

/// The warning of a run whose method needs the dust read back; empty for other methods.
[[nodiscard]] std::string readBackWarning(const World& world, const MethodInfo& info,
                                          const ParameterValues& parameters);

}  // namespace dustbench::bench
