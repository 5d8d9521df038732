#include "bench/claims/claim.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "bench/results/summary.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::claims {
namespace {

constexpr Choices<Chance> chances{
    {"repetitions", Chance::repetitions}, {"seeds", Chance::seeds}, {"none", Chance::none}};
constexpr Choices<ControlOutcome> outcomes{{"refuted", ControlOutcome::refuted},
                                           {"confirmed", ControlOutcome::confirmed}};

Selection selectionIn(files::TomlReader& table, const std::string& key) {
    return parseSelection(table.text(key), table.where(key) + "key '" + key + "'");
}

std::string readColumn(files::TomlReader& table, const std::string& key) {
    const std::string name = table.text(key);
    requireColumn(table.where(key), name);
    return name;
}

std::string columnOf(const std::string& name) {
    return name == "scene" || name == "drive" ? name : "p." + name;
}

bool needsAgainst(Quantity quantity) {
    return quantity == Quantity::matched || quantity == Quantity::growth || quantity == Quantity::trend ||
           quantity == Quantity::slopes || quantity == Quantity::exponent;
}

void readRange(files::TomlReader& table, Rule& rule) {
    constexpr double any = 1e300;
    if (table.has("min")) rule.minimum = table.number("min", -any, any);
    if (table.has("max")) rule.maximum = table.number("max", -any, any);
}

void requireRange(const Claim& claim) {
    const Rule& rule = claim.rule;
    if (!rule.minimum && !rule.maximum)
        throw InputError(claim.where + "claim " + claim.id + ": got neither 'min' nor 'max', expected one");
    if (rule.minimum && rule.maximum && *rule.minimum > *rule.maximum)
        throw InputError(claim.where + "claim " + claim.id + ": 'min' is above 'max'");
}

/// Reads the data of a rule. A key that is missing in the table keeps its value if `rule` already has one.
void readData(files::TomlReader& table, Rule& rule) {
    const auto wanted = [&](const char* key, bool missing) { return missing || table.has(key); };
    if (rule.quantity == Quantity::finding) {
        if (wanted("experiment", rule.experiment.empty()))
            rule.experiment = table.choice("experiment", suite::experimentNames());
        if (wanted("column", rule.column.empty())) rule.column = table.text("column");
        if (table.has("name")) rule.name = table.text("name");
        if (table.has("unit")) rule.unit = table.text("unit");
        return;
    }
    if (wanted("suite", rule.suite.empty())) rule.suite = table.text("suite");
    if (wanted("column", rule.column.empty())) rule.column = readColumn(table, "column");
    if (table.has("per")) rule.per = readColumn(table, "per");
    if (wanted("of", rule.of.empty())) rule.of = selectionIn(table, "of");
    if (rule.quantity == Quantity::matched && wanted("match", rule.match.empty()))
        rule.match = readColumn(table, "match");
    const bool isRatio = rule.quantity == Quantity::ratio || rule.quantity == Quantity::matched;
    if (isRatio && wanted("with", rule.with.empty())) rule.with = selectionIn(table, "with");
    if (needsAgainst(rule.quantity) && wanted("against", rule.against.empty()))
        rule.against = readColumn(table, "against");
    if (rule.quantity == Quantity::share && wanted("parts", rule.parts.empty())) {
        rule.parts = table.texts("parts");
        if (rule.parts.empty()) throw InputError(table.where("parts") + "key 'parts': got none, expected columns");
        for (const std::string& part : rule.parts) requireColumn(table.where("parts"), part);
    }
}

ControlRule readControl(files::TomlReader& table, const Rule& rule) {
    ControlRule control;
    control.rule = rule;
    control.why = table.text("why");
    control.gives = table.choice("gives", outcomes);
    readData(table, control.rule);
    table.finish();
    return control;
}

Claim readClaim(files::TomlReader& table) {
    Claim claim;
    claim.where = table.where();
    claim.id = table.text("id");
    claim.text = table.text("text");
    claim.rule.quantity = table.choice("quantity", quantityWords);
    if (claim.rule.quantity == Quantity::none) {
        claim.missing = table.text("missing");
        table.finish();
        return claim;
    }
    if (table.has("device")) claim.device = table.boolean("device", false);
    readData(table, claim.rule);
    if (claim.rule.quantity != Quantity::finding && table.has("over")) claim.rule.over = table.choice("over", chances);
    if (table.has("along")) claim.rule.along = readColumn(table, "along");
    readRange(table, claim.rule);
    requireRange(claim);
    claim.reason = table.text("reason");
    for (files::TomlReader& control : table.tables("control"))
        claim.controls.push_back(readControl(control, claim.rule));
    table.finish();
    return claim;
}

std::vector<Claim> readClaims(files::TomlReader file) {
    std::vector<Claim> claims;
    for (files::TomlReader& table : file.tables("claim")) {
        claims.push_back(readClaim(table));
        if (std::ranges::count(claims, claims.back().id, &Claim::id) > 1)
            throw InputError(claims.back().where + "claim " + claims.back().id + " appears twice");
    }
    file.finish();
    return claims;
}

/// Throws InputError unless the paper's paper.toml names the suite or experiment of the rule: `reproduce` runs no
/// other.
void requireMeasured(const Claim& claim, const Rule& rule, const suite::Paper& paper, bool ofControl) {
    std::vector<std::string> suites = paper.suites;
    if (ofControl) std::ranges::copy(paper.controls, std::back_inserter(suites));
    const auto require = [&](const char* kind, const std::string& name, const std::vector<std::string>& measured) {
        if (!name.empty() && std::ranges::find(measured, name) == measured.end())
            throw InputError(fmt::format("{}claim {}: the {} '{}' is not in the paper's paper.toml, which has {}",
                                         claim.where, claim.id, kind, name, fmt::join(measured, ", ")));
    };
    require("suite", rule.suite, suites);
    require("experiment", rule.experiment, paper.experiments);
}

}  // namespace

