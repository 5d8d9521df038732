// Opacity from age alone: young particles are moderately translucent, dying ones transparent.
//
//     α = α₀·(1 − age/lifetime)
//
// Units: seconds. Owns: a column of opacities, booked on a ledger. Threads: one.
// Source: Carr2006, 3.2. Departs: the linear decrease and α₀ are ours, because the paper gives no numbers.
#pragma once

#include <algorithm>
#include <span>

#include "methods/contract/choices.h"
#include "methods/contract/parameters.h"
#include "methods/contract/volume.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::draw {

/// What sets a puff's opacity.
enum class OpacityFrom {
    dust,  ///< the shared dust's own opacity and size
    age,   ///< age alone
};
inline constexpr Choices<OpacityFrom> opacityOrigins{{"dust", OpacityFrom::dust}, {"age", OpacityFrom::age}};

[[nodiscard]] inline float opacityByAge(float ageSeconds, float lifetimeSeconds, float young) {
    return young * std::clamp(1 - ageSeconds / lifetimeSeconds, 0.0f, 1.0f);
}

/// Declares `opacity` and `young_opacity`.
DUSTBENCH_API void declareOpacity(ParameterSet& parameters);

/// The opacities of one frame's particles by age alone.
class DUSTBENCH_API AgeOpacity {
 public:
    /// `young`: α₀, 0..0.999.
    AgeOpacity(MemoryAccount& account, double young) : column_(account), young_(static_cast<float>(young)) {}

    /// One opacity for each particle; valid until the next call.
    std::span<const float> of(const Puffs& dust);
    /// What the last call of `of` returned.
    [[nodiscard]] std::span<const float> column() const { return column_; }

 private:
    LedgerVector<float> column_;
    float young_;
};

}  // namespace dustbench::draw
