#include "methods/grid_fluid/flow/field_survey.h"

#include <algorithm>

namespace dustbench::grid_fluid::flow {

void FieldSurvey::look(const float* records, std::size_t cells) {
    Vectors maxima = maxima_, zero = zero_;  // in registers
    const auto lookAt = [&](const float* values) {
        for (std::size_t v = 0; v < vectors; ++v) {
            const auto value = load<Float16>(values + v * 16);
            maxima[v] = atLeast(maxima[v], value < 0 ? -value : value);
            zero[v] += value * 0.0f;
        }
    };
    const std::size_t floats = cells * lanes;
    std::size_t f = 0;
    for (; f + floatsAtOnce <= floats; f += floatsAtOnce) lookAt(records + f);
    if (f < floats) {
        std::array<float, floatsAtOnce> rest{};
        std::copy(records + f, records + floats, rest.begin());
        lookAt(rest.data());
    }
    maxima_ = maxima;
    zero_ = zero;
}

void FieldSurvey::add(const FieldSurvey& other) {
    for (std::size_t v = 0; v < vectors; ++v) {
        maxima_[v] = atLeast(maxima_[v], other.maxima_[v]);
        zero_[v] += other.zero_[v];
    }
}

std::array<float, lanes> FieldSurvey::maxima() const {
    std::array<float, lanes> ofLane{};
    for (std::size_t p = 0; p < floatsAtOnce; ++p)
        ofLane[p % lanes] = std::max(ofLane[p % lanes], maxima_[p / 16][p % 16]);
    return ofLane;
}

bool FieldSurvey::finite() const {
    for (std::size_t p = 0; p < floatsAtOnce; ++p)
        if (!(zero_[p / 16][p % 16] == 0)) return false;
    return true;
}

}  // namespace dustbench::grid_fluid::flow
