#include "bench/world/dust_moment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/maths/srgb.h"

namespace dustbench::world {
namespace {

struct Quantity {
    std::string_view key;
    std::size_t parts;
    std::vector<std::string> names;  ///< tried in this order
};

const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all{{"position", 3, {"Points", "position", "Position", "P", "x+y+z", "X+Y+Z"}},
                                           {"radius", 1, {"radius", "Radius", "R", "pscale"}},
                                           {"mass", 1, {"mass", "Mass"}},
                                           {"opacity", 1, {"opacity", "Opacity", "alpha", "Alpha"}},
                                           {"age", 1, {"age", "Age"}},
                                           {"lifetime", 1, {"lifetime", "Lifetime", "life"}},
                                           {"id", 1, {"serial", "id", "Id", "ID", "particle_id", "ParticleId"}},
                                           {"velocity", 3, {"velocity", "Velocity", "v", "vel", "vx+vy+vz"}},
                                           {"colour", 3, {"colour", "color", "Cd", "r+g+b", "R+G+B", "red+green+blue"}},
                                           {"time", 1, {"time_s", "time", "Time"}}};
    return all;
}

const Quantity& quantityOf(std::string_view key) {
    return *std::ranges::find(quantities(), key, &Quantity::key);
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (;;) {
        const std::size_t end = text.find(separator);
        parts.emplace_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

/// The usual names for the three columns of a vector.
std::vector<std::vector<std::string>> spellings(const std::string& name) {
    if (name.find('+') != std::string::npos) return {split(name, '+')};
    std::vector<std::vector<std::string>> all;
    for (const auto& [before, after] :
         {std::pair(":", ""), std::pair("_", ""), std::pair(".", ""), std::pair("", ""), std::pair("[", "]")})
        for (const char* letters : {"012", "xyz", "XYZ", "rgb", "RGB"}) {
            std::vector<std::string>& three = all.emplace_back();
            for (int i = 0; i < 3; ++i) three.push_back(name + before + letters[i] + after);
        }
    return all;
}

/// The column of that name, or three columns of one number each; only the first three of a colour's four numbers.
std::vector<ColumnNumbers::Part> partsOf(const volumes::PointTable& table, const std::string& name,
                                         const Quantity& quantity) {
    const std::size_t parts = quantity.parts;
    std::vector<ColumnNumbers::Part> found;
    if (const volumes::PointColumn* column = table.find(name); column) {
        const auto components = static_cast<std::size_t>(column->components);
        if (components == parts || (quantity.key == "colour" && components == 4)) {
            for (std::size_t i = 0; i < parts; ++i)
                found.push_back({&column->values, components, i, 0, column->isByte});
            return found;
        }
    }
    if (parts != 3) return found;
    for (const std::vector<std::string>& three : spellings(name)) {
        for (const std::string& each : three)
            if (const volumes::PointColumn* column = table.find(each); column && column->components == 1)
                found.push_back({&column->values, 1, 0, 0, column->isByte});
        if (found.size() == 3 && three.size() == 3) return found;
        found.clear();
    }
    return found;
}

/// True for one of three columns that form a vector by a usual name: `R` with `G` and `B` is not a radius.
bool isPartOfVector(const volumes::PointTable& table, const std::string& name) {
    const auto isThere = [&](const std::string& each) {
        const volumes::PointColumn* const column = table.find(each);
        return column && column->components == 1;
    };
    for (const Quantity& quantity : quantities()) {
        if (quantity.parts != 3) continue;
        for (const std::string& vector : quantity.names)
            for (const std::vector<std::string>& three : spellings(vector))
                if (three.size() == 3 && std::ranges::find(three, name) != three.end() &&
                    std::ranges::all_of(three, isThere))
                    return true;
    }
    return false;
}

bool isNamed(std::string_view column, const std::string& name, std::size_t parts) {
    if (column == name) return true;
    if (parts == 3)
        for (const std::vector<std::string>& three : spellings(name))
            if (std::ranges::find(three, column) != three.end()) return true;
    return false;
}

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

DustColumns DustColumns::parse(const std::string& textOrFile) {
    DustColumns columns;
    if (textOrFile.ends_with(".toml")) {
        files::TomlReader table = files::TomlReader::parseFile(textOrFile);
        for (const std::string& key : table.keys()) try {
                const std::vector<std::string> values = table.scalars(key);
                columns.set(key, fmt::format("{}", fmt::join(values, "+")));
            } catch (const InputError& error) {
                const std::string message = error.what(), where = table.where(key);
                throw message.starts_with(where) ? error : InputError(where + message);
            }
        table.finish();
        return columns;
    }
    if (textOrFile.empty()) return columns;
    for (const std::string& pair : split(textOrFile, ',')) {
        const std::size_t equals = pair.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == pair.size())
            throw InputError(
                fmt::format("--dust-columns: got '{}', expected key=COLUMN,key=COLUMN or a .toml file", pair));
        columns.set(pair.substr(0, equals), pair.substr(equals + 1));
    }
    return columns;
}

void DustColumns::set(const std::string& key, const std::string& value) {
    std::vector<std::string> known{"scale", "up"};
    for (const Quantity& quantity : quantities()) known.emplace_back(quantity.key);
    if (std::ranges::find(known, key) == known.end()) throw unknownName("key of dust columns", key, known);
    if (!given_.emplace(key, value).second)
        throw InputError(fmt::format("--dust-columns: key '{}' is given twice", key));
    if (key == "up") {
        if (value != "y" && value != "z")
            throw InputError(fmt::format("--dust-columns: up: got '{}', allowed: y, z", value));
        zUp_ = value == "z";
    } else if (key == "scale") {
        const std::optional<double> number = files::numberOf(value);
        if (!number || *number < 1e-6 || *number > 1e6)
            throw InputError(
                fmt::format("--dust-columns: scale: got '{}', allowed: 1e-6..1e6, metres per unit of length", value));
        metresPerUnit_ = *number;
    }
}

bool DustColumns::wants(std::string_view column) const {
    return std::ranges::any_of(quantities(), [&](const Quantity& quantity) {
        if (const auto given = given_.find(quantity.key); given != given_.end())
            return isNamed(column, given->second, quantity.parts);
        return std::ranges::any_of(quantity.names,
                                   [&](const std::string& name) { return isNamed(column, name, quantity.parts); });
    });
}

std::optional<ColumnNumbers> DustColumns::find(const volumes::PointTable& table, std::string_view key,
                                               const std::string& file) const {
    const Quantity& quantity = quantityOf(key);
    const auto given = given_.find(key);
    if (given == given_.end()) {
        for (const std::string& name : quantity.names) {
            if (quantity.parts == 1 && isPartOfVector(table, name)) continue;
            if (auto parts = partsOf(table, name, quantity); !parts.empty())
                return ColumnNumbers{name, std::move(parts)};
        }
        return std::nullopt;
    }
    const std::string& name = given->second;
    if (auto parts = partsOf(table, name, quantity); !parts.empty()) return ColumnNumbers{name, std::move(parts)};
    const std::vector<std::string> numbers = split(name, '+');
    ColumnNumbers constant{name, {}};
    for (const std::string& text : numbers)
        if (const std::optional<double> number = files::numberOf(text))
            constant.parts.push_back({nullptr, 1, 0, *number});
    if (constant.parts.size() == quantity.parts && numbers.size() == quantity.parts && key != "id" && key != "time")
        return constant;
    std::vector<std::string> has;
    has.reserve(table.columns.size());
    for (const volumes::PointColumn& column : table.columns)
        has.push_back(column.components == 1 ? column.name
                                             : fmt::format("{} ({} numbers)", column.name, column.components));
    throw InputError(fmt::format("{}: no column '{}' of {} for {}; it has: {}", file, name,
                                 quantity.parts == 1 ? "one number" : "three numbers", key, fmt::join(has, ", ")));
}

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

}  // namespace dustbench::world
