// Columns for a few newborns, on the stack of the initialising thread.
//
// Units: m, s. Owns: its columns. Threads: one block, one thread.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "methods/kit/particles/emission_part.h"
#include "methods/kit/particles/newborns.h"

namespace dustbench::particles {

class NewbornBlock {
 public:
    static constexpr std::size_t size = 128;

    NewbornBlock() {}  // NOLINT: deliberately uninitialised; the parts write every column

    /// Births `first`..`first + count` of a step, numbered from `serial` on, with moment and age set.
    [[nodiscard]] Newborns newborns(std::size_t first, std::size_t count, std::uint64_t serial, const Births& births,
                                    std::span<const Emitter> emitters, double stepSeconds);

 private:
    std::array<std::uint64_t, size> serial_;
    std::array<float, size> moment_;
    std::array<const Emitter*, size> emitter_;
    alignas(64) std::array<std::array<float, size>, 13> columns_;
};

}  // namespace dustbench::particles
