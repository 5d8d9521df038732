// A hash of plain bytes for comparing states. Not cryptographic.
//
// Threads: pure. Source: Eastlake2019 (FNV-1a, 64 bits).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace dustbench::maths {

/// FNV-1a, updated incrementally: hash ← (hash xor byte)·prime.
class Hash {
 public:
    template <typename T>
    Hash& add(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        for (const std::byte byte : std::as_bytes(values))
            value_ = (value_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3ULL;
        return *this;
    }
    template <typename T>
    requires std::is_arithmetic_v<T> Hash& add(T value) { return add(std::span<const T>(&value, 1)); }
    Hash& add(std::string_view text) { return add(std::span<const char>(text)); }

    [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace dustbench::maths
