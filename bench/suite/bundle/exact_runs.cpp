#include "bench/suite/bundle/exact_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "bench/results/key_fields.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

template <typename Number>
Number numberIn(const StoredRun& run, const std::string& name, const std::string& text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        throw InputError(fmt::format("run '{}': {} is '{}', expected an integer", run.runId, name, text));
    return number;
}

/// Settings that decide nothing about the state stay as RunSpec has them.
RunSpec specOf(const StoredRun& run) {
    RunSpec spec;
    for (const auto& [name, text] : keyFields(run)) {
        if (name == "method") spec.method = text;
        if (name == "scene") spec.scene = text;
        if (name == "drive") spec.drive = text;
        if (name == "camera_path") spec.cameraPath = text;
        if (name == "dust") spec.dust = text;
        if (name == "dust_columns") spec.dustColumns = text;
        if (name == "frames") spec.frames = numberIn<std::int64_t>(run, name, text);
        if (name == "warmup") spec.warmup = numberIn<std::int64_t>(run, name, text);
        if (name == "size") spec.size = parseSize(text);
        if (name == "seed") spec.seed = numberIn<std::uint64_t>(run, name, text);
        if (name.starts_with("p.")) spec.parameters[name.substr(2)] = text;
    }
    return spec;
}

}  // namespace

std::vector<ExactRun> exactRuns(const StoredRuns& runs) {
    std::vector<ExactRun> exact;
    std::map<std::string, std::size_t> places;  // by key
    for (const auto& [id, run] : runs) {
        if (run.status != RunStatus::done || run.stateHash.empty()) continue;
        RunSpec spec = specOf(run);
        const auto [place, isNew] = places.try_emplace(canonicalKey(spec), exact.size());
        if (isNew) exact.push_back({{}, run.stateHash, run.methodHash, std::move(spec)});
        ExactRun& one = exact[place->second];
        if (const std::string difference = hashDifference(run, one); !difference.empty())
            throw InputError(
                fmt::format("run '{}': {}, as in run '{}' of the same simulation", id, difference, one.runIds.front()));
        one.runIds.push_back(id);
    }
    return exact;
}

std::string hashDifference(const StoredRun& got, const ExactRun& expected) {
    std::vector<std::string> differences;
    const auto compare = [&](const char* name, const std::string& mine, const std::string& wanted) {
        const auto shown = [](const std::string& hash) { return hash.empty() ? "none" : hash; };
        if (mine != wanted)
            differences.push_back(fmt::format("{} is {}, expected {}", name, shown(mine), shown(wanted)));
    };
    compare("state_hash", got.stateHash, expected.stateHash);
    compare("method_hash", got.methodHash, expected.methodHash);
    return fmt::format("{}", fmt::join(differences, "; "));
}

}  // namespace dustbench::bench
