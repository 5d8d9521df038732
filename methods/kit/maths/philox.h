// Random numbers as a pure function of (seed, stream, serial, draw): stateless, so that any thread may compute any
// number.
// Philox4x32-10. Key: the seed's two halves. Counter: the serial's two halves, the stream and the draw. Two draws share
// a counter only if all three agree.
// Threads: pure. Source: Salmon2011, sections 3.3 and 5 (implementation: Random123).
#pragma once

#include <Random123/philox.h>
#include <array>
#include <cstdint>

namespace dustbench::maths {

/// Four random words of one counter.
[[nodiscard]] inline std::array<std::uint32_t, 4> randomWords(std::uint64_t seed, std::uint32_t stream,
                                                              std::uint64_t serial, std::uint32_t draw = 0) {
    const r123::Philox4x32::ctr_type counter{
        {static_cast<std::uint32_t>(serial), static_cast<std::uint32_t>(serial >> 32), stream, draw}};
    const r123::Philox4x32::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
    const auto words = r123::Philox4x32{}(counter, key);
    return {words[0], words[1], words[2], words[3]};
}

/// The upper 24 bits as a number in [0, 1): every value is exact as a float, and 1 is excluded.
[[nodiscard]] constexpr float unitFloat(std::uint32_t word) {
    return static_cast<float>(word >> 8) * 0x1p-24f;
}

/// Four independent uniform numbers in [0, 1).
[[nodiscard]] inline std::array<float, 4> uniform4(std::uint64_t seed, std::uint32_t stream, std::uint64_t serial,
                                                   std::uint32_t draw = 0) {
    const auto words = randomWords(seed, stream, serial, draw);
    return {unitFloat(words[0]), unitFloat(words[1]), unitFloat(words[2]), unitFloat(words[3])};
}

/// The thesis's Random(): [0, 1) to [−1, 1).
[[nodiscard]] constexpr float centred(float uniform) {
    return 2.0f * uniform - 1.0f;
}

}  // namespace dustbench::maths
