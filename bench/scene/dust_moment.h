// The particles of one moment of dust from a file, checked.
//
// Units: m, m/s, s. Frame: world (+Y up). Colours: linear RGB, already lit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/scene/dust_columns.h"

namespace dustbench::bench {

struct DustMoment {
    static constexpr std::uint32_t none = 0xffffffff;

    std::string file;  ///< for messages
    std::optional<double> timeSeconds;
    std::vector<std::uint64_t> id;
    std::vector<float> x, y, z, velocityX, velocityY, velocityZ, age, lifetime, radius, opacity, red, green, blue;
    bool hasIds = false, hasVelocity = false, hasAge = false, hasLifetime = false, hasColour = false;
    std::vector<std::string> unused{};  ///< unused columns of the table: `column 'density'`
    bool depthsChange = false;          ///< to the next moment, optical depth and mass change linearly, not opacity
    std::vector<std::uint32_t> next;    ///< the same particle in the next moment, or `none`

    [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// Throws InputError, one line with the file, if a quantity is missing or a number is invalid for a particle.
[[nodiscard]] DustMoment dustMoment(const volumes::PointTable& table, const DustColumns& columns,
                                    const std::string& file);

}  // namespace dustbench::bench
