#include "bench/suite/catalogue.h"

#include <fmt/format.h>

#include "bench/measure/image/metric.h"
#include "bench/results/method_facts.h"
#include "bench/results/run_record.h"
#include "bench/suite/suite.h"
#include "bench/world/data_list.h"
#include "bench/world/world.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/contract/stage_clock.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/particles/part.h"
#include "methods/kit/particles/part_toml.h"

namespace dustbench::suite {
namespace {

/// Measured quantities, by column of summary.csv; defined in reports/SCHEMA.md and METRICS.md.
std::vector<CatalogueItem> listMetrics() {
    std::vector<CatalogueItem> items;
    const auto add = [&items](const std::string& id, const std::string& title) {
        items.push_back({"metrics", id, title, "", ""});
    };
    add("fps_avg", "frames per second: frames·1000 / Σ frame_ms");
    add("frame_ms_median", "median time of a frame, ms");
    add("frame_ms_p95", "95th percentile of the frame times, ms");
    add("frame_ms_p99", "99th percentile of the frame times, ms");
    add("frame_ms_max", "longest frame, ms");
    add("fps_1pct_low", "frame rate of the slowest frames that make up 1 % of the time, 1/s");
    add("frame_ms_p999", "99.9th percentile of the frame times, ms");
    add("fps_01pct_low", "frame rate of the slowest frames that make up 0.1 % of the time, 1/s");
    add("frame_ms_min", "shortest frame, ms: for frames of equal work, the time without disturbance by the machine");
    for (const std::string_view stage : stageNames)
        add(fmt::format("{}_ms_median", stage), fmt::format("median time of the stage '{}', ms", stage));
    add("gpu_ms_median", "median GPU time of scene and drawing, where timer queries are reliable, ms");
    add("harness_us_median", "median time of a frame outside all stages: the overhead of the harness, µs");
    add("cpu_bytes", "maximum CPU memory of world and method, bytes");
    add("gpu_bytes", "maximum memory of all buffers and textures, bytes");
    add("rss_peak_bytes", "maximum resident set of the run's process, bytes");
    add("particles_median", "median number of dust particles");
    add("primitives_median", "median number of primitives that the method drew");
    for (const measure::Metric& metric : measure::metrics()) add(std::string(metric.column), std::string(metric.title));
    for (const results::MethodFact& fact : results::methodFacts())
        add(fact.info.name, fact.info.meaning + ", " + fact.info.unit);
    add("state_hash", "hash of vehicle and dust after the last frame (run.json)");
    add("method_hash", "hash of the method's own simulation after the last frame (run.json)");
    return items;
}

std::vector<CatalogueItem> listMethods() {
    std::vector<CatalogueItem> items;
    for (const MethodInfo& info : methods())
        items.push_back(
            {"methods", info.id, info.title, info.summary, info.source, info.parameters.all(), 0, info.library});
    return items;
}

std::vector<CatalogueItem> listExperiments() {
    std::vector<CatalogueItem> items;
    for (const ExperimentInfo& info : experiments())
        items.push_back({"experiments", info.id, info.summary, "in methods/" + info.folder, info.source});
    return items;
}

/// The tables available to particle systems in files of data/particles.
std::vector<CatalogueItem> listParts() {
    std::vector<CatalogueItem> items;
    for (const particles::PartInfo& info : particles::partTable())
        items.push_back({"parts", fmt::format("{}/{}", particles::kindName(info.kind), info.name), info.help, "",
                         info.source, particles::tableKeys(info.parameters), 0, info.library});
    return items;
}

std::vector<CatalogueItem> fromData(const std::string& kind, const std::vector<world::DataEntry>& entries) {
    std::vector<CatalogueItem> items;
    items.reserve(entries.size());
    for (const world::DataEntry& entry : entries)
        items.push_back({kind, entry.id, entry.description, "", "", {}, entry.panels});
    return items;
}

std::vector<CatalogueItem> listSuiteItems() {
    std::vector<CatalogueItem> items;
    for (const SuiteFile& suite : listSuites()) {
        files::TomlReader table = files::TomlReader::parseFile(suite.file);
        items.push_back({"suites", suite.id, table.text("title", ""), table.text("summary", ""), suite.paper});
    }
    return items;
}

}  // namespace

const std::vector<std::string>& catalogueKinds() {
    static const std::vector<std::string> kinds{"methods",     "scenes",  "drives", "suites",
                                                "experiments", "metrics", "parts"};
    return kinds;
}

std::vector<CatalogueItem> catalogue(const std::string& kind) {
    if (kind == "methods") return listMethods();
    if (kind == "scenes") return fromData(kind, world::listScenes());
    if (kind == "drives") return fromData(kind, world::listDrives());
    if (kind == "suites") return listSuiteItems();
    if (kind == "experiments") return listExperiments();
    if (kind == "parts") return listParts();
    if (kind != "metrics") throw unknownName("list", kind, catalogueKinds());
    return listMetrics();
}

CatalogueItem findItem(const std::string& kind, const std::vector<CatalogueItem>& items, const std::string& id) {
    std::vector<std::string> known;
    for (const CatalogueItem& item : items) {
        if (item.id == id) return item;
        known.push_back(item.id);
    }
    throw unknownName(kind.substr(0, kind.size() - 1), id, known);
}

const std::vector<Parameter>& worldParameterList() {
    return world::worldParameters().all();
}

std::string catalogueJson(const std::vector<CatalogueItem>& items) {
    std::vector<results::ListedItem> listed;
    for (const CatalogueItem& item : items) {
        results::ListedItem entry{{{"id", item.id}, {"kind", item.kind}, {"title", item.title}},
                                  item.parameters,
                                  item.kind == "methods" || item.kind == "parts"};
        if (item.kind == "parts") {
            const std::size_t slash = item.id.find('/');
            entry.cells.emplace_back("part_kind", item.id.substr(0, slash));
            entry.cells.emplace_back("part", item.id.substr(slash + 1));
        }
        if (item.kind == "scenes") entry.cells.emplace_back("panels", item.panels);
        if (!item.summary.empty()) entry.cells.emplace_back("summary", item.summary);
        if (!item.source.empty()) entry.cells.emplace_back(item.kind == "suites" ? "paper" : "source", item.source);
        if (!item.origin.empty()) entry.cells.emplace_back("origin", item.origin);
        listed.push_back(std::move(entry));
    }
    return results::listToJson(listed);
}

}  // namespace dustbench::suite
