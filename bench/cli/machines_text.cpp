#include "bench/cli/machines_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "bench/cli/text_table.h"
#include "bench/suite/suite_table.h"
#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

using bench::MachineComparison;
using bench::MachineExperiment;
using bench::PairedRatio;

/// Longer lists end with the number of further items.
constexpr std::size_t namedCells = 20;

/// Shortens values that do not fit into a column.
std::string shortened(const std::string& text) {
    constexpr std::size_t longest = 60;
    return files::printable(text, longest);
}

std::vector<std::string> heads(std::vector<std::string> first, const std::vector<std::string>& labels,
                               std::vector<std::string> last = {}) {
    first.insert(first.end(), labels.begin(), labels.end());
    first.insert(first.end(), last.begin(), last.end());
    return first;
}

std::vector<std::string> labelsOf(const MachineComparison& comparison) {
    std::vector<std::string> labels;
    labels.reserve(comparison.set.sides.size());
    for (const bench::MachineSide& side : comparison.set.sides) labels.push_back(side.label);
    return labels;
}

std::string hardwareText(const MachineComparison& comparison) {
    std::vector<std::vector<std::string>> rows{heads({""}, labelsOf(comparison))};
    for (const bench::HardwareRow& row : comparison.hardware) {
        rows.push_back({row.name});
        for (const std::string& value : row.values) rows.back().push_back(shortened(value.empty() ? "unknown" : value));
    }
    return textTable(rows);
}

std::string listOf(const std::string& head, const std::vector<std::string>& sentences) {
    if (sentences.empty()) return "";
    std::string text = "\n" + head + "\n";
    for (const std::string& sentence : sentences) text += "  " + files::printable(sentence) + "\n";
    return text;
}

std::vector<std::string> missingCells(const MachineComparison& comparison) {
    std::vector<std::string> sentences;
    for (const bench::MissingCell& missing : comparison.remarks.missing) {
        if (sentences.size() == namedCells) {
            sentences.push_back(fmt::format("and {} more", comparison.remarks.missing.size() - namedCells));
            break;
        }
        std::vector<std::string> lacking;
        lacking.reserve(missing.lacking.size());
        for (const auto& [side, why] : missing.lacking)
            lacking.push_back(fmt::format("{} on {}", why, comparison.set.sides[side].label));
        sentences.push_back(fmt::format("{}: {}", missing.cell, fmt::join(lacking, "; ")));
    }
    return sentences;
}

/// Ratios far from 1 have three significant digits.
std::string digits(double ratio) {
    return std::isfinite(ratio) && (ratio < 0.1 || ratio >= 1e5) ? fmt::format("{:.3g}", ratio)
                                                                 : bench::fourDigits(ratio);
}

/// `0.812 [0.79, 0.83] FASTER`
std::string ratioText(const bench::SideRatio& side, bool invert) {
    const PairedRatio ratio = invert ? bench::inverted(side.result) : side.result;
    if (ratio.pairs == 0) return side.reason;
    if (ratio.pairs == 1) return fmt::format("{} (one run)", digits(ratio.ratio));
    return fmt::format("{} [{}, {}] {}", digits(ratio.ratio), digits(ratio.low), digits(ratio.high),
                       verdictName(ratio.verdict));
}

std::string experimentText(const MachineComparison& comparison, const MachineExperiment& experiment) {
    std::vector<std::vector<std::string>> rows;
    const auto addRow = [&](const bench::MachineRatio& ratio, const std::string& world, const bench::RatioRow& row) {
        const bool invert = ratio.of == experiment.reference;
        std::vector<std::string> cells{ratio.column, experiment.variants[invert ? ratio.with : ratio.of].label, world};
        for (const bench::SideRatio& side : row.sides) cells.push_back(ratioText(side, invert));
        cells.emplace_back(agreementText(bench::agreementOf(row.sides)));
        rows.push_back(std::move(cells));
    };
    for (const bench::MachineRatio& ratio : experiment.ratios) {
        if (ratio.of != experiment.reference && ratio.with != experiment.reference) continue;
        for (const bench::RatioRow& row : ratio.worlds) addRow(ratio, worldLabel(experiment, row.world), row);
        if (ratio.worlds.size() > 1) addRow(ratio, fmt::format("all {} in common", ratio.common), ratio.all);
    }
    if (rows.empty())
        return fmt::format("\n{}: no ratio: no world has times of two methods or settings\n",
                           files::printable(experiment.title));
    rows.insert(rows.begin(), heads({"column", "of", "at"}, labelsOf(comparison), {"machines"}));
    return fmt::format("\n{}\nratio of times to those of {}, within each machine, 95 % interval over paired runs\n{}",
                       files::printable(experiment.title),
                       files::printable(experiment.variants[experiment.reference].label), textTable(rows));
}

std::string claimsText(const MachineComparison& comparison) {
    if (comparison.claims.empty()) return "";
    std::vector<std::vector<std::string>> rows{heads({"paper", "id"}, comparison.set.labels, {"machines", "claim"})};
    for (const bench::SharedClaim& claim : comparison.claims) {
        rows.push_back({claim.any().paper, claim.any().claim.id});
        for (const bench::EvaluatedClaim* evaluated : claim.folders)
            rows.back().push_back(evaluated ? verdictText(*evaluated) : "–");
        rows.back().emplace_back(agreementText(claim.agreement));
        rows.back().push_back(shortened(claim.any().claim.text));
    }
    return "\nclaims\n" + textTable(rows);
}

}  // namespace

std::string machinesText(const MachineComparison& comparison) {
    const bench::MachineRemarks& remarks = comparison.remarks;
    std::string text = hardwareText(comparison);
    text += listOf("cannot be compared", remarks.apart);
    text += listOf("the programs differ, so ratios may differ for reasons other than the machines", remarks.programs);
    text += listOf("notes", remarks.notes);
    text += listOf("missing configurations", missingCells(comparison));
    for (const MachineExperiment& experiment : comparison.experiments) text += experimentText(comparison, experiment);
    return text + claimsText(comparison);
}

}  // namespace dustbench::cli
