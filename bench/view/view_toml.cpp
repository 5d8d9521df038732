// ViewState as TOML, and back.
#include <fmt/format.h>

#include <limits>

#include "bench/scene/camera_path.h"
#include "bench/scene/world.h"
#include "bench/view/view_state.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/files/toml_text.h"

namespace dustbench::bench {
namespace {

using files::TomlReader, files::tomlText;

constexpr std::int64_t maximumInteger = std::numeric_limits<std::int64_t>::max();

std::string tableOf(const std::string& name, const ParameterTexts& parameters) {
    if (parameters.empty()) return {};
    std::string text = "\n[" + name + "]\n";
    for (const auto& [parameter, value] : parameters)
        text += fmt::format("{} = {}\n", tomlText(parameter), tomlText(value));
    return text;
}

std::string halfText(const std::string& name, const HalfState& half) {
    return fmt::format("\n[{}]\nmethod = {}\n", name, tomlText(half.method)) +
           tableOf(name + ".parameters", half.parameters);
}

ParameterTexts readParameters(TomlReader& parent, const std::string& key) {
    ParameterTexts parameters;
    if (!parent.has(key)) return parameters;
    TomlReader table = parent.table(key);
    for (const std::string& name : table.keys()) {
        const std::vector<std::string> values = table.scalars(name);
        if (values.size() != 1)
            throw InputError(
                fmt::format("{}key '{}': got {} values, expected one", table.where(name), name, values.size()));
        parameters[name] = values.front();
    }
    return parameters;
}

/// Adds the location to errors in names and values.
template <typename Check>
void checked(const TomlReader& table, const Check& check) {
    try {
        check();
    } catch (const InputError& error) {
        throw InputError(table.where() + error.what());
    }
}

HalfState readHalf(TomlReader& root, const char* name) {
    TomlReader table = root.table(name);
    HalfState half{table.text("method"), readParameters(table, "parameters")};
    table.finish();
    if (half.method == exactPicture) return half;
    checked(table, [&] {
        const MethodInfo& method = findMethod(half.method);
        ParameterValues values(method.parameters);
        for (const auto& [parameter, value] : half.parameters) {
            if (!method.parameters.find(parameter)) (void)resolveParameters(method, {{parameter, value}});
            values.set(parameter, value);
        }
    });
    return half;
}

}  // namespace

std::string toToml(const ViewState& state) {
    std::string text = fmt::format("scene = {}\n", tomlText(state.scene));
    if (!state.drive.empty()) text += fmt::format("drive = {}\n", tomlText(state.drive));
    if (!state.cameraPath.empty()) text += fmt::format("camera_path = {}\n", tomlText(state.cameraPath));
    if (!state.dust.empty()) text += fmt::format("dust = {}\n", tomlText(state.dust));
    if (!state.dustColumns.empty()) text += fmt::format("dust_columns = {}\n", tomlText(state.dustColumns));
    text += fmt::format("seed = {}\nsize = \"{}x{}\"\nthreads = {}\nwarmup = {}\nframe = {}\n", state.seed,
                        state.size.width, state.size.height, state.threads, state.warmup, state.frame);
    text += tableOf("world", state.world) + halfText("a", state.a);
    if (state.b) text += halfText("b", *state.b);
    return text;
}

ViewState stateOfToml(std::string_view text, const std::string& name) {
    TomlReader root = TomlReader::parseText(text, name);
    ViewState state;
    state.scene = root.text("scene", state.scene);
    state.drive = root.text("drive", "");
    state.cameraPath = root.text("camera_path", "");
    state.dust = root.text("dust", "");
    state.dustColumns = root.text("dust_columns", "");
    state.seed = static_cast<std::uint64_t>(root.integer("seed", 0, maximumInteger, 1));
    const std::string size = root.text("size", "640x480");
    state.threads = static_cast<int>(root.integer("threads", 0, 1024, 0));
    state.warmup = root.integer("warmup", 0, 10'000'000, 0);
    state.frame = root.integer("frame", 0, 10'000'000, 0);
    state.world = readParameters(root, "world");
    checked(root, [&] {
        state.size = parseSize(size);
        if (!state.cameraPath.empty()) (void)CameraPath::read(state.cameraPath);
        ParameterValues values(worldParameters());
        for (const auto& [parameter, value] : state.world) values.set(parameter, value);
    });
    state.a = readHalf(root, "a");
    if (root.has("b")) state.b = readHalf(root, "b");
    root.finish();
    checked(root, [&] { state = normalised(state); });
    return state;
}

}  // namespace dustbench::bench
