#include "bench/report/machines/machine_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/export/whole_file.h"
#include "bench/measure/provenance.h"
#include "bench/report/json_parts.h"
#include "bench/report/page.h"
#include "bench/report/report_files.h"
#include "bench/results/method_facts.h"
#include "bench/suite/catalogue.h"
#include "methods/contract/choices.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::report {
namespace {

namespace fs = std::filesystem;

std::string titleOf(const MachineSet& set) {
    return fmt::format("dustbench: {}", fmt::join(set.labels, ", "));
}

void requireOtherFolder(const fs::path& file, const MachineSet& set) {
    for (const ReportData& data : set.folders) {
        std::error_code none;
        if (fs::equivalent(file.parent_path(), data.folder, none) && file.filename() == "index.html")
            throw InputError(
                fmt::format("--out: got '{}', where that folder's own report is; expected another "
                            "folder or file",
                            data.folder));
    }
}

constexpr Choices<Agreement> agreementTexts{{"agree", Agreement::agree},
                                            {"agree, by different factors", Agreement::factor},
                                            {"differ", Agreement::differ},
                                            {"open", Agreement::open},
                                            {"one machine only", Agreement::alone}};

using nlohmann::json;

/// `[ratio, low, high, pairs, verdict, reason]`; null: not measured.
json sideJson(const SideRatio& side) {
    if (side.result.pairs == 0 && side.reason == "not measured") return nullptr;
    return {number(side.result.ratio),
            number(side.result.low),
            number(side.result.high),
            side.result.pairs,
            measure::verdictName(side.result.verdict),
            side.reason};
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
    claim["folders"] = each(shared.folders, [](const claims::EvaluatedClaim* evaluated) {
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

MachineComparison comparisonOf(MachineSet set) {
    MachineComparison comparison{
        .set = std::move(set), .cells = {}, .remarks = {}, .hardware = {}, .experiments = {}, .claims = {}};
    comparison.cells = cellsOf(comparison.set);
    comparison.remarks = remarksOn(comparison.set, comparison.cells);
    comparison.hardware = hardwareTable(comparison.set);
    comparison.experiments = compareMachines(comparison.set, comparison.cells);
    comparison.claims = sharedClaims(comparison.set);
    return comparison;
}

std::string machinesPage(const MachineComparison& comparison) {
    return filled(reportFile("machines/page.html"), {{"title", escaped(titleOf(comparison.set))},
                                                     {"style", reportFile("page.css")},
                                                     {"machines-style", reportFile("machines/page.css")},
                                                     {"vega", vegaScript()},
                                                     {"columns", reportColumns()},
                                                     {"charts", chartSpecifications({"charts", "machines/charts"})},
                                                     {"data", machinesJson(comparison)},
                                                     {"licence", escaped(vegaLicence())},
                                                     {"script", machinesScript()}});
}

fs::path writeMachinesPage(const fs::path& out, const MachineComparison& comparison) {
    const fs::path file = out.extension() == ".html" ? out : out / "index.html";
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    requireOtherFolder(folder / file.filename(), comparison.set);
    requireOwnPage(folder, file.filename().string());
    const std::string page = machinesPage(comparison);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) files::failWriting(folder.string(), error.value());
    exports::writeWhole(file, page);
    return file;
}

std::string_view agreementText(Agreement agreement) {
    return agreementTexts.wordOf(agreement);
}

Agreement agreementOf(const std::vector<SideRatio>& sides) {
    std::vector<const measure::PairedRatio*> measured;
    std::set<measure::Verdict> resolved;
    for (const SideRatio& side : sides) {
        if (side.result.pairs == 0) continue;
        measured.push_back(&side.result);
        if (side.result.verdict != measure::Verdict::unresolved) resolved.insert(side.result.verdict);
    }
    if (measured.size() < 2) return Agreement::alone;
    if (resolved.size() > 1) return Agreement::differ;
    if (std::ranges::any_of(
            measured, [](const measure::PairedRatio* one) { return one->verdict == measure::Verdict::unresolved; }))
        return Agreement::open;
    for (const measure::PairedRatio* a : measured)
        for (const measure::PairedRatio* b : measured)
            if (a->low > b->high) return Agreement::factor;
    return Agreement::agree;
}

Agreement agreementOf(const std::vector<claims::ClaimVerdict>& verdicts) {
    std::set<claims::ClaimVerdict> decided;
    std::size_t tested = 0, open = 0;
    for (const claims::ClaimVerdict verdict : verdicts) {
        if (verdict == claims::ClaimVerdict::notTested) continue;
        ++tested;
        if (verdict == claims::ClaimVerdict::unresolved || verdict == claims::ClaimVerdict::untestable)
            ++open;
        else
            decided.insert(verdict);
    }
    if (tested < 2) return Agreement::alone;
    if (decided.size() > 1) return Agreement::differ;
    return open > 0 ? Agreement::open : Agreement::agree;
}

const claims::EvaluatedClaim& SharedClaim::any() const {
    return **std::ranges::find_if(folders, [](const claims::EvaluatedClaim* claim) { return claim != nullptr; });
}

std::vector<SharedClaim> sharedClaims(const MachineSet& set) {
    std::vector<SharedClaim> claims;
    for (std::size_t folder = 0; folder < set.folders.size(); ++folder)
        for (const claims::EvaluatedClaim& evaluated : set.folders[folder].claims) {
            auto found = std::ranges::find_if(claims, [&](const SharedClaim& known) {
                return known.any().paper == evaluated.paper && known.any().claim.id == evaluated.claim.id;
            });
            if (found == claims.end()) {
                claims.push_back({std::vector<const claims::EvaluatedClaim*>(set.folders.size(), nullptr), {}});
                found = std::prev(claims.end());
            }
            found->folders[folder] = &evaluated;
        }
    for (SharedClaim& claim : claims) {
        std::vector<claims::ClaimVerdict> verdicts;
        for (const claims::EvaluatedClaim* evaluated : claim.folders)
            if (evaluated) verdicts.push_back(evaluated->result.verdict);
        claim.agreement = agreementOf(verdicts);
    }
    std::ranges::stable_sort(claims, {}, [](const SharedClaim& claim) { return claim.any().paper; });
    return claims;
}

std::string machinesJson(const MachineComparison& comparison) {
    const MachineSet& set = comparison.set;
    json root{{"written", set.folders.front().writtenUtc},
              {"version", measure::buildFacts().version},
              {"folders", set.labels}};
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
        for (const suite::Paper& paper : folder.papers) papers[paper.id] = paper.title;
    root["papers"] = std::move(papers);
    root["facts"] = each(results::methodFacts(), [](const results::MethodFact& fact) {
        return json{{"name", fact.info.name}, {"unit", fact.info.unit}};
    });
    return scriptSafe(root);
}

}  // namespace dustbench::report
