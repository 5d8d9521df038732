#include "bench/run/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "bench/run/suite_comparison.h"
#include "bench/run/value_list.h"
#include "methods/shared/errors.h"
#include "methods/shared/files/data_folder.h"
#include "methods/shared/files/toml_reader.h"
#include "methods/shared/maths/philox.h"
#include "methods/shared/registry.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t mostFrames = 10'000'000;

/// What a suite's file says, before anything is multiplied out. `[quick]` is read over it with the same function.
struct Draft {
    std::vector<std::string> methods{"all"};
    std::vector<std::string> scenes{"plain"};
    std::vector<std::string> drives{""};
    std::vector<std::string> sizes{"640x480"};
    RunSpec base;
    Suite suite;
    ParameterLists parameters;
    std::vector<std::pair<std::string, ParameterLists>> methodParameters;
    std::map<std::string, ParameterTexts> finerSettings;  ///< by method: what it is judged against
};

[[nodiscard]] InputError at(const std::string& where, const InputError& error) {
    return InputError(where + error.what());
}

void setList(ParameterLists& lists, const std::string& name, std::vector<std::string> values) {
    const auto known = std::ranges::find(lists, name, &ParameterLists::value_type::first);
    if (known != lists.end())
        known->second = std::move(values);
    else
        lists.emplace_back(name, std::move(values));
}

std::vector<std::string> readValues(files::TomlReader& table, const std::string& name) {
    try {
        std::vector<std::string> values;
        for (const std::string& text : table.scalars(name))
            for (std::string& value : expandValues(name, text)) values.push_back(std::move(value));
        if (values.empty()) throw InputError("parameter " + name + ": no values");
        return values;
    } catch (const InputError& error) {
        const std::string message = error.what();
        throw message.starts_with(table.where(name)) ? error : at(table.where(name), error);
    }
}

/// Every value must suit each of the methods, or the file is wrong at this line.
void readParameters(files::TomlReader& table, const std::vector<std::string>& methodIds, ParameterLists& lists) {
    for (const std::string& name : table.keys()) {
        const std::vector<std::string> values = readValues(table, name);
        for (const std::string& id : methodIds)
            for (const std::string& value : values) try {
                    (void)resolveParameters(findMethod(id), {{name, value}});
                } catch (const InputError& error) {
                    throw at(table.where(name), error);
                }
        setList(lists, name, values);
    }
}

template <typename Check>
void readNames(files::TomlReader& table, const std::string& key, std::vector<std::string>& names, const Check& check) {
    if (!table.has(key)) return;
    names = table.texts(key);
    if (names.empty()) throw InputError(table.where(key) + "key '" + key + "': got an empty array, expected names");
    for (const std::string& name : names) try {
            check(name);
        } catch (const InputError& error) {
            throw at(table.where(key), error);
        }
}

std::vector<std::string> allMethods() {
    std::vector<std::string> ids;
    for (const MethodInfo& info : methods()) ids.push_back(info.id);
    return ids;
}

/// `volumes` asks for them; the other keys say more about it.
void readVolumes(files::TomlReader& table, std::optional<VolumeSettings>& volumes) {
    const auto read = [&](const std::string& key, const auto& apply) {
        if (!table.has(key)) return;
        if (!volumes)
            throw InputError(table.where(key) + "key '" + key +
                             "': got it without 'volumes', which says of which frames");
        try {
            apply(key);
        } catch (const InputError& error) {
            const std::string message = error.what();
            throw message.starts_with(table.where(key)) ? error : at(table.where(key), error);
        }
    };
    if (table.has("volumes") && !volumes) volumes.emplace();
    read("volumes", [&](const std::string& key) { volumes->frames = parseFrameRange(key, table.text(key, "")); });
    read("formats", [&](const std::string& key) {
        std::string joined;
        for (const std::string& name : table.texts(key)) joined.append(joined.empty() ? "" : ",").append(name);
        volumes->formats = parseFormats(joined);
    });
    read("resolution", [&](const std::string& key) {
        volumes->resolution = static_cast<int>(table.integer(key, 1, mostCellsPerEdge, volumes->resolution));
    });
    read("region", [&](const std::string& key) { volumes->region = parseRegion(table.text(key, "")); });
    read("vdb_precision", [&](const std::string& key) { volumes->vdbPrecision = parsePrecision(table.text(key, "")); });
}

/// `metrics` asks for them; `metric_frames` says of which frames.
void readJudging(files::TomlReader& table, std::optional<JudgingPlan>& judging) {
    if (table.has("metrics")) {
        if (!table.boolean("metrics", false))
            judging.reset();
        else if (!judging)
            judging.emplace();
    }
    if (!table.has("metric_frames")) return;
    if (!judging)
        throw InputError(table.where("metric_frames") + "key 'metric_frames': got it without 'metrics = true'");
    const std::string text = table.text("metric_frames", "");
    try {
        judging->moments = parseFrameRange("metric_frames", text);
    } catch (const InputError& error) {
        throw at(table.where("metric_frames"), error);
    }
}

