#include "methods/kit/files/data_folder.h"

#include <algorithm>
#include <cstdlib>

#include "methods/contract/errors.h"

namespace dustbench::files {
namespace fs = std::filesystem;

fs::path dataFolder() {
    if (const char* folder = std::getenv("DUSTBENCH_DATA"); folder && *folder) return folder;
    return fs::path(DUSTBENCH_DATA_FOLDER);
}

std::vector<std::string> listData(std::string_view folder, std::string_view extension) {
    std::vector<std::string> ids;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(dataFolder() / folder, error))
        if (entry.is_regular_file() && entry.path().extension() == extension) ids.push_back(entry.path().stem());
    std::ranges::sort(ids);
    return ids;
}

fs::path findData(std::string_view kind, std::string_view folder, std::string_view id, std::string_view extension) {
    if (id.find('/') != std::string_view::npos || id.ends_with(extension)) {
        if (!fs::is_regular_file(fs::path(id)))
            throw InputError(std::string(kind) + " file '" + std::string(id) + "': no such file");
        return fs::path(id);
    }
    const std::vector<std::string> known = listData(folder, extension);
    if (std::ranges::find(known, id) == known.end()) throw unknownName(kind, id, known);
    return dataFolder() / folder / (std::string(id) + std::string(extension));
}

}  // namespace dustbench::files
