#include "bench/view/window_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "bench/export/whole_file.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/files/toml_text.h"

namespace dustbench::view {
namespace {

const std::vector<std::string> keys{"text_scale", "size", "shown", "divider", "panels", "keep_pace"};

std::string valueOf(const char* variable) {
    const char* value = std::getenv(variable);
    return value ? value : "";
}

results::ImageSize sizeOf(const files::TomlReader& table, const std::string& text) {
    try {
        return results::parseSize(text);
    } catch (const InputError& error) {
        throw InputError(table.where("size") + error.what());
    }
}

/// Message for the first unknown key; empty if there is none.
std::string warningOf(const files::TomlReader& table) {
    for (const std::string& key : table.keys()) {
        if (std::ranges::find(keys, key) != keys.end()) continue;
        return fmt::format("{}{}; it is ignored", table.where(key), unknownName("key", key, keys).what());
    }
    return "";
}

}  // namespace

std::filesystem::path windowSettingsFile() {
    std::filesystem::path folder = valueOf("XDG_CONFIG_HOME");
    if (!folder.is_absolute()) {
        const std::filesystem::path home = valueOf("HOME");
        if (!home.is_absolute()) return {};
        folder = home / ".config";
    }
    return folder / "dustbench" / "view.toml";
}

std::string toToml(const WindowSettings& settings) {
    return fmt::format(
        "# Appearance of the window of `dustbench view`, written when it is closed.\n"
        "text_scale = {}\nsize = \"{}x{}\"\nshown = {}\ndivider = {}\npanels = {}\nkeep_pace = {}\n",
        files::csvNumber(settings.textScale), settings.size.width, settings.size.height,
        files::tomlText(shownChoices.wordOf(settings.shown)), settings.divider, settings.showsPanels,
        settings.keepsPace);
}

SettingsKeeper::SettingsKeeper(std::filesystem::path file) : file_(std::move(file)) {
    try {
        std::error_code ignored;
        if (!file_.empty() && std::filesystem::exists(file_, ignored)) read_ = parse();
    } catch (const InputError& error) {
        isReadable_ = false;
        problem_ = fmt::format("{}; the window uses its defaults and leaves the file unchanged", error.what());
    }
    written_ = now_ = read_;
}

WindowSettings SettingsKeeper::parse() {
    files::TomlReader table = files::TomlReader::parseFile(file_);
    WindowSettings settings;
    settings.textScale = table.number("text_scale", minimumTextScale, maximumTextScale, settings.textScale);
    settings.size = sizeOf(table, table.text("size", "1280x720"));
    if (table.has("shown")) settings.shown = table.choice("shown", shownChoices);
    settings.divider = static_cast<float>(table.number("divider", 0, 1, static_cast<double>(settings.divider)));
    settings.showsPanels = table.boolean("panels", settings.showsPanels);
    settings.keepsPace = table.boolean("keep_pace", settings.keepsPace);
    problem_ = warningOf(table);
    return settings;
}

void SettingsKeeper::keep(const WindowSettings& now) {
    calls_ = now == now_ ? calls_ + 1 : 0;
    now_ = now;
    if (calls_ == callsToSettle) finish();
}

void SettingsKeeper::finish() {
    if (file_.empty() || !isReadable_ || now_ == written_) return;
    written_ = now_;  // try again only after another change
    std::error_code error;
    std::filesystem::create_directories(file_.parent_path(), error);
    if (error) files::failWriting(file_.parent_path(), error.value());
    exports::writeWhole(file_, toToml(now_));
}

}  // namespace dustbench::view
