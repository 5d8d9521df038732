#include "bench/world/data_list.h"

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::world {
namespace {

/// The result of `read`, or the reason why it failed: a broken file must not hide the others.
template <typename Read>
std::string descriptionOr(const Read& read) {
    try {
        return read();
    } catch (const InputError& error) {
        return std::string("cannot be read: ") + error.what();
    }
}

}  // namespace

std::vector<DataEntry> listScenes() {
    std::vector<DataEntry> entries;
    for (const std::string& id : files::listData("scenes", ".toml")) {
        DataEntry entry{id, ""};
        entry.description = descriptionOr([&] {
            auto file = files::TomlReader::parseFile(files::findData("scene", "scenes", id, ".toml"));
            entry.panels = static_cast<std::int64_t>(file.tables("panel").size());
            return file.text("description");
        });
        entries.push_back(std::move(entry));
    }
    return entries;
}

std::vector<DataEntry> listDrives() {
    std::vector<DataEntry> entries;
    for (const std::string& id : files::listData("drives", ".csv"))
        entries.push_back({id, descriptionOr([&]() -> std::string {
                               const auto drive = files::findData("drive", "drives", id, ".csv");
                               const auto file = drive.parent_path() / "drives.toml";
                               if (!std::filesystem::exists(file)) return "";
                               return files::TomlReader::parseFile(file).text(id, "");
                           })});
    return entries;
}

}  // namespace dustbench::world
