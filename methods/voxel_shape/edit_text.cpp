#include "methods/voxel_shape/edit_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <regex>
#include <sstream>
#include <vector>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_text.h"
#include "methods/voxel_shape/shape.h"

namespace dustbench::voxel_shape {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> regionWords{"sphere",        "box", "mesh", "centre",   "to",
                                           "radius_metres", "min", "max",  "position", "scale"};
const std::vector<std::string> lookWords{"colour",
                                         "opacity",
                                         "size_voxels",
                                         "fading_colour",
                                         "fading_opacity",
                                         "fading_size_voxels",
                                         "lifetime_seconds",
                                         "interpolation_seconds",
                                         "pictures_per_second",
                                         "maximum_density"};
const std::vector<std::string> forceWords{
    "kind", "acceleration", "axis", "radians_per_second", "growth_per_radian", "metres_per_radian"};

bool isOneOf(std::string_view word, const std::vector<std::string>& words) {
    return std::ranges::find(words, word) != words.end();
}

/// Returns the words that an edit accepts besides those of a region.
const std::vector<std::string>& ownWords(EditKind kind) {
    static const std::vector<std::string> none;
    if (kind == EditKind::carve) return none;
    return kind == EditKind::force ? forceWords : lookWords;
}

std::optional<double> numberOf(std::string_view text) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
    return number;
}

struct Word {
    std::string key, value;
};

/// Returns `--paint 'sphere=…'`, for messages.
std::string named(std::string_view option, std::string_view words) {
    return fmt::format("{} '{}'", option, words);
}

std::vector<Word> split(EditKind kind, std::string_view option, std::string_view words) {
    std::vector<std::string> allowed = regionWords;
    allowed.insert(allowed.end(), ownWords(kind).begin(), ownWords(kind).end());
    std::vector<Word> list;
    std::istringstream stream{std::string(words)};
    for (std::string word; stream >> word;) {
        const std::size_t equals = word.find('=');
        const std::string key = word.substr(0, equals);
        if (equals == std::string::npos || equals + 1 == word.size())
            throw InputError(fmt::format("{}: got '{}', expected key=value", named(option, words), word));
        if (!isOneOf(key, allowed)) throw unknownName(fmt::format("word of {}", option), key, allowed);
        for (const Word& other : list)
            if (other.key == key)
                throw InputError(fmt::format("{}: got '{}' twice, allowed: once", named(option, words), key));
        list.push_back({key, word.substr(equals + 1)});
    }
    return list;
}

/// Parses numbers such as `0.8,0.1,0.1`. `count` 0: any number of them.
std::vector<double> numbersOf(const std::string& where, const Word& word, std::size_t count) {
    std::vector<double> numbers;
    std::istringstream stream(word.value);
    for (std::string part; std::getline(stream, part, ',');)
        if (const auto number = numberOf(part)) numbers.push_back(*number);
    const auto commas = static_cast<std::size_t>(std::ranges::count(word.value, ','));
    if (numbers.size() != commas + 1 || (count > 0 && numbers.size() != count))
        throw InputError(fmt::format("{}: {}: got '{}', expected {} numbers separated by commas", where, word.key,
                                     word.value, count > 0 ? std::to_string(count) : "one or three"));
    return numbers;
}

std::string tomlArray(const std::vector<double>& numbers, std::size_t first, std::size_t count) {
    return fmt::format("[{}]", fmt::join(numbers.begin() + static_cast<std::ptrdiff_t>(first),
                                         numbers.begin() + static_cast<std::ptrdiff_t>(first + count), ", "));
}

std::string valueOf(const std::string& where, const Word& word) {
    if (word.key == "kind") return files::tomlText(word.value);
    const std::vector<double> numbers = numbersOf(where, word, 0);
    return numbers.size() == 1 ? fmt::format("{}", numbers.front()) : tomlArray(numbers, 0, numbers.size());
}

std::string pathFrom(const fs::path& folder, const fs::path& file) {
    return fs::proximate(fs::absolute(file), fs::absolute(folder)).generic_string();
}

