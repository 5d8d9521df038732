// The particles of one moment of dust from another program's file, checked: a mapping of its columns to positions,
// radius, opacity …, and the numbers themselves.
//
// Units: m, m/s, s, after scaling. Frame: world (+Y up). Colours: linear RGB, already lit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/volumes/point_table.h"

namespace dustbench::world {

/// The numbers of one quantity: a column for each component, or one number for all.
struct ColumnNumbers {
    struct Part {
        const std::vector<double>* values = nullptr;  ///< null: `constant`
        std::size_t stride = 1, first = 0;
        double constant = 0;
        bool isByte = false;  ///< as in PointColumn
    };
    std::string name;  ///< for messages
    std::vector<Part> parts;

    [[nodiscard]] double at(std::size_t point, std::size_t part = 0) const {
        const Part& p = parts[part];
        return p.values ? (*p.values)[point * p.stride + p.first] : p.constant;
    }
};

/// A setting is `key=NAME` for a column, `key=A+B+C` for the three columns of a vector, or `key=0.5` for one number for
/// all particles. Without a setting, the usual names are tried (reports/guide/own-data.md lists them).
class DustColumns {
 public:
    /// `position=Points,radius=R`, or a `.toml` file with the same keys; empty: the usual names. Throws InputError.
    static DustColumns parse(const std::string& textOrFile);

    [[nodiscard]] bool wants(std::string_view column) const;
    /// Empty if the table does not contain the quantity. Throws InputError, with `file`, if a named column is missing
    /// or has another number of components.
    [[nodiscard]] std::optional<ColumnNumbers> find(const volumes::PointTable& table, std::string_view key,
                                                    const std::string& file) const;
    /// True if +Z is up in the file.
    [[nodiscard]] bool zUp() const { return zUp_; }
    /// Metres per unit of length of the file.
    [[nodiscard]] double metresPerUnit() const { return metresPerUnit_; }

 private:
    void set(const std::string& key, const std::string& value);

    std::map<std::string, std::string, std::less<>> given_;
    bool zUp_ = false;
    double metresPerUnit_ = 1;
};

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

}  // namespace dustbench::world