/// `[metric_reference.ID]`: parameters of the method's own, one value each.
void readFinerSettings(files::TomlReader& table, Draft& draft) {
    files::TomlReader perMethod = table.table("metric_reference");
    for (const std::string& id : perMethod.keys()) {
        if (std::ranges::find(draft.methods, id) == draft.methods.end())
            throw at(perMethod.where(id), unknownName("method of this suite", id, draft.methods));
        files::TomlReader settings = perMethod.table(id);
        ParameterTexts& finer = draft.finerSettings[id];
        for (const std::string& name : settings.keys()) {
            const std::vector<std::string> values = readValues(settings, name);
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

void readDraft(files::TomlReader& table, Draft& draft) {
    readNames(table, "methods", draft.methods, [](const std::string& id) {
        if (id != "all") (void)findMethod(id);
    });
    if (std::ranges::find(draft.methods, "all") != draft.methods.end()) draft.methods = allMethods();
    readNames(table, "scenes", draft.scenes,
              [](const std::string& id) { (void)files::findData("scene", "scenes", id, ".toml"); });
    readNames(table, "drives", draft.drives, [](const std::string& id) {
        if (!id.empty()) (void)files::findData("drive", "drives", id, ".csv");
    });
    readNames(table, "sizes", draft.sizes, [](const std::string& size) { (void)parseSize(size); });

    RunSpec& base = draft.base;
    base.frames = table.integer("frames", 1, mostFrames, base.frames);
    base.warmup = table.integer("warmup", 0, mostFrames, base.warmup);
    base.seed = static_cast<std::uint64_t>(
        table.integer("seed", 0, std::numeric_limits<std::int64_t>::max(), static_cast<std::int64_t>(base.seed)));
    base.threads = static_cast<int>(table.integer("threads", 0, 1024, base.threads));
    base.imagesEvery = table.integer("images", 0, mostFrames, base.imagesEvery);
    readVolumes(table, base.volumes);
    readJudging(table, base.judging);
    if (table.has("sync")) base.sync = parseSync(table.choice("sync", {"frame", "stage", "none"}));

    Suite& suite = draft.suite;
    suite.title = table.text("title", suite.title);
    suite.summary = table.text("summary", suite.summary);
    suite.repetitions = static_cast<int>(table.integer("repetitions", 1, 1000, suite.repetitions));
    suite.timeoutSeconds = table.number("timeout_s", 1, 1e6, suite.timeoutSeconds);
    if (table.has("order")) suite.order = parseOrder(table.choice("order", {"interleaved", "batch"}));

    if (table.has("parameters")) {
        files::TomlReader parameters = table.table("parameters");
        readParameters(parameters, draft.methods, draft.parameters);
        parameters.finish();
    }
    if (table.has("method")) {
        files::TomlReader perMethod = table.table("method");
        for (const std::string& id : perMethod.keys()) {
            if (std::ranges::find(draft.methods, id) == draft.methods.end())
                throw at(perMethod.where(id), unknownName("method of this suite", id, draft.methods));
            files::TomlReader parameters = perMethod.table(id);
            auto known = std::ranges::find(draft.methodParameters, id, [](const auto& entry) { return entry.first; });
            if (known == draft.methodParameters.end()) {
                draft.methodParameters.emplace_back(id, ParameterLists{});
                known = std::prev(draft.methodParameters.end());
            }
            readParameters(parameters, {id}, known->second);
            parameters.finish();
        }
        perMethod.finish();
    }
    if (table.has("metric_reference")) readFinerSettings(table, draft);
    if (table.has("compare")) suite.comparisons = readComparisons(table, draft.methods);
}

Suite multiplyOut(Draft draft) {
    requireFramesWithinRun(draft.base);
    Suite suite = std::move(draft.suite);
    for (const std::string& id : draft.methods) {
        ParameterLists lists = draft.parameters;
        for (const auto& [method, own] : draft.methodParameters)
            if (method == id)
                for (const auto& [name, values] : own) setList(lists, name, values);
        for (const std::string& scene : draft.scenes)
            for (const std::string& drive : draft.drives)
                for (const std::string& size : draft.sizes) {
                    RunSpec base = draft.base;
                    base.method = id;
                    base.scene = scene;
                    base.drive = drive;
                    base.size = parseSize(size);
                    if (const auto finer = draft.finerSettings.find(id);
                        base.judging && finer != draft.finerSettings.end())
                        base.judging->finer = finer->second;
                    for (PlannedRun& run : expandParameters(base, findMethod(id), lists)) {
                        if (draft.drives.size() > 1) run.label = drive + " " + run.label;
                        if (draft.sizes.size() > 1) run.label = size + " " + run.label;
                        suite.cells.push_back(std::move(run));
                    }
                }
    }
    for (const PlannedComparison& comparison : suite.comparisons) (void)matchCells(suite, comparison);
    return suite;
}

Suite readSuite(files::TomlReader file, std::string id, bool quick) {
    Draft draft;
    readDraft(file, draft);
    Suite suite = multiplyOut(draft);
    if (file.has("quick")) {
        // Read in any case, so that a mistake in it shows early.
        files::TomlReader table = file.table("quick");
        readDraft(table, draft);
        table.finish();
        Suite shorter = multiplyOut(std::move(draft));
        if (quick) suite = std::move(shorter);
    }
    file.finish();
    suite.id = std::move(id);
    return suite;
}

/// Fisher-Yates with the round's own random numbers.
void shuffle(std::vector<PlannedRun>& runs, std::size_t first, std::uint64_t seed, std::uint32_t round) {
    for (std::size_t i = runs.size() - 1; i > first; --i) {
        const std::size_t choice = maths::randomWords(seed, round, i)[0] % (i - first + 1);
        std::swap(runs[i], runs[first + choice]);
    }
}

}  // namespace

Order parseOrder(std::string_view text) {
    if (text == "interleaved") return Order::interleaved;
    if (text == "batch") return Order::batch;
    throw InputError(fmt::format("order: got '{}', allowed: interleaved|batch", text));
}

std::vector<SuiteFile> listSuites() {
    std::vector<SuiteFile> suites;
    const auto add = [&suites](const std::string& folder, const std::string& paper) {
        for (const std::string& id : files::listData(folder, ".toml"))
            suites.push_back({id, files::dataFolder() / folder / (id + ".toml"), paper});
    };
    add("suites", "");
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(files::dataFolder() / "papers", error)) {
        const std::string paper = entry.path().filename();
        add("papers/" + paper + "/suites", paper);
    }
    std::ranges::sort(suites, {}, &SuiteFile::id);
    return suites;
}

Suite loadSuite(const std::string& idOrFile, bool quick) {
    fs::path file = idOrFile;
    if (idOrFile.find('/') == std::string::npos && !idOrFile.ends_with(".toml")) {
        std::vector<std::string> known;
        for (const SuiteFile& suite : listSuites()) {
            known.push_back(suite.id);
            if (suite.id == idOrFile) file = suite.file;
        }
        if (file == fs::path(idOrFile)) throw unknownName("suite", idOrFile, known);
    }
    return readSuite(files::TomlReader::parseFile(file), file.stem(), quick);
}

Suite parseSuite(std::string_view text, const std::string& name, bool quick) {
    return readSuite(files::TomlReader::parseText(text, name), name, quick);
}

std::vector<PlannedRun> expandParameters(const RunSpec& base, const MethodInfo& method, const ParameterLists& lists) {
    std::vector<PlannedRun> runs;
    std::vector<std::size_t> choice(lists.size(), 0);
    for (;;) {
        ParameterTexts given;
        std::string label;
        for (std::size_t i = 0; i < lists.size(); ++i) {
            given[lists[i].first] = lists[i].second[choice[i]];
            label += (i ? " " : "") + lists[i].first + "=" + lists[i].second[choice[i]];
        }
        runs.push_back({base, label});
        runs.back().spec.parameters = canonicalParameters(method, given);

        std::size_t digit = lists.size();
        while (digit > 0 && ++choice[digit - 1] == lists[digit - 1].second.size()) choice[--digit] = 0;
        if (digit == 0) return runs;
    }
}

RunSpec inRepetition(RunSpec cell, int repetition) {
    cell.repetition = repetition;
    if (repetition > 1) cell.judging.reset();
    return cell;
}

std::vector<PlannedRun> planRuns(const Suite& suite) {
    std::vector<PlannedRun> plan;
    const auto add = [&plan](PlannedRun run, int repetition) {
        run.spec = inRepetition(run.spec, repetition);
        plan.push_back(std::move(run));
    };
    if (suite.order == Order::batch) {
        for (const PlannedRun& cell : suite.cells)
            for (int repetition = 1; repetition <= suite.repetitions; ++repetition) add(cell, repetition);
        return plan;
    }
    for (int repetition = 1; repetition <= suite.repetitions; ++repetition) {
        const std::size_t first = plan.size();
        for (const PlannedRun& cell : suite.cells) add(cell, repetition);
        if (plan.size() > first)
            shuffle(plan, first, suite.cells.front().spec.seed, static_cast<std::uint32_t>(repetition));
    }
    return plan;
}

}  // namespace dustbench::bench
