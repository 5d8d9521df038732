// A particle system that lives in GPU buffers: its steps as compute shaders.
//
// The same random numbers, the same order of operations and the same order of storage as ParticleSystem: a
// newborn takes the place of a dead particle, and the last survivors close the gaps. Serials, births, deaths and counts
// are equal to the CPU's; positions too where the device divides and takes roots exactly.
// The CPU computes how many are born, and from that a bound on the number of particles, which sizes the buffers; only
// the GPU knows the number itself. No step waits for the GPU.
//
// Units: SI. Frame: world. Owns: the buffers, booked on its own ledger. Threads: the OpenGL thread's.
// Source: Thesis, 3.3.2 (order of an update).
#pragma once

#include <cstdint>
#include <memory>

#include "methods/contract/memory_report.h"
#include "methods/contract/volume.h"
#include "methods/kit/gpu/device.h"
#include "methods/kit/particles/part_list.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/particles/particle_system.h"

namespace dustbench::particles {

class DUSTBENCH_API GpuSystem {
 public:
    /// `parts` must be complete, and outlive this like `device`; no other system may use them. Throws InputError with
    /// the first part that has no shader.
    GpuSystem(gpu::Device& device, const PartList& parts, std::uint64_t seed);
    ~GpuSystem();
    GpuSystem(const GpuSystem&) = delete;
    GpuSystem& operator=(const GpuSystem&) = delete;

    /// One step, as ParticleSystem::update, for one particle per puff. Throws InputError if the particles do not fit
    /// the device.
    void update(const Surroundings& surroundings);

    /// Valid until the next update.
    [[nodiscard]] GpuPuffs buffers() const;
    /// The number of particles, read back: waits for the GPU.
    [[nodiscard]] std::uint32_t count() const;
    /// The particles on the CPU, read back once per step: waits for the GPU. Valid until the next update.
    [[nodiscard]] const ParticleStore& readBack();
    [[nodiscard]] MemoryReport memory() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace dustbench::particles
