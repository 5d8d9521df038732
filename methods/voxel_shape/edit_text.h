// Edits of a shape as words on the command line, and the equivalent tables of a shape file.
//
// `sphere=0,0.5,0,0.2 colour=0.8,0.1,0.1` is [[edit]] with centre, radius_metres and colour: the words are the keys of
// a shape file (data/shapes/car.toml), lists are separated by commas. In addition, `sphere=x,y,z,r` and
// `box=x,y,z,x,y,z` (minimum and maximum) abbreviate two keys each.
//
// Units: m, s, linear RGB. Frame: the shape's own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "methods/voxel_shape/voxels/voxel_change.h"

namespace dustbench::voxel_shape {

enum class EditKind {
    paint,  ///< changes the look of particles
    carve,  ///< removes voxels
    fill,   ///< adds voxels, and paints them
    force
};

/// Returns the keys of an edit, one per line. The path of a mesh is relative to the working directory and becomes
/// relative to `folder`. `option` is the option's name for messages. Throws InputError with the nearest word.
[[nodiscard]] std::string editAsToml(EditKind kind, std::string_view option, std::string_view words,
                                     const std::filesystem::path& folder);

/// Returns the edit as the reader of shape files parses it. Throws InputError for edits that a shape file would not
/// allow.
[[nodiscard]] VoxelEdit readEditWords(EditKind kind, std::string_view option, std::string_view words);

/// Returns the text of the shape file `from` with [[edit]] tables appended, to be saved in `folder`: paths are adapted
/// to that folder, and `save_voxels_as` is removed.
[[nodiscard]] std::string withEdits(std::string_view text, const std::filesystem::path& from,
                                    const std::filesystem::path& folder, std::string_view edits);

}  // namespace dustbench::voxel_shape
