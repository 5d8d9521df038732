#include "methods/kit/files/data_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/files/shipped_folder.h"

namespace dustbench::files {
namespace fs = std::filesystem;
namespace {

constexpr const char* variable = "DUSTBENCH_DATA";
constexpr char pathSeparator = ':';
/// Subfolders of a data folder.
constexpr std::array<const char*, 8> parts{"scenes", "drives", "particles", "textures",
                                           "shapes", "fluids", "volumes",   "suites"};

/// Returns an absolute path, so that processes in other folders find it too.
fs::path checkedFolder(std::string_view option, const std::string& named) {
    const fs::path folder = fs::absolute(named).lexically_normal();
    if (!fs::exists(folder))
        throw InputError(fmt::format("{}: '{}': no such folder{}", option, named, didYouMean(folder)));
    if (!fs::is_directory(folder))
        throw InputError(fmt::format("{}: '{}': is a file, expected a folder of data", option, named));
    const bool holdsData = fs::is_directory(folder / "papers") || std::ranges::any_of(parts, [&](const char* part) {
                               return fs::is_directory(folder / part);
                           });
    if (!holdsData)
        throw InputError(fmt::format("{}: '{}': contains no data, expected one or more of the folders {}, papers",
                                     option, named, fmt::join(parts, ", ")));
    return folder;
}

std::vector<std::string_view> eachOf(std::string_view extensions) {
    std::vector<std::string_view> all;
    for (;;) {
        const std::size_t end = extensions.find('|');
        all.push_back(extensions.substr(0, end));
        if (end == std::string_view::npos) return all;
        extensions.remove_prefix(end + 1);
    }
}

/// Calls `take` for every entry of `<folder>` in all data folders.
template <typename Take>
void forEachEntry(std::string_view folder, const Take& take) {
    for (const fs::path& data : dataFolders()) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(data / folder, error)) take(entry);
    }
}

}  // namespace

fs::path dataFolder() {
    return shippedFolder("data", "share/dustbench");
}

std::vector<fs::path> namedDataFolders() {
    std::vector<fs::path> folders;
    const char* named = std::getenv(variable);
    std::string_view rest = named ? named : "";
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(pathSeparator), rest.size());
        if (end > 0) folders.push_back(checkedFolder(variable, std::string(rest.substr(0, end))));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return folders;
}

std::vector<fs::path> dataFolders() {
    std::vector<fs::path> folders = namedDataFolders();
    try {
        folders.push_back(dataFolder());
    } catch (const InputError&) {
        if (folders.empty()) throw;
    }
    return folders;
}

void useDataFolders(std::string_view option, const std::vector<std::string>& folders) {
    std::string joined;
    for (const std::string& named : folders) {
        const std::string folder = checkedFolder(option, named).string();
        if (folder.find(pathSeparator) != std::string::npos)
            throw InputError(fmt::format("{}: '{}': has a '{}' in its path, which separates folders; move or link it",
                                         option, named, pathSeparator));
        joined += (joined.empty() ? "" : std::string(1, pathSeparator)) + folder;
    }
    setenv(variable, joined.c_str(), 1);
}

fs::path dataPath(const fs::path& relative) {
    for (const fs::path& folder : dataFolders())
        if (fs::exists(folder / relative)) return folder / relative;
    return {};
}

std::vector<std::string> listData(std::string_view folder, std::string_view extension) {
    std::set<std::string> ids;
    forEachEntry(folder, [&](const fs::directory_entry& entry) {
        std::error_code loop;
        const auto hasIt = [&](std::string_view each) { return entry.path().extension() == each; };
        if (entry.is_regular_file(loop) && std::ranges::any_of(eachOf(extension), hasIt))
            ids.insert(entry.path().stem());
    });
    return {ids.begin(), ids.end()};
}

std::vector<std::string> listDataFolders(std::string_view folder) {
    std::set<std::string> ids;
    forEachEntry(folder, [&](const fs::directory_entry& entry) {
        std::error_code loop;
        if (entry.is_directory(loop)) ids.insert(entry.path().filename());
    });
    return {ids.begin(), ids.end()};
}

bool isDataFile(std::string_view nameOrFile, std::string_view extension) {
    return nameOrFile.find('/') != std::string_view::npos ||
           std::ranges::any_of(eachOf(extension), [&](std::string_view each) { return nameOrFile.ends_with(each); });
}

std::string fromFile(const fs::path& from, const std::string& nameOrFile, std::string_view extension) {
    if (!isDataFile(nameOrFile, extension)) return nameOrFile;
    return (from.parent_path() / nameOrFile).lexically_normal().string();
}

fs::path fileNamedBy(const fs::path& from, std::string_view folder, const std::string& named) {
    const fs::path relativeToFile = (from.parent_path() / named).lexically_normal();
    std::vector<std::string> tried;
    const auto isThere = [&](const fs::path& file) {
        if (fs::is_regular_file(file)) return true;
        if (std::ranges::find(tried, file.string()) == tried.end()) tried.push_back(file.string());
        return false;
    };
    fs::path found = isThere(relativeToFile) ? relativeToFile : fs::path();
    if (found.empty() && fs::path(named).is_relative())
        for (const fs::path& data : dataFolders())
            if (const fs::path file = (data / folder / named).lexically_normal(); found.empty() && isThere(file))
                found = file;
    if (found.empty())
        throw InputError(
            fmt::format("'{}': no such file, tried {}{}", named, fmt::join(tried, ", "), didYouMean(relativeToFile)));
    for (const std::string& elsewhere : tried) noteSearch(elsewhere);
    noteInput(found);
    return found;
}

fs::path findData(std::string_view kind, std::string_view folder, std::string_view nameOrFile,
                  std::string_view extension) {
    if (isDataFile(nameOrFile, extension)) {
        const fs::path file(nameOrFile);
        if (isPattern(file)) {
            (void)matchingFiles(file);
            return file;
        }
        if (!fs::is_regular_file(file))
            throw InputError(fmt::format("{} file '{}': no such file{}", kind, nameOrFile, didYouMean(file)));
        noteInput(file);
        return file;
    }
    fs::path file;
    for (const std::string_view each : eachOf(extension))
        if (file.empty()) file = dataPath(fs::path(folder) / fmt::format("{}{}", nameOrFile, each));
    if (file.empty()) throw unknownName(kind, nameOrFile, listData(folder, extension));
    noteInput(file);
    return file;
}

std::string didYouMean(const fs::path& missing) {
    std::vector<std::string> names;
    std::error_code error;
    const fs::path parent = missing.has_parent_path() ? missing.parent_path() : fs::path(".");
    for (const auto& entry : fs::directory_iterator(parent, error))
        if (entry.path().filename() != missing.filename()) names.push_back(entry.path().filename());
    std::ranges::sort(names);
    const std::string nearest = nearestName(missing.filename().string(), names);
    return nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", (missing.parent_path() / nearest).string());
}

}  // namespace dustbench::files
