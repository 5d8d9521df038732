#include "methods/kit/files/matching_files.h"

#include <fnmatch.h>

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/input_log.h"

namespace dustbench::files {
namespace fs = std::filesystem;

bool isPattern(const fs::path& path) {
    return path.filename().string().find('*') != std::string::npos;
}

std::vector<fs::path> matchingFiles(const fs::path& pattern) {
    const std::string name = pattern.filename().string();
    std::vector<fs::path> found;
    std::error_code error;
    if (!isPattern(pattern)) {
        found.push_back(pattern);
    } else {
        for (const auto& entry : fs::directory_iterator(pattern.has_parent_path() ? pattern.parent_path() : ".", error))
            if (fnmatch(name.c_str(), entry.path().filename().c_str(), FNM_PERIOD) == 0) found.push_back(entry.path());
        std::ranges::sort(found);
    }
    if (found.empty() || !fs::is_regular_file(found.front(), error))
        throw InputError(pattern.string() + ": no such file" + (isPattern(pattern) ? "" : nearestBeside(pattern)));
    for (const fs::path& file : found) noteInput(file);
    return found;
}

}  // namespace dustbench::files
