#include "bench/claims/claim.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "bench/claims/experiments.h"
#include "bench/results/summary.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::bench {
namespace {

constexpr Choices<Quantity> quantities{{"none", Quantity::none},         {"ratio", Quantity::ratio},
                                       {"share", Quantity::share},       {"growth", Quantity::growth},
                                       {"exponent", Quantity::exponent}, {"value", Quantity::value},
                                       {"finding", Quantity::finding}};

Selection selectionIn(files::TomlReader& table, const std::string& key) {
    return parseSelection(table.text(key), table.where(key) + "key '" + key + "'");
}

std::string readColumn(files::TomlReader& table, const std::string& key) {
    const std::string name = table.text(key);
    requireColumn(table.where(key), name);
    return name;
}

void readRange(files::TomlReader& table, Claim& claim) {
    constexpr double any = 1e300;
    if (table.has("min")) claim.minimum = table.number("min", -any, any);
    if (table.has("max")) claim.maximum = table.number("max", -any, any);
    if (!claim.minimum && !claim.maximum)
        throw InputError(claim.where + "claim " + claim.id + ": got neither 'min' nor 'max', expected one");
    if (claim.minimum && claim.maximum && *claim.minimum > *claim.maximum)
        throw InputError(claim.where + "claim " + claim.id + ": 'min' is above 'max'");
}

Claim readClaim(files::TomlReader& table) {
    Claim claim;
    claim.where = table.where();
    claim.id = table.text("id");
    claim.text = table.text("text");
    claim.quantity = table.choice("quantity", quantities);
    if (claim.quantity == Quantity::none) {
        claim.missing = table.text("missing");
        table.finish();
        return claim;
    }
    if (claim.quantity == Quantity::finding) {
        claim.experiment = table.choice("experiment", experimentNames());
        claim.column = table.text("column");
        readRange(table, claim);
        table.finish();
        return claim;
    }
    claim.suite = table.text("suite");
    claim.column = readColumn(table, "column");
    if (table.has("per")) claim.per = readColumn(table, "per");
    claim.of = selectionIn(table, "of");
    claim.exact = table.boolean("exact", false);
    if (claim.quantity == Quantity::ratio) claim.with = selectionIn(table, "with");
    if (claim.quantity == Quantity::share) {
        claim.parts = table.texts("parts");
        if (claim.parts.empty()) throw InputError(table.where("parts") + "key 'parts': got none, expected columns");
        for (const std::string& part : claim.parts) requireColumn(table.where("parts"), part);
    }
    if (claim.quantity == Quantity::growth || claim.quantity == Quantity::exponent)
        claim.against = readColumn(table, "against");
    readRange(table, claim);
    table.finish();
    return claim;
}

std::vector<Claim> readClaims(files::TomlReader file) {
    std::vector<Claim> claims;
    for (files::TomlReader& table : file.tables("claim")) {
        claims.push_back(readClaim(table));
        if (std::ranges::count(claims, claims.back().id, &Claim::id) > 1)
            throw InputError(claims.back().where + "claim " + claims.back().id + ": is there twice");
    }
    file.finish();
    return claims;
}

}  // namespace

void requireColumn(const std::string& where, const std::string& name) {
    std::vector<std::string> known = columnsBeforeParameters();
    std::ranges::copy(columnsAfterParameters(), std::back_inserter(known));
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
            selection.emplace_back("p." + word.substr(0, equals), word.substr(equals + 1));
    }
    if (selection.empty()) throw InputError(what + ": got nothing, expected METHOD …");
    return selection;
}

std::string Claim::expected() const {
    if (minimum && maximum) return fmt::format("{:g} to {:g}", *minimum, *maximum);
    if (minimum) return fmt::format("{:g} or more", *minimum);
    return maximum ? fmt::format("{:g} or less", *maximum) : "";
}

std::vector<Claim> loadClaims(const std::string& paper) {
    const std::filesystem::path file = paperFile(paper, "claims.toml");
    if (file.empty()) return {};
    return readClaims(files::TomlReader::parseFile(file));
}

std::vector<Claim> parseClaims(std::string_view text, const std::string& name) {
    return readClaims(files::TomlReader::parseText(text, name));
}

}  // namespace dustbench::bench
