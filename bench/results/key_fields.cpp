#include "bench/results/key_fields.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

template <typename Number>
void readNumber(const StoredRun& run, const std::string& name, const std::string& text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        throw InputError(fmt::format("run '{}': {} is '{}', expected an integer", run.runId, name, text));
}

}  // namespace

KeyFields keyFields(const StoredRun& run) {
    const auto key = run.provenance.find("key");
    if (key == run.provenance.end() || key->second.empty())
        throw InputError(fmt::format("run '{}': has no provenance.key, which identifies the configuration", run.runId));
    KeyFields fields;
    std::istringstream lines(key->second);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos)
            throw InputError(
                fmt::format("run '{}': its provenance.key has the line '{}', expected name=value", run.runId, line));
        fields.emplace_back(line.substr(0, equals), line.substr(equals + 1));
    }
    return fields;
}

RunSpec specFromKey(const StoredRun& run) {
    RunSpec spec;
    for (const auto& [name, text] : keyFields(run)) {
        if (name == "method") spec.method = text;
        if (name == "scene") spec.scene = text;
        if (name == "drive") spec.drive = text;
        if (name == "camera_path") spec.cameraPath = text;
        if (name == "dust") spec.dust = text;
        if (name == "dust_columns") spec.dustColumns = text;
        if (name == "dust_on") spec.dustOn = dustPlaces.parse("dust_on", text);
        if (name == "frames") readNumber(run, name, text, spec.frames);
        if (name == "warmup") readNumber(run, name, text, spec.warmup);
        if (name == "size") spec.size = parseSize(text);
        if (name == "seed") readNumber(run, name, text, spec.seed);
        if (name == "threads") readNumber(run, name, text, spec.threads);
        if (name == "sync") spec.sync = syncs.parse("sync", text);
        if (name == "images") readNumber(run, name, text, spec.imagesEvery);
        if (name == "times") spec.timed = text != "0";
        if (name == "repetition") readNumber(run, name, text, spec.repetition);
        if (name.starts_with("p.")) spec.parameters[name.substr(2)] = text;
    }
    return spec;
}

}  // namespace dustbench::bench