void requireColumn(const std::string& where, const std::string& name) {
    std::vector<std::string> known = results::columnsBeforeParameters();
    std::ranges::copy(results::columnsAfterParameters(), std::back_inserter(known));
    if (!name.starts_with("p.") && std::ranges::find(known, name) == known.end())
        throw InputError(where + unknownName("column of summary.csv", name, known).what());
}

Selection parseSelection(const std::string& text, const std::string& what) {
    Selection selection;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos && selection.empty())
            selection.emplace_back("method", word);
        else if (equals == std::string::npos || equals == 0)
            throw InputError(what + ": got '" + word + "', expected name=value");
        else
            selection.emplace_back(columnOf(word.substr(0, equals)), word.substr(equals + 1));
    }
    if (selection.empty()) throw InputError(what + ": got nothing, expected METHOD …");
    return selection;
}

std::vector<std::string> alternativesIn(const std::string& text) {
    std::vector<std::string> alternatives;
    std::istringstream stream(text);
    for (std::string each; std::getline(stream, each, '|');) alternatives.push_back(each);
    return alternatives;
}

std::string textOf(const Selection& selection) {
    std::string text;
    for (const auto& [column, value] : selection)
        text += (text.empty() ? "" : " ") + (column == "method" ? value : nameOf(column) + "=" + value);
    return text;
}

std::string nameOf(const std::string& column) {
    return column.starts_with("p.") ? column.substr(2) : column;
}

std::string Rule::expected() const {
    if (minimum && maximum) return fmt::format("{:g} to {:g}", *minimum, *maximum);
    if (minimum) return fmt::format("{:g} or more", *minimum);
    return maximum ? fmt::format("{:g} or less", *maximum) : "";
}

std::string Rule::textOf(double value) const {
    if (!std::isfinite(value)) return "";
    if (quantity == Quantity::value && per.empty() && column.ends_with("_bytes"))
        return fmt::format("{:.4g} MB", value / 1e6);
    // A few more digits are easier to read than a power of ten.
    return std::abs(value) >= 1e4 && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value)
                                                           : fmt::format("{:.4g}", value);
}

std::string Rule::inWords() const {
    const std::string what = per.empty() ? column : column + " per " + nameOf(per);
    switch (quantity) {
        case Quantity::ratio:
            return fmt::format("{} of {} over that of {}", what, claims::textOf(of), claims::textOf(with));
        case Quantity::matched:
            return fmt::format("{} of {} over that of {} with the same {}", what, claims::textOf(of),
                               claims::textOf(with), match);
        case Quantity::share:
            return fmt::format("({}) over {} of {}", fmt::join(parts, " + "), what, claims::textOf(of));
        case Quantity::growth:
            return fmt::format("{} of {} at the maximum of {} over that at the minimum", what, claims::textOf(of),
                               nameOf(against));
        case Quantity::trend:
            return fmt::format("rank correlation of {} with {}, {}", what, nameOf(against), claims::textOf(of));
        case Quantity::slopes:
            return fmt::format("slope of {} over {} in the upper half of the loads, over that in the lower half, {}",
                               what, nameOf(against), claims::textOf(of));
        case Quantity::exponent:
            return fmt::format("k of {} = a + b {}^k, {}", what, nameOf(against), claims::textOf(of));
        case Quantity::value:
            return fmt::format("{} of {}", what, claims::textOf(of));
        case Quantity::finding:
            return fmt::format("{} of the experiment {}", column, experiment);
        case Quantity::none:
            break;
    }
    return "";
}

std::vector<Claim> loadClaims(const std::string& paper) {
    const std::filesystem::path file = suite::paperFile(paper, "claims.toml");
    if (file.empty()) return {};
    std::vector<Claim> claims = readClaims(files::TomlReader::parseFile(file));
    const suite::Paper measured = suite::loadPaper(paper);
    for (const Claim& claim : claims) {
        requireMeasured(claim, claim.rule, measured, false);
        for (const ControlRule& control : claim.controls) requireMeasured(claim, control.rule, measured, true);
    }
    return claims;
}

std::vector<Claim> parseClaims(std::string_view text, const std::string& name) {
    return readClaims(files::TomlReader::parseText(text, name));
}

}  // namespace dustbench::claims
