#include "bench/suite/side_by_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bench/results/compared_runs.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"

namespace dustbench::suite {
namespace {

struct Variant {
    const MethodInfo* method;
    results::ParameterTexts own;
};

Variant parseVariant(const std::string& text) {
    const std::size_t colon = text.find(':');
    Variant variant{&findMethod(text.substr(0, colon)), {}};
    for (std::size_t begin = colon; begin != std::string::npos;) {
        const std::size_t end = text.find(',', ++begin);
        const std::string word = text.substr(begin, end == std::string::npos ? end : end - begin);
        begin = end;
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0)
            throw InputError(fmt::format("compare: got '{}', expected METHOD or METHOD:name=value,name=value", text));
        const std::string name = word.substr(0, equals);
        if (world::worldParameters().find(name))
            throw InputError(
                fmt::format("compare: got '{}', but {} belongs to the world, which all methods share: set "
                            "it with -P",
                            text, name));
        if (!variant.own.emplace(name, word.substr(equals + 1)).second)
            throw InputError(fmt::format("compare: got '{}', which sets {} twice", text, name));
    }
    return variant;
}

/// Throws for a parameter that neither a method nor the world has.
void requireKnown(const results::ParameterTexts& given, const std::vector<Variant>& variants) {
    for (const auto& [name, value] : given) {
        if (world::worldParameters().find(name)) continue;
        if (std::ranges::any_of(variants, [&](const Variant& v) { return v.method->parameters.find(name); })) continue;
        (void)results::resolveParameters(*variants.front().method, {{name, value}});  // throws
    }
}

}  // namespace

Suite sideBySideSuite(const std::vector<std::string>& variants, const results::ParameterTexts& given,
                      const results::RunSpec& base, int repetitions) {
    if (variants.size() < 2)
        throw InputError(fmt::format("compare: got {} method, allowed: 2 or more", variants.size()));
    std::vector<Variant> parsed;
    parsed.reserve(variants.size());
    for (const std::string& text : variants) parsed.push_back(parseVariant(text));
    requireKnown(given, parsed);

    Suite suite;
    suite.id = "compare";
    suite.repetitions = repetitions;
    suite.baseline = true;
    std::set<std::string> seen;
    std::vector<ComparedSide> sides;
    for (std::size_t i = 0; i < parsed.size(); ++i) {
        const auto& [method, own] = parsed[i];
        results::ParameterTexts values = own;
        for (const auto& [name, value] : given)
            if (world::worldParameters().find(name) || method->parameters.find(name)) values.emplace(name, value);
        PlannedRun cell{base, ""};
        cell.spec.method = method->id;
        cell.spec.parameters = results::canonicalParameters(*method, values);
        if (!cell.spec.metricPlan) cell.spec.metricPlan.emplace();
        results::requireFramesWithinRun(cell.spec);
        for (const auto& [name, value] : own)
            cell.label += (cell.label.empty() ? "" : " ") + name + "=" + cell.spec.parameters.at(name);
        if (!seen.insert(results::runId(cell.spec)).second)
            throw InputError(
                fmt::format("compare: got '{}' twice, expected different methods or parameters", variants[i]));
        sides.push_back({method->id, cell.spec.parameters, method->id + (cell.label.empty() ? "" : " " + cell.label)});
        suite.title += (i ? ", " : "") + sides.back().label;
        suite.cells.push_back(std::move(cell));
    }
    for (std::size_t i = 1; i < sides.size(); ++i) {
        PlannedComparison comparison{sides[i], sides.front(), {"frame_ms_median"}, ""};
        if (sides[i].method != results::baselineMethod && sides.front().method != results::baselineMethod)
            comparison.columns.emplace_back("method_ms_median");
        suite.comparisons.push_back(std::move(comparison));
    }
    return suite;
}

}  // namespace dustbench::suite
