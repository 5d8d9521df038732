#include "bench/scene/dust_moment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/maths/srgb.h"

namespace dustbench::bench {
namespace {

constexpr double maximumPlace = 1e6, maximumSpeed = 1e5, maximumRadius = 1e4, maximumAge = 1e6, maximumColour = 1e4;
constexpr double maximumId = 9007199254740992.0;  // 2^53: beyond it, double skips whole numbers
/// Maximum for all particles: full opacity would be an infinite depth.
constexpr double maximumOpacity = 0.999;
constexpr double smallest = std::numeric_limits<float>::min();

/// Reads the quantities of the particles.
class Reader {
 public:
    Reader(const volumes::PointTable& table, const DustColumns& columns, const std::string& file)
        : table_(table), columns_(columns), file_(file) {}

    [[nodiscard]] std::optional<ColumnNumbers> find(std::string_view key) {
        auto found = columns_.find(table_, key, file_);
        if (found)
            for (const ColumnNumbers::Part& part : found->parts) used_[part.values] += 1;
        return found;
    }

    /// The unused columns of the table, and the numbers of a colour after the third.
    [[nodiscard]] std::vector<std::string> unused() const {
        std::vector<std::string> parts;
        const bool hasPlaces = table_.find(volumes::pointsColumn) != nullptr;
        for (const volumes::PointColumn& column : table_.columns) {
            if (hasPlaces && column.name == "P") continue;  // OpenVDB's positions within a cell: part of Points
            const auto found = used_.find(&column.values);
            if (found == used_.end())
                parts.push_back(files::namedPart("column", column.name));
            else if (column.components == 4 && found->second == 3)
                parts.push_back(files::namedPart("fourth number of", column.name));
        }
        parts.insert(parts.end(), table_.ignored.begin(), table_.ignored.end());
        return parts;
    }

    [[nodiscard]] double checked(const ColumnNumbers& numbers, std::size_t point, std::size_t part, double minimum,
                                 double maximum) const {
        const double value = numbers.at(point, part);
        if (!(value >= minimum && value <= maximum))  // true for NaN
            throw InputError(fmt::format("{}: particle {}: {} is {}, allowed: {}..{}", file_, point, numbers.name,
                                         value, minimum, maximum));
        return value;
    }

    void read(const ColumnNumbers& numbers, std::size_t part, double minimum, double maximum, double factor,
              std::vector<float>& to) const {
        to.resize(table_.points);
        for (std::size_t i = 0; i < table_.points; ++i)
            to[i] = static_cast<float>(checked(numbers, i, part, minimum, maximum) * factor);
    }

    /// A vector's components; from a file with +Z up (x, y, z) becomes (x, z, −y).
    void readVector(const ColumnNumbers& numbers, double limit, double factor, std::vector<float>& x,
                    std::vector<float>& y, std::vector<float>& z) const {
        const bool turned = columns_.zUp();
        read(numbers, 0, -limit, limit, factor, x);
        read(numbers, turned ? 2 : 1, -limit, limit, factor, y);
        read(numbers, turned ? 1 : 2, -limit, limit, turned ? -factor : factor, z);
    }

    [[noreturn]] void failMissing(std::string_view what, std::string_view hint) const {
        std::string has;
        for (const volumes::PointColumn& column : table_.columns) has += (has.empty() ? "" : ", ") + column.name;
        throw InputError(fmt::format("{}: no column for {}; it has: {} (--dust-columns {})", file_, what, has, hint));
    }

