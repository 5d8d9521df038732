#include "bench/suite/regression/folder_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include "bench/results/compared_runs.h"

namespace dustbench::suite {
namespace {

std::optional<double> asNumber(const std::string& text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [at, error] = std::from_chars(text.data(), end, number);
    if (text.empty() || error != std::errc() || at != end) return std::nullopt;
    return number;
}

/// Numbers sort before texts, which makes the order total.
bool valueLess(const std::string& a, const std::string& b) {
    const auto x = asNumber(a), y = asNumber(b);
    if (x && y && *x != *y) return *x < *y;
    if (x.has_value() != y.has_value()) return x.has_value();
    return a < b;
}

/// Sets aside runs that are the same measurement in both folders.
void setCopiesAside(FolderCell& cell) {
    std::erase_if(cell.a.done, [&cell](const results::StoredRun* mine) {
        const auto theirs = std::ranges::find_if(
            cell.b.done, [mine](const results::StoredRun* run) { return results::areOneMeasurement(*mine, *run); });
        if (theirs == cell.b.done.end()) return false;
        cell.a.copied.push_back(mine);
        cell.b.copied.push_back(*theirs);
        cell.b.done.erase(theirs);
        return true;
    });
}

}  // namespace

bool identityLess(const CellIdentity& a, const CellIdentity& b) {
    return std::ranges::lexicographical_compare(a, b, [](const auto& x, const auto& y) {
        return x.first != y.first ? x.first < y.first : valueLess(x.second, y.second);
    });
}

void add(CellRuns& runs, const results::StoredRun& run) {
    switch (run.status) {
        case results::RunStatus::done:
            (results::whyInvalid(run).empty() ? runs.done : runs.invalid).push_back(&run);
            break;
        case results::RunStatus::skipped:
            runs.skipped.push_back(&run);
            break;
        case results::RunStatus::failed:
        case results::RunStatus::timeout:
            runs.failed.push_back(&run);
            break;
    }
}

std::string valueOf(const CellIdentity& identity, const std::string& name) {
    const auto found = std::ranges::find(identity, name, &CellIdentity::value_type::first);
    return found == identity.end() ? std::string() : found->second;
}

CellIdentity identityOf(const results::StoredRun& run) {
    static const std::set<std::string> leftOut{"repetition", "metrics", "metric_reference", "metric_pictures"};
    CellIdentity identity = results::keyFields(run);
    std::erase_if(identity, [](const auto& field) { return leftOut.contains(field.first); });
    return identity;
}

std::vector<FolderCell> cellsOf(const ResultsSide& a, const ResultsSide& b) {
    std::map<CellIdentity, FolderCell, decltype(&identityLess)> cells(&identityLess);
    for (const auto& [side, runs] : {std::pair(&a, &FolderCell::a), std::pair(&b, &FolderCell::b)})
        for (const auto& [id, run] : side->runs) {
            CellIdentity identity = identityOf(run);
            FolderCell& cell = cells[identity];
            cell.identity = std::move(identity);
            add(cell.*runs, run);
        }
    std::vector<FolderCell> list;
    list.reserve(cells.size());
    for (auto& [identity, cell] : cells) {
        setCopiesAside(cell);
        list.push_back(std::move(cell));
    }
    return list;
}

std::vector<std::string> distinguishingNames(const std::vector<FolderCell>& cells) {
    std::vector<CellIdentity> identities;
    identities.reserve(cells.size());
    for (const FolderCell& cell : cells) identities.push_back(cell.identity);
    return distinguishingNames(identities);
}

std::vector<std::string> distinguishingNames(const std::vector<CellIdentity>& cells) {
    std::vector<std::string> order;
    std::map<std::string, std::map<std::string, std::set<std::string>>> valuesByMethod;  // values of each name
    std::map<std::string, std::size_t> cellsByMethod;
    std::map<std::string, std::map<std::string, std::size_t>> holders;
    for (const CellIdentity& identity : cells) {
        const std::string method = valueOf(identity, "method");
        ++cellsByMethod[method];
        for (const auto& [name, value] : identity) {
            if (!valuesByMethod.contains(name)) order.push_back(name);
            valuesByMethod[name][method].insert(value);
            ++holders[name][method];
        }
    }
    std::erase_if(order, [&](const std::string& name) {
        return std::ranges::all_of(valuesByMethod[name], [&](const auto& entry) {
            return entry.second.size() == 1 && holders[name][entry.first] == cellsByMethod[entry.first];
        });
    });
    return order;
}

std::string labelOf(const FolderCell& cell, const std::vector<std::string>& distinguishingNames) {
    return labelOf(cell.identity, distinguishingNames);
}

std::string labelOf(const CellIdentity& identity, const std::vector<std::string>& distinguishingNames) {
    std::string label = valueOf(identity, "method");
    for (const std::string& name : distinguishingNames)
        if (const std::string value = valueOf(identity, name); !value.empty())
            label += fmt::format(" {}={}", name.starts_with("p.") ? name.substr(2) : name, value);
    return label;
}

}  // namespace dustbench::suite
