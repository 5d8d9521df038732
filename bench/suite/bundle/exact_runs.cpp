#include "bench/suite/bundle/exact_runs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/results/compared_runs.h"
#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace {

/// Settings that do not affect the state get the defaults of RunSpec.
RunSpec specOf(const StoredRun& run) {
    RunSpec spec = specFromKey(run);
    const RunSpec usual;
    // The dust of a GPU may differ in its last bits: where it was, not where it may be now.
    if (const auto place = run.provenance.find("dust_on"); place != run.provenance.end())
        if (const auto known = dustPlaces.find(place->second); known && *known == DustOn::gpu) spec.dustOn = *known;
    spec.threads = usual.threads;
    spec.sync = usual.sync;
    spec.timed = usual.timed;
    spec.imagesEvery = usual.imagesEvery;
    spec.repetition = usual.repetition;
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
