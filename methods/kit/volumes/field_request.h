// The fields wanted from a file, by the names from a program's settings or by default names.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/files/limits.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

struct WantedField {
    std::string_view what;  ///< for messages
    int components = 1;
    std::vector<std::string> names;  ///< any of them matches
    bool isRequired = false;
    bool takesOnlyOne = false;  ///< accepts the only field with this many components if no name matches
};

/// Density, temperature and velocity, in this order.
[[nodiscard]] inline std::array<WantedField, 3> wantedFields(const VolumeFields& fields) {
    const auto or_ = [](const std::string& name, std::vector<std::string> usual) {
        return name.empty() ? std::move(usual) : std::vector<std::string>{name};
    };
    return {
        {{"density", 1, or_(fields.density, {"density", "Density", "extinction", "smoke"}), true,
          fields.density.empty()},
         {"temperature", 1, or_(fields.temperature, {"temperature", "Temperature", "heat"}), fields.wantsTemperature,
          false},
         {"velocity", 3, or_(fields.velocity, {"velocity", "Velocity", "vel", "v"}), !fields.velocity.empty(), false}}};
}

/// The maximum number of cells in the density's box, and the message if there are more.
[[nodiscard]] inline std::int64_t maximumCells(const VolumeFields& fields) {
    return fields.isSparse ? files::limits::sparseVolumeCells : files::limits::volumeCells;
}
[[nodiscard]] inline std::string tooManyCells(const VolumeFields& fields) {
    return std::string("the box of its density has more than ") +
           (fields.isSparse ? "2 billion cells (limit of sparse volumes)" : "256 million cells (limit of volumes)");
}

/// Converts to one text for the arguments of a program, and back.
[[nodiscard]] inline std::string textOf(const VolumeFields& fields) {
    return fields.density + '\x1f' + fields.temperature + '\x1f' + fields.velocity + '\x1f' +
           (fields.wantsTemperature ? "1" : "") + '\x1f' + (fields.isSparse ? "1" : "");
}
[[nodiscard]] inline VolumeFields fieldsOf(std::string_view text) {
    const auto next = [&text] {
        const std::size_t end = std::min(text.find('\x1f'), text.size());
        const std::string part(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        return part;
    };
    VolumeFields fields;
    for (std::string* name : {&fields.density, &fields.temperature, &fields.velocity}) *name = next();
    fields.wantsTemperature = next() == "1";
    fields.isSparse = next() == "1";
    return fields;
}

/// A field of a file.
struct PresentField {
    std::string name;
    int components = 1;  ///< 0: not read
    std::string kind;    ///< distinguishes it in messages: `at points`, `int32`
};

/// The fields that were not chosen, as `grid 'heat'`, or with their kinds `grid 'heat' (grid 2 of float)`.
[[nodiscard]] inline std::vector<std::string> restOf(std::span<const PresentField> present,
                                                     std::span<const std::size_t> chosen) {
    std::vector<std::string> rest;
    for (std::size_t i = 0; i < present.size(); ++i)
        if (std::ranges::find(chosen, i) == chosen.end())
            rest.push_back("grid '" + present[i].name.substr(0, 60) + "'" +
                           (std::ranges::count(present, present[i].name, &PresentField::name) > 1
                                ? " (" + present[i].kind + ")"
                                : ""));
    return rest;
}

/// Arrays that VTK and VisIt use internally, such as ghosts; never a field of the volume.
[[nodiscard]] inline bool isBookkeeping(std::string_view name) {
    return name.starts_with("vtk") || name.starts_with("avtGhost");
}

/// The fields as text, at most ten of them; fields with the same name are listed with their kinds.
[[nodiscard]] inline std::string listOf(std::span<const PresentField> fields) {
    std::string list;
    for (const PresentField& field : fields.first(std::min<std::size_t>(fields.size(), 10))) {
        list += (list.empty() ? "" : ", ") + (field.name.empty() ? "(no name)" : field.name);
        if (std::ranges::count(fields, field.name, &PresentField::name) > 1) list += " (" + field.kind + ")";
    }
    return fields.size() > 10 ? list + " and " + std::to_string(fields.size() - 10) + " others" : list;
}

/// Whether it has one of these names, alone or with its kind, as listOf writes them: `density`, `density (at cells)`.
[[nodiscard]] inline bool hasName(const PresentField& field, std::span<const std::string> names) {
    return std::ranges::any_of(names, [&](const std::string& name) {
        return name == field.name || name == field.name + " (" + field.kind + ")";
    });
}

/// Index of the wanted field in `present`: the only one with one of these names and the right components, at cells or
/// points; −1 if there is none and it is optional. Otherwise throws `Refusal` with a clause.
template <typename Refusal>
[[nodiscard]] int chosenField(const WantedField& wanted, std::span<const PresentField> present) {
    std::vector<int> places;
    std::vector<PresentField> named, fitting, others;
    int only = -1;
    for (int i = 0; i < static_cast<int>(present.size()); ++i) {
        const PresentField& field = present[static_cast<std::size_t>(i)];
        if (isBookkeeping(field.name)) continue;
        const bool isNamed = hasName(field, wanted.names);
        if (field.components != wanted.components) {
            if (isNamed) others.push_back(field);
            continue;
        }
        fitting.push_back(field);
        only = i;
        if (!isNamed) continue;
        named.push_back(field);
        places.push_back(i);
    }
    if (named.size() == 1) return places.front();
    const std::string what(wanted.what), numbers = wanted.components == 3 ? "vectors" : "numbers";
    if (named.size() > 1)
        throw Refusal{"it has more than one field of " + numbers + " for its " + what + ": " + listOf(named) +
                      "; name one of these in [fields] of a .toml"};
    if (wanted.takesOnlyOne && fitting.size() == 1) return only;
    if (!wanted.isRequired) return -1;
    const std::string reason = "it has no field of " + numbers + " '" + wanted.names.front() + "'";
    if (!others.empty())
        throw Refusal{reason + "; '" + others[0].name + "' (" + others[0].kind + ") does not contain " +
                      (wanted.components == 3 ? "vectors of floats" : "one floating-point number per cell")};
    throw Refusal{reason + (fitting.empty() ? "" : "; it has: " + listOf(fitting))};
}

}  // namespace dustbench::volumes
