#include "methods/kit/files/shipped_folder.h"

#include <fmt/format.h>

#include "methods/contract/errors.h"

namespace dustbench::files {
namespace fs = std::filesystem;

fs::path shippedFolder(std::string_view inTree, std::string_view installed) {
    return shippedFolder(fs::read_symlink("/proc/self/exe"), inTree, installed);
}

fs::path shippedFolder(const fs::path& program, std::string_view inTree, std::string_view installed) {
    const fs::path parent = program.parent_path().parent_path();
    const fs::path ofPrefix = parent / installed, ofTree = parent.parent_path() / inTree;
    for (const fs::path& folder : {ofPrefix, ofTree})
        if (fs::is_directory(folder)) return folder;
    throw InputError(fmt::format("'{}': its files are missing, expected in '{}' or in '{}'", program.string(),
                                 ofTree.string(), ofPrefix.string()));
}

}  // namespace dustbench::files
