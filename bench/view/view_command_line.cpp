// ViewState as a `dustbench run` line, and back.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <functional>
#include <map>

#include "bench/export/exporter.h"
#include "bench/results/shell_words.h"
#include "bench/scene/camera_path.h"
#include "bench/suite/value_list.h"
#include "bench/view/view_state.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::bench {
namespace {

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
    if (expandValues(name, value) != std::vector{value})
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
        state_.warmup = RunSpec().warmup;
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
            {"--size", [this](const std::string& value) { state_.size = parseSize(value); }},
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
        for (const ExporterOption& option : exporterOptions())
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
        const std::vector<std::string> values = expandValues(name, text.substr(equals + 1));
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
        (void)resolveParameters(method, given_);
        if (!state_.cameraPath.empty()) (void)CameraPath::read(state_.cameraPath);
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
    ParameterTexts given_;
    std::string changes_;
    std::int64_t frames_ = RunSpec().frames;
    std::map<std::string, std::function<void(const std::string&)>> options_;
};

}  // namespace

std::string commandLine(const ViewState& given, Half which, const std::string& out) {
    const ViewState state = normalised(given);
    const RunSpec spec = runOf(state, which);
    const MethodInfo& method = findMethod(spec.method);
    std::vector<std::string> words{"dustbench", "run", "--method", spec.method, "--scene", spec.scene};
    const auto add = [&words](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    if (!spec.drive.empty()) add("--drive", spec.drive);
    if (!spec.cameraPath.empty()) add("--camera-path", spec.cameraPath);
    if (!spec.dust.empty()) add("--dust", spec.dust);
    if (!spec.dustColumns.empty()) add("--dust-columns", spec.dustColumns);
    for (const ParameterTexts& set : {state.world, half(state, which).parameters})
        for (const auto& [name, value] : set) addParameter(words, method, name, value);
    if (spec.seed != RunSpec().seed) add("--seed", std::to_string(spec.seed));
    if (spec.threads != 0) add("--threads", std::to_string(spec.threads));
    add("--size", fmt::format("{}x{}", spec.size.width, spec.size.height));
    add("--warmup", std::to_string(spec.warmup));
    add("--frames", std::to_string(spec.frames));
    add("--images", std::to_string(spec.imagesEvery));
    add("--out", out);
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shellQuoted(word);
    return line;
}

ViewState stateOfCommandLine(std::string_view line) {
    return LineReader().read(shellWords(line));
}

}  // namespace dustbench::bench