/// Returns a word of the region as keys of an edit's table.
std::string regionLines(const std::string& where, const Word& word, const fs::path& folder) {
    if (word.key == "sphere") {
        const std::vector<double> n = numbersOf(where, word, 4);
        return fmt::format("centre = {}\nradius_metres = {}\n", tomlArray(n, 0, 3), n[3]);
    }
    if (word.key == "box") {
        const std::vector<double> n = numbersOf(where, word, 6);
        return fmt::format("min = {}\nmax = {}\n", tomlArray(n, 0, 3), tomlArray(n, 3, 3));
    }
    if (word.key == "mesh") return fmt::format("mesh = {}\n", files::tomlText(pathFrom(folder, word.value)));
    return fmt::format("{} = {}\n", word.key, valueOf(where, word));
}

}  // namespace

std::string editAsToml(EditKind kind, std::string_view option, std::string_view words, const fs::path& folder) {
    const std::string where = named(option, words);
    std::string region, own;
    for (const Word& word : split(kind, option, words)) {
        if (isOneOf(word.key, regionWords))
            region += regionLines(where, word, folder);
        else if (kind == EditKind::force)
            own += fmt::format("{}{} = {}", own.empty() ? "" : ", ", word.key, valueOf(where, word));
        else
            own += fmt::format("{} = {}\n", word.key, valueOf(where, word));
    }
    if (region.empty()) throw InputError(where + ": no region, expected a sphere, a box or a mesh");
    if (own.empty() && (kind == EditKind::paint || kind == EditKind::force))
        throw InputError(
            fmt::format("{}: nothing to change, expected one or more of {}", where, fmt::join(ownWords(kind), ", ")));
    if (kind == EditKind::carve) return region + "active = false\n";
    if (kind == EditKind::fill) return region + "active = true\n" + own;
    return region + (kind == EditKind::force ? "force = { " + own + " }\n" : own);
}

VoxelEdit readEditWords(EditKind kind, std::string_view option, std::string_view words) {
    const fs::path here = fs::current_path();
    // The user never sees the generated TOML, so messages name the option without line numbers.
    const std::string name = named(option, words), toml = editAsToml(kind, option, words, here);
    try {
        files::TomlReader table = files::TomlReader::parseText(toml, name);
        VoxelEdit edit = readEdit(table, here / "words.toml");
        edit.where = name + ": ";
        return edit;
    } catch (const InputError& error) {
        std::string message = error.what();
        if (message.starts_with(name + ":")) {
            const std::size_t end = message.find(": ", name.size() + 1);
            if (end != std::string::npos) message.erase(name.size(), end - name.size());
        }
        throw InputError(message);
    }
}

namespace {

/// Converts a path in shape file `from` for a shape file in `folder`. Names of data files do not change.
std::string renamed(const std::string& named, const fs::path& from, const fs::path& folder) {
    const fs::path relativeToFile = from.parent_path() / named;
    const bool isData = !fs::exists(relativeToFile) && !files::dataPath(fs::path("shapes") / named).empty();
    return named == "vehicle" || isData ? named : pathFrom(folder, relativeToFile);
}

}  // namespace

std::string withEdits(std::string_view text, const fs::path& from, const fs::path& folder, std::string_view edits) {
    static const std::regex saved(R"((^|\n)[ \t]*save_voxels_as[ \t]*=[^\n]*)");
    static const std::regex path(
        R"re((\b(?:mesh|mesh_otherwise|voxels_from|shape)[ \t]*=[ \t]*)(?:"([^"\n]*)"|'([^'\n]*)'))re");
    const std::string own = std::regex_replace(std::string(text), saved, "$1");
    std::string out;
    auto last = own.cbegin();
    for (std::sregex_iterator at(own.begin(), own.end(), path), end; at != end; ++at) {
        const std::string file = (*at)[2].matched ? (*at)[2].str() : (*at)[3].str();
        out.append(last, (*at)[0].first).append((*at)[1].str());
        out += files::tomlText(renamed(file, from, folder));
        last = (*at)[0].second;
    }
    out.append(last, own.cend());
    if (!out.empty() && out.back() != '\n') out.push_back('\n');
    return out.append(edits);
}

}  // namespace dustbench::voxel_shape
