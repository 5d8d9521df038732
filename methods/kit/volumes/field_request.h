// Which fields of a file are wanted, under which names: of a program's settings, or the usual ones.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/files/limits.h"
#include "methods/kit/volumes/volume_setup.h"

namespace dustbench::volumes {

struct WantedField {
    std::string_view what;  ///< for messages
    int components = 1;
    std::vector<std::string> names;  ///< the first that is there is taken
    bool isRequired = false;
    bool takesOnlyOne = false;  ///< if there is none of these names but just one field of so many components
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

/// Cells that the box of the density may have, and the reason to refuse more.
[[nodiscard]] inline std::int64_t maximumCells(const VolumeFields& fields) {
    return fields.isSparse ? files::limits::sparseVolumeCells : files::limits::volumeCells;
}
[[nodiscard]] inline std::string tooManyCells(const VolumeFields& fields) {
    return std::string("the box of its density has more than ") +
           (fields.isSparse ? "2 billion cells (limit of sparse volumes)" : "256 million cells (limit of volumes)");
}

/// As one text, for the arguments of a program; and back.
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

/// The place of the wanted field among `present`, whose names and components it has; −1 if there is none and it need
/// not be there. Throws `Refusal` with a clause otherwise.
template <typename Refusal, typename Present>
[[nodiscard]] int chosenField(const WantedField& wanted, const Present& present) {
    std::string others;
    int count = 0, only = -1;
    for (int i = 0; i < static_cast<int>(present.size()); ++i) {
        const auto& [name, components] = present[static_cast<std::size_t>(i)];
        if (components != wanted.components) continue;
        others += (others.empty() ? "; it has: " : ", ") + name;
        ++count;
        only = i;
    }
    for (const std::string& name : wanted.names)
        for (int i = 0; i < static_cast<int>(present.size()); ++i)
            if (const auto& [is, components] = present[static_cast<std::size_t>(i)];
                is == name && components == wanted.components)
                return i;
    if (wanted.takesOnlyOne && count == 1) return only;
    if (!wanted.isRequired) return -1;
    throw Refusal{"it has no field of " + std::string(wanted.components == 3 ? "vectors" : "numbers") + " '" +
                  wanted.names.front() + "'" + others};
}

}  // namespace dustbench::volumes
