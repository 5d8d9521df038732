// Answers with the fields of a volume: the density's box, and the other fields in the same cells.
#pragma once

#include <string>

#include "methods/kit/volumes/field_request.h"
#include "methods/kit/volumes/vdb_message.h"

namespace dustbench::volumes {

/// The header that announces a field's values.
[[nodiscard]] inline VdbColumn columnOf(const WantedField& field) {
    VdbColumn column;
    field.what.copy(column.name, sizeof column.name - 1);
    column.components = field.components;
    return column;
}

/// For a `.vdb`. Throws Refusal, or what OpenVDB throws.
[[noreturn]] void answerVolume(const std::string& file, const VolumeFields& fields);
/// For a `.nvdb`, likewise.
[[noreturn]] void answerNanoVolume(const std::string& file, const VolumeFields& fields);

}  // namespace dustbench::volumes
