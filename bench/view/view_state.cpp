#include "bench/view/view_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>

#include "bench/export/exporter.h"
#include "bench/results/shell_words.h"
#include "bench/suite/value_list.h"
#include "bench/world/cameras.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/files/toml_text.h"

namespace dustbench::view {
namespace {

/// The smallest part of `given` that results in the same values.
results::ParameterTexts necessary(const MethodInfo& method, const results::ParameterTexts& given) {
    const results::ParameterTexts whole = results::canonicalParameters(method, given);
    results::ParameterTexts needed = whole;
    for (const auto& [name, value] : whole) {
        needed.erase(name);
        if (results::canonicalParameters(method, needed) != whole) needed[name] = value;
    }
    return needed;
}

results::ParameterTexts merged(const results::ParameterTexts& world, const results::ParameterTexts& method) {
    results::ParameterTexts all = world;
    for (const auto& [name, value] : method) all[name] = value;
    return all;
}

HalfState normalisedHalf(const HalfState& state) {
    if (state.method == exactPicture) {
        if (state.parameters.empty()) return state;
        throw InputError(
            fmt::format("{}: got the parameter '{}', allowed: none", exactPicture, state.parameters.begin()->first));
    }
    const MethodInfo& method = findMethod(state.method);
    HalfState result{method.id, {}};
    for (auto& [name, value] : necessary(method, state.parameters))
        if (method.parameters.find(name)) result.parameters.emplace(name, value);
    return result;
}

// --- As a `dustbench run` line

/// The parameter that `--at` sets, if the method has one.
const Parameter* changesOf(const MethodInfo& method) {
    const auto& all = method.parameters.all();
    const auto found = std::ranges::find(all, ParameterType::changes, &Parameter::type);
    return found == all.end() ? nullptr : &*found;
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t from = 0;;) {
        const std::size_t end = text.find(separator, from);
        parts.push_back(text.substr(from, end - from));
        if (end == std::string::npos) return parts;
        from = end + 1;
    }
}

void addParameter(std::vector<std::string>& words, const MethodInfo& method, const std::string& name,
                  const std::string& value) {
    if (const Parameter* changes = changesOf(method); changes && changes->name == name) {
        for (const std::string& change : split(value, ';')) words.insert(words.end(), {"--at", change});
        return;
    }
    if (suite::expandValues(name, value) != std::vector{value})
        throw InputError(fmt::format("parameter {}: the command line would read '{}' as several values", name, value));
    words.insert(words.end(), {"-P", name + "=" + value});
}

std::int64_t integer(const std::string& option, const std::string& text, std::int64_t minimum) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < minimum)
        throw InputError(fmt::format("{}: got '{}', allowed: integer {} or more", option, text, minimum));
    return value;
}

/// Parses one line with the options that the state needs and those that it ignores.
class LineReader {
 public:
    LineReader() {
        state_.warmup = results::RunSpec().warmup;
        const auto text = [](std::string& place) { return [&place](const std::string& value) { place = value; }; };
        options_ = {
            {"--method", text(state_.a.method)},
            {"--scene", text(state_.scene)},
            {"--drive", text(state_.drive)},
            {"--camera-path", text(state_.cameraPath)},
            {"--dust", text(state_.dust)},
            {"--dust-columns", text(state_.dustColumns)},
            {"-P", [this](const std::string& value) { setParameter(value); }},
            {"--at", [this](const std::string& value) { changes_ += (changes_.empty() ? "" : ";") + value; }},
            {"--size", [this](const std::string& value) { state_.size = results::parseSize(value); }},
            {"--seed",
             [this](const std::string& value) {
                 state_.seed = static_cast<std::uint64_t>(integer("--seed", value, 0));
             }},
            {"--threads",
             [this](const std::string& value) { state_.threads = static_cast<int>(integer("--threads", value, 0)); }},
            {"--warmup", [this](const std::string& value) { state_.warmup = integer("--warmup", value, 0); }},
            {"--frames", [this](const std::string& value) { frames_ = integer("--frames", value, 1); }},
        };
        for (const char* other :
             {"--out", "--sync", "--images", "--video", "--gif", "--volumes", "--format", "--resolution", "--region"})
            options_[other] = [](const std::string&) {};
        for (const exports::ExporterOption& option : exports::exporterOptions())
            options_[option.commandName()] = [](const std::string&) {};
    }

    ViewState read(std::vector<std::string> words) {
        skipCommand(words);
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (words[i] == "--metrics") continue;
            std::string option = words[i], value;
            const std::size_t equals = option.starts_with("--") ? option.find('=') : std::string::npos;
            if (equals != std::string::npos) {
                value = option.substr(equals + 1);
                option.resize(equals);
            }
            const auto found = options_.find(option);
            if (found == options_.end()) throw unknownName("option of run", option, names());
            if (equals == std::string::npos) {
                if (++i == words.size()) throw InputError(option + ": got nothing, expected a value");
                value = words[i];
            }
            found->second(value);
        }
        return finished();
    }

 private:
    static void skipCommand(std::vector<std::string>& words) {
        if (!words.empty() && std::filesystem::path(words.front()).filename() == "dustbench")
            words.erase(words.begin());
        if (words.empty() || words.front() != "run")
            throw InputError(fmt::format("command line: got '{}', expected 'dustbench run' and its options",
                                         words.empty() ? "" : words.front()));
        words.erase(words.begin());
    }
    void setParameter(const std::string& text) {
        const std::size_t equals = text.find('=');
        if (equals == 0 || equals == std::string::npos) throw InputError("-P: got '" + text + "', expected name=value");
        const std::string name = text.substr(0, equals);
        const std::vector<std::string> values = suite::expandValues(name, text.substr(equals + 1));
        if (values.size() != 1)
            throw InputError(fmt::format("-P: parameter {}: got {} values, expected one", name, values.size()));
        if (!given_.emplace(name, values.front()).second) throw InputError("-P: parameter " + name + " is given twice");
    }
    ViewState finished() {
        if (state_.a.method.empty()) throw InputError("command line: --method is required");
        const MethodInfo& method = findMethod(state_.a.method);
        if (!changes_.empty()) {
            const Parameter* changes = changesOf(method);
            if (!changes)
                throw InputError("--at: method '" + method.id + "' has no setting that can change during a run");
            given_[changes->name] = changes_;
        }
        (void)results::resolveParameters(method, given_);
        if (!state_.cameraPath.empty()) (void)world::CameraPath::read(state_.cameraPath);
        for (const auto& [name, value] : given_)
            (method.parameters.find(name) ? state_.a.parameters : state_.world)[name] = value;
        state_.frame = frames_ - 1;
        return normalised(state_);
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all{"--metrics"};
        for (const auto& [name, take] : options_) all.push_back(name);
        return all;
    }

    ViewState state_;
    results::ParameterTexts given_;
    std::string changes_;
    std::int64_t frames_ = results::RunSpec().frames;
    std::map<std::string, std::function<void(const std::string&)>> options_;
};

