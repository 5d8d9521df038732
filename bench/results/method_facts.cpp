#include "bench/results/method_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "methods/contract/registry.h"

namespace dustbench::results {

const std::vector<MethodFact>& methodFacts() {
    static const std::vector<MethodFact> all = [] {
        std::map<std::string, MethodFact> byName;
        for (const MethodInfo& method : methods())
            for (const FactInfo& info : method.facts) {
                MethodFact& fact = byName.try_emplace(info.name, MethodFact{info, {}}).first->second;
                if (fact.info != info)
                    throw std::logic_error("methods " + fact.methods.front() + " and " + method.id +
                                           " declare the fact '" + info.name + "' with different definitions");
                fact.methods.push_back(method.id);
            }
        std::vector<MethodFact> list;
        list.reserve(byName.size());
        for (auto& [name, fact] : byName) list.push_back(std::move(fact));
        return list;
    }();
    return all;
}

namespace {

std::optional<double> numberIn(const Columns& columns, const std::string& name) {
    const auto found = std::ranges::find(columns, name, [](const auto& column) { return column.first; });
    if (found == columns.end()) return std::nullopt;
    if (const auto* whole = std::get_if<std::int64_t>(&found->second)) return static_cast<double>(*whole);
    if (const auto* number = std::get_if<double>(&found->second)) return *number;
    return std::nullopt;
}

std::string allowed(const ValidRange& range) {
    if (!std::isfinite(range.minimum)) return fmt::format("up to {:g}", range.maximum);
    if (!std::isfinite(range.maximum)) return fmt::format("{:g} or more", range.minimum);
    return fmt::format("{:g}..{:g}", range.minimum, range.maximum);
}

}  // namespace

std::vector<std::string> whyInvalid(const MethodInfo& method, const Columns& facts, const DustCount& dust) {
    std::vector<std::string> reasons;
    for (const FactInfo& fact : method.facts)
        if (const auto value = numberIn(facts, fact.name); value && !fact.valid.contains(*value))
            reasons.push_back(fmt::format("{} is {:.4g}, allowed: {}", fact.name, *value, allowed(fact.valid)));
    const auto asked = static_cast<double>(dust.asked);
    if (dust.asked > 0 && dust.isShown &&
        !(std::abs(dust.medianOfFrames - asked) <= countDeviations * std::sqrt(asked)))
        reasons.push_back(fmt::format("particles_median is {:g}, requested: {}", dust.medianOfFrames, dust.asked));
    return reasons;
}

}  // namespace dustbench::results
