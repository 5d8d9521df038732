#include "bench/scene/dust_columns.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {
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

}  // namespace dustbench::bench
