// The non-empty bricks of 8×8×8 cells of a volume, while it is read or built.
//
// A brick at (x, y, z) holds the cells from 8·(x, y, z) on, z fastest, as NanoVDB's leaves do. Units: cells of a
// lattice that all moments of a series share. Owns: its values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <unordered_map>
#include <vector>

namespace dustbench::volume {

inline constexpr int brickEdge = 8;
inline constexpr int brickCells = brickEdge * brickEdge * brickEdge;

/// Bricks may lie within ± this many bricks.
inline constexpr int farthestBrick = 1 << 20;

[[nodiscard]] inline std::uint64_t keyOf(const glm::ivec3& brick) {
    const auto part = [](int at) { return static_cast<std::uint64_t>(at + farthestBrick) & 0x1fffff; };
    return part(brick.x) << 42 | part(brick.y) << 21 | part(brick.z);
}
[[nodiscard]] inline glm::ivec3 brickOf(std::uint64_t key) {
    const auto part = [key](int bits) { return static_cast<int>(key >> bits & 0x1fffff) - farthestBrick; };
    return {part(42), part(21), part(0)};
}

class Bricks {
 public:
    using Values = std::array<float, brickCells>;

    /// Null if there is no such brick.
    [[nodiscard]] const Values* find(const glm::ivec3& brick) const {
        const auto found = places_.find(keyOf(brick));
        return found == places_.end() ? nullptr : found->second.get();
    }
    /// Creates a brick of zeros if there is none.
    [[nodiscard]] Values& at(const glm::ivec3& brick) {
        std::unique_ptr<Values>& values = places_[keyOf(brick)];
        if (!values) values = std::make_unique<Values>();
        return *values;
    }
    [[nodiscard]] std::size_t count() const { return places_.size(); }
    [[nodiscard]] const std::unordered_map<std::uint64_t, std::unique_ptr<Values>>& all() const { return places_; }

 private:
    std::unordered_map<std::uint64_t, std::unique_ptr<Values>> places_;
};

}  // namespace dustbench::volume
