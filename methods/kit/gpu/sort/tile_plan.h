// The number of elements that a primitive works on, known to the CPU or only to the GPU, and its work groups.
//
// Owns: a buffer with the number and with arguments for indirect dispatches. Threads: the OpenGL thread's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "methods/kit/gpu/buffer.h"
#include "methods/kit/gpu/program.h"

namespace dustbench::gpu {

/// A number, or a word of a buffer that holds it when the commands run. Of a larger number than fits the primitive,
/// only that many elements are used.
struct ElementCount {
    ElementCount(std::uint32_t elements) : number(elements) {}
    ElementCount(const Buffer& elements, std::size_t wordOfBuffer = 0) : buffer(&elements), word(wordOfBuffer) {}

    std::uint32_t number = 0;
    const Buffer* buffer = nullptr;
    std::size_t word = 0;
};

class DUSTBENCH_API TilePlan {
 public:
    /// Throws InputError if `capacity` elements need more work groups than OpenGL guarantees.
    TilePlan(Device& device, std::uint32_t capacity, std::uint32_t tileElements);

    /// Throws std::out_of_range if a number that the CPU knows exceeds the capacity.
    void set(const ElementCount& count);
    /// The shaders' buffer Plan.
    void bind() const { plan_.bindStorage(0); }
    /// Runs a work group for each tile.
    void runPerTile(const Program& program) const;
    /// Runs at most `maximumShares` work groups, for programs that loop over tiles.
    void runPerShare(const Program& program) const;

    [[nodiscard]] std::uint32_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint32_t tilesOf(std::uint32_t elements) const {
        return elements / tileElements_ + (elements % tileElements_ != 0 ? 1 : 0);
    }
    [[nodiscard]] std::uint32_t maximumTiles() const { return tilesOf(capacity_); }
    [[nodiscard]] std::size_t bytes() const { return plan_.bytes(); }

    static constexpr std::uint32_t maximumShares = 1024;

 private:
    Device* device_;
    std::uint32_t capacity_, tileElements_;
    Buffer plan_;
    std::optional<Program> fromBuffer_;
    std::optional<std::uint32_t> tiles_;  ///< if the CPU knows the number of elements
    std::optional<std::uint32_t> elements_;
};

}  // namespace dustbench::gpu
