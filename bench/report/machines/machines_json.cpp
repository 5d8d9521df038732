#include <nlohmann/json.hpp>

#include "bench/measure/provenance.h"
#include "bench/report/json_parts.h"
#include "bench/report/machines/machine_comparison.h"
#include "bench/results/method_facts.h"
#include "bench/suite/catalogue.h"

namespace dustbench::bench {
namespace {

using nlohmann::json;

/// `[ratio, low, high, pairs, verdict, reason]`; null: not measured.
json sideJson(const SideRatio& side) {
    if (side.result.pairs == 0 && side.reason == "not measured") return nullptr;
    return {number(side.result.ratio), number(side.result.low),          number(side.result.high),
            side.result.pairs,         verdictName(side.result.verdict), side.reason};
}

json rowJson(const RatioRow& row) {
    return {{"world", row.world},
            {"agreement", agreementText(agreementOf(row.sides))},
            {"sides", each(row.sides, sideJson)}};
}

json ratioJson(const MachineRatio& ratio) {
    return {{"of", ratio.of},         {"with", ratio.with},        {"column", ratio.column},
            {"common", ratio.common}, {"all", rowJson(ratio.all)}, {"worlds", each(ratio.worlds, rowJson)}};
}

json valueJson(const MachineValue& value) {
    return {{"variant", value.variant},
            {"world", value.world},
            {"machine", value.side},
            {"column", value.column},
            {"values", {number(value.value.median), number(value.value.low), number(value.value.high)}},
            {"of", value.value.values},
            {"seeds", value.overSeeds},
            {"probability", number(value.value.probability)}};
}

json experimentJson(const MachineExperiment& experiment) {
    return {{"id", experiment.id},
            {"title", experiment.title},
            {"summary", experiment.summary},
            {"reference", experiment.reference},
            {"axes",
             each(experiment.axes,
                  [](const WorldAxis& axis) {
                      return json{
                          {"name", axis.name}, {"unit", axis.unit}, {"numeric", axis.numeric}, {"values", axis.values}};
                  })},
            {"variants", each(experiment.variants,
                              [](const MachineVariant& variant) {
                                  return json{{"method", variant.method}, {"label", variant.label}};
                              })},
            {"worlds", experiment.worlds},
            {"ratios", each(experiment.ratios, ratioJson)},
            {"values", each(experiment.values, valueJson)}};
}

json claimsJson(const SharedClaim& shared) {
    json claim = claimJson(shared.any());
    claim["agreement"] = agreementText(shared.agreement);
    claim["folders"] = each(shared.folders, [](const EvaluatedClaim* evaluated) {
        if (!evaluated) return json(nullptr);
        json own = claimJson(*evaluated);
        json kept = json::object();
        for (const char* name : {"verdict", "verdictText", "measured", "low", "high", "control", "condition", "note"})
            kept[name] = std::move(own[name]);
        return kept;
    });
    return claim;
}

json remarksJson(const MachineRemarks& remarks) {
    return {{"apart", remarks.apart},
            {"programs", remarks.programs},
            {"notes", remarks.notes},
            {"missing", each(remarks.missing, [](const MissingCell& missing) {
                 return json{{"cell", missing.cell}, {"on", missing.on}, {"lacking", missing.lacking}};
             })}};
}

}  // namespace

std::string machinesJson(const MachineComparison& comparison) {
    const MachineSet& set = comparison.set;
    json root{{"written", set.folders.front().writtenUtc}, {"version", buildFacts().version}, {"folders", set.labels}};
    root["machines"] = each(set.sides, [](const MachineSide& side) {
        return json{{"label", side.label}, {"folder", side.folder}, {"software", isSoftware(side)}};
    });
    root["hardware"] = each(comparison.hardware, [](const HardwareRow& row) {
        return json{{"name", row.name}, {"values", row.values}, {"differs", row.differs()}};
    });
    root["remarks"] = remarksJson(comparison.remarks);
    root["experiments"] = each(comparison.experiments, experimentJson);
    root["claims"] = each(comparison.claims, claimsJson);
    json papers = json::object();
    for (const ReportData& folder : set.folders)
        for (const Paper& paper : folder.papers) papers[paper.id] = paper.title;
    root["papers"] = std::move(papers);
    root["facts"] = each(methodFacts(), [](const MethodFact& fact) {
        return json{{"name", fact.info.name}, {"unit", fact.info.unit}};
    });
    return scriptSafe(root);
}

}  // namespace dustbench::bench
