// External methods and parts of particle systems: libraries `<id>.dustmethod.so` (methods/kit/library).
//
// Search order: the folders of DUSTBENCH_METHOD_PATH, then <prefix>/lib/dustbench/methods of an installed program. The
// first folder that contains an id wins. A library that cannot be loaded is not an error; it is listed with the reason.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/method.h"
#include "methods/kit/particles/part.h"

namespace dustbench::suite {

struct MethodLibrary {
    std::filesystem::path file;  ///< absolute
    std::string id;              ///< from its file name
    std::string whyNot;          ///< why it was not loaded; empty if it was
};

/// Replaces the folders of $DUSTBENCH_METHOD_PATH for this process and its children. `option` names the option in
/// messages. Throws InputError if a folder is missing.
void useMethodFolders(std::string_view option, const std::vector<std::string>& folders);

/// Loads every library of the folders and adds its method to methods() and its parts to particles::partTable(). Call
/// once, before the first use of methods(). Throws InputError if a folder of $DUSTBENCH_METHOD_PATH is missing.
void loadMethodLibraries();

/// All libraries that were found, by id.
[[nodiscard]] const std::vector<MethodLibrary>& methodLibraries();

struct LibraryContents {
    std::optional<MethodInfo> method;
    std::vector<particles::PartInfo> parts;
};

/// Loads one library and describes its contents. Returns why it cannot be used; empty if it can.
[[nodiscard]] std::string loadLibrary(const std::filesystem::path& file, const std::string& id,
                                      LibraryContents& contents);

/// The differences between two fingerprints of build_fingerprint.h, as in `NDEBUG is undefined, expected 1`; empty if
/// they are equal.
[[nodiscard]] std::string fingerprintDifference(std::string_view got, std::string_view expected);

/// Tries a task that may end its process, such as loading a library, in a copy of this process. Returns the result of
/// `task` from a copy of this process. If the task ends the copy, returns how it ended and its last line on stderr: "a
/// process that tried it ended by signal 11 (Segmentation fault)". SIGALRM ends the copy after a minute. Call before
/// this process starts threads. Throws std::system_error if the copy cannot be made.
[[nodiscard]] std::string triedInChild(const std::function<std::string()>& task);

}  // namespace dustbench::suite
