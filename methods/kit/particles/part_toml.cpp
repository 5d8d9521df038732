#include "methods/kit/particles/part_toml.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/files/toml_text.h"
#include "methods/kit/particles/part.h"

namespace dustbench::particles {
namespace {

/// `direction` for `direction.x`; a name without components is unchanged.
std::string_view stem(std::string_view parameter) {
    return parameter.substr(0, parameter.find('.'));
}

/// The parameters behind a key of a file: one, or the components of a vector.
std::vector<const Parameter*> parametersOf(const ParameterSet& declared, std::string_view key) {
    std::vector<const Parameter*> found;
    for (const Parameter& parameter : declared.all())
        if (stem(parameter.name) == key) found.push_back(&parameter);
    return found;
}

std::vector<std::string> keysOf(const ParameterSet& declared) {
    std::vector<std::string> keys;
    for (const Parameter& parameter : declared.all())
        if (keys.empty() || keys.back() != stem(parameter.name)) keys.emplace_back(stem(parameter.name));
    return keys;
}

/// Replaces a path by the absolute path of its file; returns a name unchanged.
std::string fileOf(const std::filesystem::path& from, const Parameter& parameter, const std::string& text) {
    if (from.empty() || parameter.fileExtension.empty()) return text;
    const std::filesystem::path named(text);
    if (!named.has_extension() && !named.has_parent_path()) return text;
    try {
        return std::filesystem::absolute(files::fileNamedBy(from, parameter.dataFolder, text)).lexically_normal();
    } catch (const InputError& error) {
        throw InputError("parameter " + parameter.name + ": " + error.what());
    }
}

void readParameter(files::TomlReader& table, const std::filesystem::path& from, const PartInfo& info,
                   const std::string& key, ParameterValues& values) {
    const auto parameters = parametersOf(info.parameters, key);
    if (parameters.empty()) throw unknownName("parameter of '" + info.name + "'", key, keysOf(info.parameters));
    const auto texts = table.scalars(key);
    if (texts.size() != parameters.size())
        throw InputError("parameter " + key + ": got " + std::to_string(texts.size()) + " values, expected " +
                         std::to_string(parameters.size()));
    for (std::size_t i = 0; i < texts.size(); ++i)
        values.set(parameters[i]->name, fileOf(from, *parameters[i], texts[i]));
}

/// Runs `action` and prefixes its errors with the position of `key`.
template <typename Action>
auto at(const files::TomlReader& table, std::string_view key, Action action) {
    try {
        return action();
    } catch (const InputError& error) {
        throw InputError(table.where(key) + error.what());
    }
}

std::unique_ptr<Part> readPart(files::TomlReader table, const std::filesystem::path& from, PartKind kind) {
    const std::string name = table.text("part");
    const PartInfo& info =
        at(table, "part", [&]() -> std::reference_wrapper<const PartInfo> { return findPart(kind, name); }).get();
    ParameterValues values(info.parameters);
    for (const std::string& key : table.keys())
        if (key != "part") at(table, key, [&] { readParameter(table, from, info, key, values); });
    return at(table, "part", [&] { return info.create(values); });
}

/// Reads the parts in a table; all its other keys must have been read before. `from`: the file, or empty.
std::unique_ptr<PartList> readParts(files::TomlReader& table, const std::filesystem::path& from) {
    auto parts = std::make_unique<PartList>();
    if (table.has("storage")) parts->setStorage(table.choice("storage", storages));
    for (std::size_t k = 0; k < partKindNames.size(); ++k) {
        const auto kind = static_cast<PartKind>(k);
        const std::string_view key = partKindNames[k];
        if (isList(kind)) {
            for (files::TomlReader& each : table.tables(key)) parts->set(readPart(std::move(each), from, kind));
        } else if (table.has(key)) {
            parts->set(readPart(table.table(key), from, kind));
        }
    }
    table.finish();
    if (parts->emission() && parts->emission()->neverEmits())
        throw InputError(table.where("emission") + "emission part '" + parts->emission()->name() +
                         "': got rates of 0, allowed: a rate above 0, otherwise no particle is born");
    if (const std::string missing = parts->missing(); !missing.empty())
        throw InputError(table.where() + "particle system: " + missing);
    return parts;
}

bool isName(std::string_view text) {
    const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return !text.empty() && text.front() >= 'a' && std::ranges::all_of(text, fits) &&
           std::ranges::find(partKindNames, text) == partKindNames.end();
}

std::string readName(files::TomlReader& table, const std::vector<NamedParts>& before) {
    std::string name = table.text("name");
    if (!isName(name))
        throw InputError(table.where("name") + "key 'name': got '" + name +
                         "', expected lower-case letters, digits and '_', a letter first, and not a kind of part");
    if (std::ranges::find(before, name, &NamedParts::name) != before.end())
        throw InputError(table.where("name") + "two systems are named '" + name + "', expected unique names");
    return name;
}

std::vector<NamedParts> readSystems(files::TomlReader file, const std::filesystem::path& from,
                                    const std::string& stem) {
    std::vector<NamedParts> systems;
    if (!file.has("system")) {
        systems.push_back({stem, readParts(file, from)});
        return systems;
    }
    for (files::TomlReader& table : file.tables("system")) {
        std::string name = readName(table, systems);
        systems.push_back({std::move(name), readParts(table, from)});
    }
    if (systems.empty()) throw InputError(file.where("system") + "key 'system': got none, expected one or more tables");
    file.finish();
    return systems;
}

std::unique_ptr<PartList> onlySystem(std::vector<NamedParts> systems, const std::string& file) {
    if (systems.size() > 1)
        throw InputError(file + ": got " + std::to_string(systems.size()) +
                         " particle systems, expected one: several systems need the method plugin_particles");
    return std::move(systems.front().parts);
}

/// The values of the given parameters, as a list if there are several.
template <typename TextOf>
std::string joined(const std::vector<const Parameter*>& parameters, const TextOf& textOf) {
    std::string list;
    for (const Parameter* parameter : parameters) list.append(list.empty() ? "" : ", ").append(textOf(*parameter));
    return parameters.size() > 1 ? "[" + list + "]" : list;
}

std::string partToToml(const Part& part, const std::string& prefix) {
    const std::string table = prefix + std::string(kindName(part.kind()));
    std::string toml = isList(part.kind()) ? "[[" + table + "]]\n" : "[" + table + "]\n";
    toml += "part = " + files::tomlText(part.name()) + "\n";
    for (const std::string& key : keysOf(part.values().declared())) {
        const auto textOf = [&](const Parameter& parameter) {
            return valueToToml(parameter, part.values().canonical().find(parameter.name)->second);
        };
        toml += key + " = " + joined(parametersOf(part.values().declared(), key), textOf) + "\n";
    }
    return toml;
}

/// Before the parts; nothing if it is the default.
std::string storageToToml(const PartList& parts) {
    if (parts.storage() == Storage::array) return {};
    return "storage = " + files::tomlText(std::string(storages.wordOf(parts.storage()))) + "\n";
}

std::string partsToToml(const PartList& parts, const std::string& prefix) {
    std::string toml;
    for (const Part* part : parts.all()) toml.append(toml.empty() ? "" : "\n").append(partToToml(*part, prefix));
    return toml;
}

}  // namespace

std::vector<NamedParts> systemsFromFile(const std::filesystem::path& file) {
    return readSystems(files::TomlReader::parseFile(file), file, file.stem().string());
}

std::vector<NamedParts> systemsFromText(std::string_view text, std::string name) {
    const std::string stem = std::filesystem::path(name).stem().string();
    return readSystems(files::TomlReader::parseText(text, std::move(name)), {}, stem);
}

std::unique_ptr<PartList> partsFromFile(const std::filesystem::path& file) {
    auto parts = onlySystem(systemsFromFile(file), file.string());
    if (!parts->events().empty())
        throw InputError(file.string() +
                         ": got a system with events, allowed here: none; they need the method plugin_particles");
    return parts;
}

std::unique_ptr<PartList> partsFromText(std::string_view text, std::string name) {
    const std::string file = name;
    return onlySystem(systemsFromText(text, std::move(name)), file);
}

std::string partsToToml(const PartList& parts) {
    const std::string storage = storageToToml(parts);
    return storage + (storage.empty() ? "" : "\n") + partsToToml(parts, "");
}

std::string systemsToToml(std::span<const NamedPartsView> systems) {
    if (systems.size() == 1) return partsToToml(systems.front().parts);
    std::string toml;
    for (const NamedPartsView& system : systems)
        toml.append(toml.empty() ? "" : "\n")
            .append("[[system]]\nname = " + files::tomlText(system.name) + "\n" + storageToToml(system.parts) + "\n")
            .append(partsToToml(system.parts, "system."));
    return toml;
}

std::vector<Parameter> tableKeys(const ParameterSet& declared) {
    std::vector<Parameter> keys;
    for (const std::string& key : keysOf(declared)) {
        const auto parameters = parametersOf(declared, key);
        Parameter shown = *parameters.front();
        shown.name = key;
        shown.initial = joined(parameters, [](const Parameter& parameter) { return parameter.initial; });
        keys.push_back(std::move(shown));
    }
    return keys;
}

std::string valueToToml(const Parameter& parameter, const std::string& canonical) {
    if (parameter.type == ParameterType::choice) return files::tomlText(canonical);
    if (parameter.type == ParameterType::boolean) return canonical == "on" ? "true" : "false";
    return canonical;
}

}  // namespace dustbench::particles
