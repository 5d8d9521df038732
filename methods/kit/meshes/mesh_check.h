// Validates OBJ and PLY files before a trusting reader parses them: counts, indices and numbers must be consistent.
#pragma once

#include <filesystem>

namespace dustbench::meshes {

/// Checks that every number of `v`, `vt`, `vn` is finite and that every face refers to existing elements. Throws
/// InputError with file and line.
void checkObj(const std::filesystem::path& file);

/// Checks that the header is valid and that the body (ASCII or binary) holds everything announced. Throws InputError
/// with file and line, or with the truncated element.
void checkPly(const std::filesystem::path& file);

}  // namespace dustbench::meshes
