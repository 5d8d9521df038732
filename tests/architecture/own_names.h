// Checks that no two files of a module declare the same name in unnamed namespaces.
//
// The build compiles files of a module together (reports/decisions/0019-joined-files.md). A type of the same name is an
// error there; a function may silently become an overload of the other file's function.
#pragma once

#include "tests/architecture/source_rules.h"

namespace dustbench::architecture {

struct OwnName {
    std::string name;
    std::string space;  ///< the named namespace around the unnamed one
    std::size_t line;   ///< from 1
};

/// The declarations of a file in unnamed namespaces, as laid out by `make format`, except members, tests and `using`s
/// of other names.
[[nodiscard]] std::vector<OwnName> ownNames(std::string_view text);

/// Names that two files of a folder (with its `parts/`) declare in this way; module, tests and benchmarks separately.
[[nodiscard]] Faults sharedNameFaults(const std::vector<SourceFile>& files);

}  // namespace dustbench::architecture
