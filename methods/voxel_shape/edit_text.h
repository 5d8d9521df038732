// Edits of a shape as words on the command line, and as the tables of a shape file that say the same.
//
// `sphere=0,0.5,0,0.2 colour=0.8,0.1,0.1` is [[edit]] with centre, radius_metres and colour: words are the keys of a
// shape file (data/shapes/car.toml), lists have commas. Besides, `sphere=x,y,z,r` and `box=x,y,z,x,y,z` (minimum and
// maximum) are short for two keys each.
//
// Units: m, s, linear RGB. Frame: the shape's own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "methods/voxel_shape/voxels/voxel_change.h"

namespace dustbench::voxel_shape {

enum class EditKind {
    paint,  ///< changes how particles look
    carve,  ///< takes voxels out
    fill,   ///< puts voxels in, and paints them
    force
};

/// The keys of an edit, one a line. A mesh's path, relative to the working directory, becomes relative to `folder`.
/// `option` is the word for messages. Throws InputError with the nearest word.
[[nodiscard]] std::string editAsToml(EditKind kind, std::string_view option, std::string_view words,
                                     const std::filesystem::path& folder);

/// The same as a shape file's reader takes it. Throws InputError for what such a file may not say.
[[nodiscard]] VoxelEdit readEditWords(EditKind kind, std::string_view option, std::string_view words);

/// The text of the shape file `from` with [[edit]] tables behind it, as a file in `folder`: its paths lead to the same
/// files from there, and it saves no voxels.
[[nodiscard]] std::string withEdits(std::string_view text, const std::filesystem::path& from,
                                    const std::filesystem::path& folder, std::string_view edits);

}  // namespace dustbench::voxel_shape
