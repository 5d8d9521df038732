#include "bench/suite/suite_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

#include "bench/export/exporter.h"
#include "bench/suite/value_list.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/limits.h"

namespace dustbench::suite {
namespace {

constexpr std::int64_t maximumFrames = 10'000'000;
constexpr std::int64_t maximumRepetitions = files::limits::repetitions;

[[nodiscard]] InputError at(const std::string& where, const InputError& error) {
    return InputError(where + error.what());
}

/// The path as seen from the working directory: paths in a suite's file are relative to the file.
std::string usable(const SuiteDraft& draft, const std::string& parameter, const std::string& value) {
    for (const std::string& id : draft.methods)
        if (const Parameter* declared = findMethod(id).parameters.find(parameter);
            declared && !declared->fileExtension.empty())
            return files::fromFile(draft.file, value, declared->fileExtension);
    return value;
}

std::vector<std::string> readValues(const SuiteDraft& draft, files::TomlReader& table, const std::string& name) {
    try {
        std::vector<std::string> values;
        for (const std::string& text : table.scalars(name))
            for (const std::string& value : expandValues(name, text)) values.push_back(usable(draft, name, value));
        if (values.empty()) throw InputError("parameter " + name + ": no values");
        return values;
    } catch (const InputError& error) {
        const std::string message = error.what();
        throw message.starts_with(table.where(name)) ? error : at(table.where(name), error);
    }
}

/// Checks that each method allows every value; errors name this line.
void readParameters(const SuiteDraft& draft, files::TomlReader& table, const std::vector<std::string>& methodIds,
                    ParameterLists& lists) {
    for (const std::string& name : table.keys()) {
        const std::vector<std::string> values = readValues(draft, table, name);
        for (const std::string& id : methodIds) try {
                for (const std::string& value : values)
                    (void)results::resolveParameters(findMethod(id), {{name, value}});
                requireDifferentValues(findMethod(id), name, values);
            } catch (const InputError& error) {
                throw at(table.where(name), error);
            }
        setList(lists, name, values);
    }
}

/// One seed or more; each seed is a different world.
void readSeeds(files::TomlReader& table, std::vector<std::uint64_t>& seeds) {
    if (!table.has("seed")) return;
    seeds.clear();
    for (const std::string& text : table.scalars("seed")) {
        std::uint64_t seed = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
        if (error != std::errc() || end != text.data() + text.size() ||
            seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
            throw InputError(table.where("seed") + "key 'seed': got " + text +
                             ", expected an integer of 0 or more, or an array of them");
        if (std::ranges::find(seeds, seed) != seeds.end())
            throw InputError(table.where("seed") + "key 'seed': " + text + " is given twice");
        seeds.push_back(seed);
    }
    if (seeds.empty()) throw InputError(table.where("seed") + "key 'seed': got an empty array, expected integers");
}

/// Throws for a name that is given twice, which would count as two independent runs. `text` gives a name's canonical
/// form.
template <typename Text>
void requireOnce(files::TomlReader& table, const std::string& key, const std::vector<std::string>& names,
                 const Text& text) {
    for (auto name = names.begin(); name != names.end(); ++name)
        if (std::any_of(names.begin(), name, [&](const std::string& other) { return text(other) == text(*name); }))
            throw InputError(fmt::format("{}key '{}': {} is given twice", table.where(key), key, *name));
}

template <typename Check>
void readNames(files::TomlReader& table, const std::string& key, std::vector<std::string>& names, const Check& check) {
    if (!table.has(key)) return;
    names = table.texts(key);
    if (names.empty()) throw InputError(table.where(key) + "key '" + key + "': got an empty array, expected names");
    for (std::string& name : names) try {
            check(name);
        } catch (const InputError& error) {
            throw at(table.where(key), error);
        }
    requireOnce(table, key, names, [](const std::string& name) { return name; });
}

/// Names of data files, or paths.
void readDataNames(const SuiteDraft& draft, files::TomlReader& table, const std::string& key,
                   std::string_view extension, std::vector<std::string>& names) {
    const std::string kind = key.substr(0, key.size() - 1);
    readNames(table, key, names, [&](std::string& name) {
        name = files::fromFile(draft.file, name, extension);
        if (!name.empty()) (void)files::findData(kind, key, name, extension);
    });
}

std::vector<std::string> allMethods() {
    std::vector<std::string> ids;
    for (const MethodInfo& info : methods()) ids.push_back(info.id);
    return ids;
}

/// `volumes` requests volumes; the other keys refine it.
void readVolumes(files::TomlReader& table, std::optional<exports::VolumeSettings>& volumes) {
    const auto read = [&](const std::string& key, const auto& apply) {
        if (!table.has(key)) return;
        if (!volumes)
            throw InputError(table.where(key) + "key '" + key + "': requires 'volumes', which selects the frames");
        try {
            apply(key);
        } catch (const InputError& error) {
            const std::string message = error.what();
            throw message.starts_with(table.where(key)) ? error : at(table.where(key), error);
        }
    };
    if (table.has("volumes") && !volumes) volumes.emplace();
    read("volumes",
         [&](const std::string& key) { volumes->frames = exports::parseFrameRange(key, table.text(key, "")); });
    read("formats", [&](const std::string& key) {
        std::string joined;
        for (const std::string& name : table.texts(key)) joined.append(joined.empty() ? "" : ",").append(name);
        volumes->formats = exports::parseFormats(joined);
    });
    read("resolution", [&](const std::string& key) {
        volumes->resolution =
            static_cast<int>(table.integer(key, 1, exports::maximumCellsPerEdge, volumes->resolution));
    });
    read("region", [&](const std::string& key) { volumes->region = exports::parseRegion(table.text(key, "")); });
    for (const exports::ExporterOption& option : exports::exporterOptions())
        read(option.id, [&](const std::string& key) { volumes->setOption(key, table.text(key, "")); });
}

/// `metrics` requests metrics; `metric_frames` and `metric_pictures` refine it.
void readMetricPlan(files::TomlReader& table, std::optional<reference::MetricPlan>& metricPlan) {
    if (table.has("metrics")) {
        if (!table.boolean("metrics", false))
            metricPlan.reset();
        else if (!metricPlan)
            metricPlan.emplace();
    }
    for (const char* key : {"metric_frames", "metric_pictures"})
        if (table.has(key) && !metricPlan)
            throw InputError(fmt::format("{}key '{}': requires 'metrics = true'", table.where(key), key));
    if (table.has("metric_pictures")) metricPlan->keepsPictures = table.boolean("metric_pictures", true);
    if (!table.has("metric_frames")) return;
    const std::string text = table.text("metric_frames", "");
    try {
        metricPlan->moments = exports::parseFrameRange("metric_frames", text);
    } catch (const InputError& error) {
        throw at(table.where("metric_frames"), error);
    }
}

/// `[metric_reference.ID]`: parameters of the method, one value each.
void readFinerSettings(files::TomlReader& table, SuiteDraft& draft) {
    files::TomlReader perMethod = table.table("metric_reference");
    for (const std::string& id : perMethod.keys()) {
        if (std::ranges::find(draft.methods, id) == draft.methods.end())
            throw at(perMethod.where(id), unknownName("method of this suite", id, draft.methods));
        files::TomlReader settings = perMethod.table(id);
        results::ParameterTexts& finer = draft.finerSettings[id];
        for (const std::string& name : settings.keys()) {
            const std::vector<std::string> values = readValues(draft, settings, name);
            if (values.size() != 1)
                throw InputError(
                    fmt::format("{}key '{}': got {} values, expected one", settings.where(name), name, values.size()));
            try {
                ParameterValues own(findMethod(id).parameters);
                own.set(name, values.front());
                finer[name] = own.canonical().at(name);
            } catch (const InputError& error) {
                throw at(settings.where(name), error);
            }
        }
        settings.finish();
    }
    perMethod.finish();
}

/// The configurations to exclude. A value that no configuration has is an error.
void readExceptions(files::TomlReader& suite, SuiteDraft& draft) {
    draft.exceptions.clear();
    for (files::TomlReader& table : suite.tables("except")) {
        Exception exception;
        exception.where = table.where("");
        const auto names = [&](const std::string& key, const std::vector<std::string>& ofSuite,
                               std::string_view extension = {}) {
            std::vector<std::string> chosen;
            readNames(table, key, chosen, [&](std::string& name) {
                if (!extension.empty()) name = files::fromFile(draft.file, name, extension);
                if (std::ranges::find(ofSuite, name) == ofSuite.end())
                    throw unknownName(key.substr(0, key.size() - 1) + " of this suite", name, ofSuite);
            });
            return chosen;
        };
        exception.methods = names("methods", draft.methods);
        exception.scenes = names("scenes", draft.scenes, ".toml");
        exception.drives = names("drives", draft.drives, ".csv");
        exception.sizes = names("sizes", draft.sizes);
        if (table.has("parameters")) {
            files::TomlReader parameters = table.table("parameters");
            for (const std::string& name : parameters.keys())
                exception.parameters.emplace_back(name, readValues(draft, parameters, name));
            parameters.finish();
        }
        exception.afterRepetition =
            static_cast<int>(table.integer("after_repetition", 0, maximumRepetitions, exception.afterRepetition));
        exception.reason = table.text("reason", "");
        if (!exception.reason.empty() && exception.afterRepetition > 0)
            throw InputError(table.where("reason") +
                             "key 'reason': not allowed with 'after_repetition', which excludes some repetitions only");
        if (table.has("only")) exception.metricsOnly = table.choice("only", {"metrics"}) == "metrics";
        if (exception.metricsOnly && (!exception.reason.empty() || exception.afterRepetition > 0))
            throw InputError(table.where("only") + "key 'only': not allowed with 'reason' or 'after_repetition'");
        table.finish();
        draft.exceptions.push_back(std::move(exception));
    }
}

/// `gaps`, or `gaps against speed`. The load is checked when the whole suite has been read.
ChartView readChart(files::TomlReader& table) {
    std::istringstream words(table.text("chart"));
    ChartView chart;
    std::string against, rest;
    words >> chart.column >> against >> chart.against >> rest;
    if (chart.column.empty() || (!against.empty() && against != "against") ||
        against.empty() != chart.against.empty() || !rest.empty())
        throw InputError(fmt::format("{}key 'chart': got '{}', expected COLUMN or COLUMN against NAME",
                                     table.where("chart"), table.text("chart")));
    const std::vector<std::string> known = chartColumns();
    if (std::ranges::find(known, chart.column) == known.end())
        throw at(table.where("chart"), unknownName("column for a chart", chart.column, known));
    return chart;
}

/// A file's path, relative to the suite.
std::string usableDust(const SuiteDraft& draft, files::TomlReader& table) {
    const std::filesystem::path named(table.text("dust"));
    if (named.empty() || named.is_absolute()) return named.string();
    return (draft.file.parent_path() / named).lexically_normal().string();
}

}  // namespace

void SuiteDraft::read(files::TomlReader& table) {
    readNames(table, "methods", methods, [](const std::string& id) {
        if (id != "all") (void)findMethod(id);
    });
    if (std::ranges::find(methods, "all") != methods.end()) methods = allMethods();
    readDataNames(*this, table, "scenes", ".toml", scenes);
    readDataNames(*this, table, "drives", ".csv", drives);
    if (table.has("dust")) base.dust = usableDust(*this, table);
    if (table.has("dust_columns")) base.dustColumns = files::fromFile(file, table.text("dust_columns"), ".toml");
    readNames(table, "sizes", sizes, [](const std::string& size) { (void)results::parseSize(size); });
    if (table.has("sizes"))
        requireOnce(table, "sizes", sizes, [](const std::string& size) { return results::parseSize(size); });

    base.frames = table.integer("frames", 1, maximumFrames, base.frames);
    base.warmup = table.integer("warmup", 0, maximumFrames, base.warmup);
    readSeeds(table, seeds);
    base.threads = static_cast<int>(table.integer("threads", 0, 1024, base.threads));
    base.imagesEvery = table.integer("images", 0, maximumFrames, base.imagesEvery);
    readVolumes(table, base.volumes);
    readMetricPlan(table, base.metricPlan);
    if (table.has("times")) {
        base.timed = table.boolean("times", true);
        timesWhere = table.where("times");
    }
    if (table.has("dust_on")) base.dustOn = table.choice("dust_on", results::dustPlaces);
    if (table.has("sync")) base.sync = table.choice("sync", results::syncs);

    suite.title = table.text("title", suite.title);
    suite.summary = table.text("summary", suite.summary);
    if (table.has("chart")) {
        suite.chart = readChart(table);
        chartWhere = table.where("chart");
    }
    suite.repetitions = static_cast<int>(table.integer("repetitions", 1, maximumRepetitions, suite.repetitions));
    suite.timeoutSeconds = table.number("timeout_s", 1, 1e6, suite.timeoutSeconds);
    suite.limits.memoryMegabytes = table.integer("memory_limit_mb", 0, 1'000'000'000, suite.limits.memoryMegabytes);
    suite.limits.cpuSeconds = table.integer("cpu_limit_s", 0, 1'000'000, suite.limits.cpuSeconds);
    suite.cooldownSeconds = table.number("cooldown_s", 0, 3600, suite.cooldownSeconds);
    if (table.has("baseline")) baseline = table.boolean("baseline", false);
    if (table.has("order")) suite.order = table.choice("order", orders);

    if (table.has("parameters")) {
        files::TomlReader ofAll = table.table("parameters");
        readParameters(*this, ofAll, methods, parameters);
        ofAll.finish();
    }
    if (table.has("method")) {
        files::TomlReader perMethod = table.table("method");
        for (const std::string& id : perMethod.keys()) {
            if (std::ranges::find(methods, id) == methods.end())
                throw at(perMethod.where(id), unknownName("method of this suite", id, methods));
            files::TomlReader own = perMethod.table(id);
            auto known = std::ranges::find(methodParameters, id, [](const auto& entry) { return entry.first; });
            if (known == methodParameters.end()) {
                methodParameters.emplace_back(id, ParameterLists{});
                known = std::prev(methodParameters.end());
            }
            readParameters(*this, own, {id}, known->second);
            own.finish();
        }
        perMethod.finish();
    }
    if (table.has("metric_reference")) readFinerSettings(table, *this);
    if (table.has("except")) readExceptions(table, *this);
    if (table.has("fit")) suite.fits = readFits(table);
    if (table.has("compare")) suite.comparisons = readComparisons(table, methods);
}

void setList(ParameterLists& lists, const std::string& name, std::vector<std::string> values) {
    const auto known = std::ranges::find(lists, name, &ParameterLists::value_type::first);
    if (known != lists.end())
        known->second = std::move(values);
    else
        lists.emplace_back(name, std::move(values));
}

}  // namespace dustbench::suite
