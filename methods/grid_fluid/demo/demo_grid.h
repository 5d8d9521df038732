// The fields of the demo on the CPU: floats rounded to half precision, x fastest, without ghost cells.
//
// Units: places in cells from the centre of the first cell.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::grid_fluid::demo {

[[nodiscard]] inline float toHalf(float value) {
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}
[[nodiscard]] inline glm::vec4 toHalf(const glm::vec4& value) {
    return {toHalf(value.x), toHalf(value.y), toHalf(value.z), toHalf(value.w)};
}

template <typename Value>
class DemoGrid {
 public:
    DemoGrid(const glm::ivec3& cells, MemoryAccount& account) : cells_(cells), values_(account) {
        values_.resize(static_cast<std::size_t>(cells.x) * static_cast<std::size_t>(cells.y) *
                       static_cast<std::size_t>(cells.z));
    }
    [[nodiscard]] std::size_t index(const glm::ivec3& c) const {
        return static_cast<std::size_t>(c.x) +
               static_cast<std::size_t>(cells_.x) *
                   (static_cast<std::size_t>(c.y) + static_cast<std::size_t>(cells_.y) * static_cast<std::size_t>(c.z));
    }
    /// The value of the nearest cell in the box.
    [[nodiscard]] const Value& at(const glm::ivec3& c) const {
        return values_[index(glm::clamp(c, glm::ivec3(0), cells_ - 1))];
    }
    void set(const glm::ivec3& c, const Value& value) { values_[index(c)] = toHalf(value); }
    void setAll(const Value& value) { std::fill(values_.begin(), values_.end(), value); }

    /// Calls `take(node, weight)` for the eight nodes around a place.
    template <typename Take>
    void around(const glm::vec3& place, const Take& take) const {
        const glm::ivec3 low(glm::floor(place));
        const glm::vec3 f = place - glm::vec3(low);
        for (int n = 0; n < 8; ++n) {
            const glm::ivec3 d(n & 1, n >> 1 & 1, n >> 2);
            const glm::vec3 w = glm::mix(1.0f - f, f, glm::vec3(d));
            take(at(low + d), w.x * w.y * w.z);
        }
    }
    [[nodiscard]] Value sampled(const glm::vec3& place) const {
        Value sum(0);
        around(place, [&](const Value& node, float weight) { sum += weight * node; });
        return sum;
    }
    void swap(DemoGrid& other) { values_.swap(other.values_); }

 private:
    glm::ivec3 cells_;
    LedgerVector<Value> values_;
};

}  // namespace dustbench::grid_fluid::demo
