// The names that files keep to themselves, in unnamed namespaces: no two files of a module share one.
//
// The build compiles files of a module together (reports/decisions/0019-joined-files.md). A type of the same name is an
// error there; a function may silently become an overload of the other file's.
#pragma once

#include "tests/architecture/source_rules.h"

namespace dustbench::architecture {

struct OwnName {
    std::string name;
    std::string space;  ///< the named namespace around the unnamed one
    std::size_t line;   ///< from 1
};

/// What a file declares in unnamed namespaces, as laid out by `make format`; without members, tests and `using`s of
/// other names.
[[nodiscard]] std::vector<OwnName> ownNames(std::string_view text);

/// Names that two files of one folder (with `parts/` below it) declare so, tests and benchmarks apart from the module.
[[nodiscard]] Faults sharedNameFaults(const std::vector<SourceFile>& files);

}  // namespace dustbench::architecture
