// Methods and parts of particle systems from outside: libraries `<id>.dustmethod.so` (methods/kit/library).
//
// They are looked for in the folders of DUSTBENCH_METHOD_PATH, then in <prefix>/lib/dustbench/methods of an installed
// program. The first folder that has an id wins. A library that cannot be taken is no error; it is known with the
// reason.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/method.h"
#include "methods/kit/particles/part.h"

namespace dustbench::bench {

struct MethodLibrary {
    std::filesystem::path file;  ///< absolute
    std::string id;              ///< by its file's name
    std::string whyNot;          ///< it was not taken; empty if it was
};

/// For this process and those that it starts: instead of what $DUSTBENCH_METHOD_PATH names. `option` is the word for
/// messages. Throws InputError if a folder is missing.
void useMethodFolders(std::string_view option, const std::vector<std::string>& folders);

/// Loads every library of the folders and adds its method to methods(), its parts to particles::partTable(). Call once,
/// before methods are asked for. Throws InputError if a folder of $DUSTBENCH_METHOD_PATH is missing.
void loadMethodLibraries();

/// All that were found, by id.
[[nodiscard]] const std::vector<MethodLibrary>& methodLibraries();

struct LibraryContents {
    std::optional<MethodInfo> method;
    std::vector<particles::PartInfo> parts;
};

/// Loads one library. The contents are described if the text is empty; otherwise it says why the library is not taken.
[[nodiscard]] std::string loadLibrary(const std::filesystem::path& file, const std::string& id,
                                      LibraryContents& contents);

/// How two fingerprints of build_fingerprint.h differ: `NDEBUG: undefined, expected 1`; empty if they do not.
[[nodiscard]] std::string fingerprintDifference(std::string_view got, std::string_view expected);

}  // namespace dustbench::bench