 private:
    const volumes::PointTable& table_;
    const DustColumns& columns_;
    const std::string& file_;
    std::map<const std::vector<double>*, int> used_;  ///< numbers per particle that are used, by column
};

void readIds(const ColumnNumbers& numbers, const Reader& reader, DustMoment& moment) {
    moment.hasIds = true;
    for (std::size_t i = 0; i < moment.size(); ++i) {
        const double id = reader.checked(numbers, i, 0, 0, maximumId);
        if (id != std::floor(id))
            throw InputError(
                fmt::format("{}: particle {}: {} is {}, allowed: whole numbers", moment.file, i, numbers.name, id));
        moment.id[i] = static_cast<std::uint64_t>(id);
    }
    std::vector<std::uint64_t> sorted = moment.id;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
        throw InputError(fmt::format("{}: {}: {} appears twice, expected a different id for each particle", moment.file,
                                     numbers.name, *twice));
}

/// Depth τ of a puff of mass m: m / (2π s²), s = r/2; α = 1 − exp(−τ).
void opacityFromMass(const ColumnNumbers& mass, const Reader& reader, DustMoment& moment) {
    moment.opacity.resize(moment.size());
    for (std::size_t i = 0; i < moment.size(); ++i) {
        const double s = static_cast<double>(moment.radius[i]) / 2;
        const double tau = reader.checked(mass, i, 0, 0, 1e12) / (2 * std::numbers::pi * s * s);
        moment.opacity[i] = static_cast<float>(std::min(-std::expm1(-tau), maximumOpacity));
    }
}

/// Bytes are encoded as sRGB, other numbers are linear light, which may exceed 1.
void readDustColours(const ColumnNumbers& colour, const Reader& reader, DustMoment& moment) {
    moment.hasColour = true;
    std::vector<float>* const channels[]{&moment.red, &moment.green, &moment.blue};
    bool areWhole = true;
    float maximum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        reader.read(colour, i, 0, maximumColour, 1, *channels[i]);
        for (float& each : *channels[i])
            if (colour.parts[i].isByte) {
                each = maths::decodeSrgb(each / 255);
            } else {
                areWhole = areWhole && each == std::floor(each);
                maximum = std::max(maximum, each);
            }
    }
    if (areWhole && maximum > 1)
        throw InputError(
            fmt::format("{}: {} has whole numbers up to {}, expected linear light, where white is 1 "
                        "(only UInt8 arrays of a .vtp may have colours 0..255)",
                        moment.file, colour.name, maximum));
}

}  // namespace

DustMoment dustMoment(const volumes::PointTable& table, const DustColumns& columns, const std::string& file) {
    Reader reader(table, columns, file);
    const double scale = columns.metresPerUnit();
    DustMoment moment;
    moment.file = file;
    moment.timeSeconds = table.timeSeconds;
    moment.id.resize(table.points);
    for (std::size_t i = 0; i < table.points; ++i) moment.id[i] = i;

    const auto position = reader.find("position");
    if (!position) reader.failMissing("position", "position=NAME or position=A+B+C");
    reader.readVector(*position, maximumPlace / scale, scale, moment.x, moment.y, moment.z);
    const auto radius = reader.find("radius");
    if (!radius) reader.failMissing("radius", "radius=NAME, or radius=0.5 for all");
    reader.read(*radius, 0, smallest / std::min(scale, 1.0), maximumRadius / scale, scale, moment.radius);
    if (const auto opacity = reader.find("opacity")) {
        reader.read(*opacity, 0, 0, 1, 1, moment.opacity);
        for (float& each : moment.opacity) each = std::min(each, static_cast<float>(maximumOpacity));
    } else if (const auto mass = reader.find("mass")) {
        opacityFromMass(*mass, reader, moment);
    } else {
        reader.failMissing("opacity or mass", "opacity=NAME, mass=NAME, or opacity=0.1 for all");
    }
    if (const auto ids = reader.find("id")) readIds(*ids, reader, moment);

    if (const auto velocity = reader.find("velocity")) {
        moment.hasVelocity = true;
        reader.readVector(*velocity, maximumSpeed / scale, scale, moment.velocityX, moment.velocityY, moment.velocityZ);
    }
    if (const auto age = reader.find("age")) {
        moment.hasAge = true;
        reader.read(*age, 0, 0, maximumAge, 1, moment.age);
    }
    if (const auto lifetime = reader.find("lifetime")) {
        moment.hasLifetime = true;
        reader.read(*lifetime, 0, smallest, maximumAge, 1, moment.lifetime);
    }
    if (const auto colour = reader.find("colour")) {
        readDustColours(*colour, reader, moment);
    }
    moment.unused = reader.unused();
    return moment;
}

}  // namespace dustbench::bench
