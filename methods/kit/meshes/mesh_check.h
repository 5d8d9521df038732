// Checks OBJ and PLY files before a reader that trusts them sees them: counts, indices and numbers must fit together.
#pragma once

#include <filesystem>

namespace dustbench::meshes {

/// Every number of `v`, `vt`, `vn` is finite, and every face names what has been given. Throws InputError with file and
/// line.
void checkObj(const std::filesystem::path& file);

/// The header is sound and the body (ASCII or binary) holds all that it announces. Throws InputError with file and
/// line, or with the element that is cut off.
void checkPly(const std::filesystem::path& file);

}  // namespace dustbench::meshes
