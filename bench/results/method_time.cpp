#include "bench/results/method_time.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "bench/export/exporter.h"
#include "bench/results/measured_on.h"
#include "bench/scene/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/csv.h"

namespace dustbench::bench {
namespace {

constexpr std::string_view methodColumn = "method_ms_median";

std::optional<double> frameMs(const StoredRun& run) {
    const auto cell = run.cells.find("frame_ms_median");
    double ms = 0;
    if (run.status != RunStatus::done || cell == run.cells.end()) return std::nullopt;
    const char* const end = cell->second.data() + cell->second.size();
    const auto [at, error] = std::from_chars(cell->second.data(), end, ms);
    if (error != std::errc() || at != end) return std::nullopt;
    return ms;
}

bool isBaseline(const StoredRun& run, const MethodInfo& info) {
    const auto method = run.cells.find("method");
    return method != run.cells.end() && method->second == baselineMethod &&
           std::ranges::all_of(info.parameters.all(), [&](const Parameter& parameter) {
               const auto found = run.parameters.find(parameter.name);
               return found != run.parameters.end() && found->second == parameter.initial;
           });
}

}  // namespace

const MethodInfo* findBaseline() {
    const auto found = std::ranges::find(methods(), baselineMethod, &MethodInfo::id);
    return found == methods().end() ? nullptr : &*found;
}

std::optional<KeyFields> pairKey(const StoredRun& run) try {
    static const std::set<std::string> leftOut = [] {
        std::set<std::string> names{"method", "images",  "volumes",          "formats",        "resolution",
                                    "region", "metrics", "metric_reference", "metric_pictures"};
        for (const ExporterOption& option : exporterOptions()) names.insert(option.id);
        return names;
    }();
    KeyFields fields = keyFields(run);
    std::erase_if(fields, [](const auto& field) {
        const auto& [name, value] = field;
        return leftOut.contains(name) || (name.starts_with("p.") && !worldParameters().find(name.substr(2)));
    });
    return fields;
} catch (const InputError&) {
    return std::nullopt;
}

void addMethodTimes(StoredRuns& runs) {
    const MethodInfo* info = findBaseline();
    std::multimap<KeyFields, const StoredRun*> baselines;
    for (const auto& [id, run] : runs)
        if (info && isBaseline(run, *info) && frameMs(run))
            if (auto key = pairKey(run)) baselines.emplace(std::move(*key), &run);
    for (auto& [id, run] : runs) {
        run.cells.erase(std::string(methodColumn));
        const auto ms = frameMs(run);
        if (!ms || baselines.empty() || isBaseline(run, *info)) continue;
        const auto key = pairKey(run);
        if (!key) continue;
        const auto [begin, end] = baselines.equal_range(*key);
        const auto paired = std::find_if(
            begin, end, [&](const auto& entry) { return differences(run, *entry.second, machineFields()).empty(); });
        if (paired != end) run.cells.emplace(methodColumn, files::csvNumber(*ms - *frameMs(*paired->second)));
    }
}

}  // namespace dustbench::bench