// --- As TOML

using files::TomlReader, files::tomlText;

constexpr std::int64_t maximumInteger = std::numeric_limits<std::int64_t>::max();

std::string tableOf(const std::string& name, const results::ParameterTexts& parameters) {
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

results::ParameterTexts readParameters(TomlReader& parent, const std::string& key) {
    results::ParameterTexts parameters;
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
            if (!method.parameters.find(parameter)) (void)results::resolveParameters(method, {{parameter, value}});
            values.set(parameter, value);
        }
    });
    return half;
}

}  // namespace

const HalfState& half(const ViewState& state, Half which) {
    if (which == Half::a) return state.a;
    if (!state.b) throw std::logic_error("ViewState: there is no half B");
    return *state.b;
}

bool showsExact(const ViewState& state) {
    return state.b && state.b->method == exactPicture;
}

results::RunSpec runOf(const ViewState& state, Half which) {
    if (state.drive == keyboardDrive)
        throw InputError("drive: a run cannot be driven by keyboard; save the recording and use its file as the drive");
    const HalfState& shown = half(state, which);
    if (shown.method == exactPicture)
        throw InputError(
            "exact: no run draws the ground truth; `dustbench run --metrics` saves it next to the method's pictures");
    const MethodInfo& method = findMethod(shown.method);
    results::RunSpec spec;
    spec.method = method.id;
    spec.scene = state.scene;
    spec.drive = state.drive;
    spec.cameraPath = state.cameraPath;
    spec.dust = state.dust;
    spec.dustColumns = state.dustColumns;
    spec.parameters = results::canonicalParameters(method, merged(state.world, shown.parameters));
    spec.frames = state.frame + 1;
    spec.warmup = state.warmup;
    spec.size = state.size;
    spec.seed = state.seed;
    spec.threads = state.threads;
    spec.imagesEvery = state.frame > 0 ? state.frame : 1;
    return spec;
}

ViewState normalised(const ViewState& state) {
    if (state.a.method == exactPicture)
        throw InputError("half A: got 'exact', allowed: a method; only half B can be the ground truth");
    ViewState result = state;
    result.a = normalisedHalf(state.a);
    if (state.b) result.b = normalisedHalf(*state.b);
    ParameterValues world(world::worldParameters());
    for (const auto& [name, value] : state.world) world.set(name, value);
    result.world.clear();
    for (const Parameter& parameter : world::worldParameters().all())
        if (const std::string& value = world.canonical().at(parameter.name); value != parameter.initial)
            result.world[parameter.name] = value;
    return result;
}

// --- As a `dustbench run` line, and back

std::string commandLine(const ViewState& given, Half which, const std::string& out) {
    const ViewState state = normalised(given);
    const results::RunSpec spec = runOf(state, which);
    const MethodInfo& method = findMethod(spec.method);
    std::vector<std::string> words{"dustbench", "run", "--method", spec.method, "--scene", spec.scene};
    const auto add = [&words](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    if (!spec.drive.empty()) add("--drive", spec.drive);
    if (!spec.cameraPath.empty()) add("--camera-path", spec.cameraPath);
    if (!spec.dust.empty()) add("--dust", spec.dust);
    if (!spec.dustColumns.empty()) add("--dust-columns", spec.dustColumns);
    for (const results::ParameterTexts& set : {state.world, half(state, which).parameters})
        for (const auto& [name, value] : set) addParameter(words, method, name, value);
    if (spec.seed != results::RunSpec().seed) add("--seed", std::to_string(spec.seed));
    if (spec.threads != 0) add("--threads", std::to_string(spec.threads));
    add("--size", fmt::format("{}x{}", spec.size.width, spec.size.height));
    add("--warmup", std::to_string(spec.warmup));
    add("--frames", std::to_string(spec.frames));
    add("--images", std::to_string(spec.imagesEvery));
    add("--out", out);
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + results::shellQuoted(word);
    return line;
}

ViewState stateOfCommandLine(std::string_view line) {
    return LineReader().read(results::shellWords(line));
}

// --- As TOML, and back

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
        state.size = results::parseSize(size);
        if (!state.cameraPath.empty()) (void)world::CameraPath::read(state.cameraPath);
        ParameterValues values(world::worldParameters());
        for (const auto& [parameter, value] : state.world) values.set(parameter, value);
    });
    state.a = readHalf(root, "a");
    if (root.has("b")) state.b = readHalf(root, "b");
    root.finish();
    checked(root, [&] { state = normalised(state); });
    return state;
}

}  // namespace dustbench::view
