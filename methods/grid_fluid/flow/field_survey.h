// The maximum magnitude of each quantity of the cells, and whether all values are finite. Internal to the kernels.
//
// A survey reads rows while they are in the cache; the surveys of several threads are merged.
#pragma once

#include <array>
#include <cstddef>

#include "methods/grid_fluid/flow/cell_field.h"
#include "methods/grid_fluid/flow/lanes.h"

namespace dustbench::grid_fluid::flow {

class FieldSurvey {
 public:
    void look(const float* records, std::size_t cells);
    void add(const FieldSurvey& other);
    /// By lane; unspecified unless `finite`.
    [[nodiscard]] std::array<float, lanes> maxima() const;
    [[nodiscard]] bool finite() const;

 private:
    /// Eight records are three vectors; place p of these 48 floats is lane p mod 6.
    static constexpr std::size_t vectors = 3, floatsAtOnce = vectors * 16;
    using Vectors = std::array<Float16, vectors>;

    Vectors maxima_{}, zero_{};  ///< `zero_` is not 0 if a number was not finite
};

}  // namespace dustbench::grid_fluid::flow
