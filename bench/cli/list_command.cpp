// `dustbench list`: the methods, scenes and other things that this build and its data provide.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "bench/cli/commands.h"
#include "bench/cli/suite_report.h"
#include "bench/suite/catalogue.h"
#include "bench/suite/method_libraries.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/particles/part_toml.h"

namespace dustbench::cli {
namespace {

struct ListOptions {
    std::string what;
    std::string id;
    bool json = false;
    bool ids = false;
};

void printParameters(const std::vector<Parameter>& parameters) {
    for (const Parameter& parameter : parameters) {
        std::string value = parameter.name + "=" + parameter.initial;
        std::cout << fmt::format("      -P {:<24} {}  ({}{})\n", value, parameter.help, parameter.allowed(),
                                 parameter.unit.empty() ? "" : " " + parameter.unit);
    }
}

/// In file syntax: `direction = [0, 1, 0]`.
void printKeys(const std::vector<Parameter>& keys) {
    for (const Parameter& key : keys) {
        const std::string value = key.name + " = " + particles::valueToToml(key, key.initial);
        std::cout << fmt::format("      {:<27} {}  ({}{})\n", value, key.help, key.allowed(),
                                 key.unit.empty() ? "" : " " + key.unit);
    }
}

void printItem(const suite::CatalogueItem& item, bool inDetail) {
    std::cout << fmt::format("  {:<20} {}\n", item.id, item.title);
    if (!item.summary.empty()) std::cout << fmt::format("  {:<20} {}\n", "", item.summary);
    if (!item.origin.empty()) std::cout << fmt::format("  {:<20} from {}\n", "", item.origin);
    if (!inDetail) return;
    if (item.kind == "methods") printParameters(item.parameters);
    if (item.kind == "parts") {
        if (!item.source.empty()) std::cout << fmt::format("  {:<20} Source: {}\n", "", item.source);
        printKeys(item.parameters);
    }
}

void printRefusedLibraries() {
    for (const suite::MethodLibrary& library : suite::methodLibraries())
        if (!library.whyNot.empty())
            std::cout << files::printable(fmt::format("  {:<20} {} is not loaded: {}", library.id,
                                                      library.file.string(), library.whyNot))
                      << '\n';
}

int list(const ListOptions& options) {
    if (options.ids && options.json) throw InputError("--ids: got --json as well, allowed: one of them");
    if (!options.what.empty()) {
        const std::vector<std::string>& kinds = suite::catalogueKinds();
        if (std::ranges::find(kinds, options.what) == kinds.end()) throw unknownName("list", options.what, kinds);
    }
    std::vector<suite::CatalogueItem> all;
    for (const std::string& kind : suite::catalogueKinds()) {
        if (!options.what.empty() && options.what != kind) continue;
        std::vector<suite::CatalogueItem> items = suite::catalogue(kind);
        if (!options.id.empty()) items = {suite::findItem(kind, items, options.id)};
        if (options.ids) {
            for (const suite::CatalogueItem& item : items) std::cout << item.id << '\n';
        } else if (!options.json) {
            std::cout << kind << ":\n";
            for (const suite::CatalogueItem& item : items) printItem(item, !options.what.empty());
            if (kind == "suites" && !options.id.empty()) std::cout << describeSuite(options.id);
            const bool ofLibraries = kind == "methods" || (kind == "parts" && !options.what.empty());
            if (ofLibraries && options.id.empty()) printRefusedLibraries();
            if (kind == "methods" && !options.what.empty() && options.id.empty()) {
                std::cout << "parameters of the world, available with every method:\n";
                printParameters(suite::worldParameterList());
            }
        }
        all.insert(all.end(), items.begin(), items.end());
    }
    if (options.json) std::cout << suite::catalogueJson(all);
    return exitOk;
}

}  // namespace

Command listCommand() {
    auto options = std::make_shared<ListOptions>();
    return {
        "list", "List methods, scenes, drives, suites, experiments, metrics and parts of particle systems",
        "`dustbench list methods` shows every parameter that -P sets, with its default and allowed values. `dustbench "
        "list parts` documents the files of data/particles, which define particle systems: `size/linear` is a table "
        "[size] with part = \"linear\" and any of the keys shown. There may be several of life, shading, force and "
        "event: "
        "[[force]].",
        [options](Arguments& arguments) {
            arguments.text("what", fmt::format("{}", fmt::join(suite::catalogueKinds(), "|")), "default: all",
                           options->what);
            arguments.text("id", "", "only this one", options->id);
            arguments.flag("--ids", "print only ids, one per line", options->ids);
            arguments.flag("--json", "print JSON: an array of objects with `id`", options->json);
        },
        [options] { return list(*options); }};
}

}  // namespace dustbench::cli
