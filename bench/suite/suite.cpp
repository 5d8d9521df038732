#include "bench/suite/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "bench/results/summary.h"
#include "bench/suite/paper.h"
#include "bench/suite/suite_draft.h"
#include "bench/suite/suite_evaluation.h"
#include "bench/suite/suite_plan.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/maths/philox.h"

namespace dustbench::suite {
namespace fs = std::filesystem;
namespace {

/// Where a configuration runs.
struct World {
    std::string scene, drive;
    results::ImageSize size;
    std::uint64_t seed;
};

bool isOneOf(const std::string& value, const std::vector<std::string>& list) {
    return list.empty() || std::ranges::find(list, value) != list.end();
}

bool covers(const Exception& exception, const World& world) {
    const auto isSize = [&](const std::string& text) { return results::parseSize(text) == world.size; };
    return isOneOf(world.scene, exception.scenes) && isOneOf(world.drive, exception.drives) &&
           (exception.sizes.empty() || std::ranges::any_of(exception.sizes, isSize));
}

/// The exceptions of a suite, in order, and how many configurations each one changed or removed.
class Exclusions {
 public:
    explicit Exclusions(const std::vector<Exception>& exceptions)
        : exceptions_(exceptions), counts_(exceptions.size(), 0) {}

    /// The exceptions that cover the method and the parameters of a setting. The same in every world.
    [[nodiscard]] std::vector<std::size_t> of(const results::RunSpec& setting) {
        std::vector<std::size_t> covering;
        for (std::size_t i = 0; i < exceptions_.size(); ++i)
            if (isFor(setting, exceptions_[i])) covering.push_back(i);
        return covering;
    }

    /// The setting in this world, or nullopt if one of its exceptions removes it there.
    [[nodiscard]] std::optional<PlannedRun> in(const World& world, const PlannedRun& setting,
                                               std::span<const std::size_t> itsExceptions) {
        bool hasMetrics = setting.spec.metricPlan.has_value();
        int repetitions = 0;
        std::string skip;
        for (const std::size_t i : itsExceptions) {
            const Exception& exception = exceptions_[i];
            if (!covers(exception, world) || (exception.metricsOnly && !hasMetrics)) continue;
            ++counts_[i];
            if (exception.metricsOnly) {
                hasMetrics = false;
            } else if (exception.afterRepetition == 0 && exception.reason.empty()) {
                return std::nullopt;
            } else {
                repetitions = std::max(exception.afterRepetition, 1);
                skip = exception.reason;
            }
        }
        PlannedRun run = setting;
        if (!hasMetrics) run.spec.metricPlan.reset();
        run.repetitions = repetitions;
        run.skip = std::move(skip);
        run.spec.scene = world.scene;
        run.spec.drive = world.drive;
        run.spec.size = world.size;
        run.spec.seed = world.seed;
        return run;
    }

    /// Throws InputError for an exception that matched no configuration.
    void requireMatches() const {
        for (std::size_t i = 0; i < exceptions_.size(); ++i)
            if (counts_[i] == 0) throw InputError(exceptions_[i].where + "except: matches no configuration");
    }

 private:
    bool isFor(const results::RunSpec& setting, const Exception& exception) {
        const auto hasOneOf = [&](const auto& parameter) {
            const auto& [name, values] = parameter;
            const auto own = setting.parameters.find(name);
            return own != setting.parameters.end() && std::ranges::any_of(values, [&](const std::string& value) {
                       return canonical(setting.method, name, value) == own->second;
                   });
        };
        return isOneOf(setting.method, exception.methods) && std::ranges::all_of(exception.parameters, hasOneOf);
    }

    /// Every setting of a suite asks for the same few, and each takes all of a method's declarations.
    const std::string& canonical(const std::string& method, const std::string& name, const std::string& value) {
        std::string& text = canonical_[{method, name, value}];
        if (text.empty()) text = results::canonicalParameters(findMethod(method), {{name, value}}).at(name);
        return text;
    }

    const std::vector<Exception>& exceptions_;
    std::vector<std::size_t> counts_;
    std::map<std::array<std::string, 3>, std::string> canonical_;  ///< by method, parameter and value as written
};

/// Throws InputError if no run of the suite has the load of its chart. Every run has the costs.
void requireLoad(const Suite& suite, const std::string& where) {
    const std::string& name = suite.chart.against;
    std::set<std::string> known{"drive", "scene", "seed", "size"};
    known.insert(chartCosts.begin(), chartCosts.end());
    for (const PlannedRun& cell : suite.cells)
        for (const auto& [parameter, value] : cell.spec.parameters) known.insert(parameter);
    if (name.empty() || known.contains(name)) return;
    const std::vector<std::string> names(known.begin(), known.end());
    throw InputError(where + unknownName("load of the chart", name, names).what());
}

/// Throws InputError if a suite without times uses a key that concerns times.
void requireNothingTimed(const SuiteDraft& draft) {
    const Suite& suite = draft.suite;
    if (draft.base.timed) return;
    const auto fail = [&](const std::string& what) {
        throw InputError(fmt::format("{}key 'times': got false with {}", draft.timesWhere, what));
    };
    if (suite.repetitions > 1)
        fail(fmt::format("{} repetitions, allowed: 1, because repetitions differ only in their times",
                         suite.repetitions));
    if (!suite.comparisons.empty()) fail("'compare', which compares times");
    if (!suite.fits.empty()) fail("'fit', which fits times");
    if (draft.baseline.value_or(false)) fail("'baseline = true', which compares times");
    if (suite.cooldownSeconds > 0) fail("'cooldown_s', which steadies times");
    if (suite.chart.column.empty() || results::dependsOnSpeed(suite.chart.column))
        fail(fmt::format("a chart that opens on '{}', expected 'chart' with a column that is not a time",
                         suite.chart.column.empty() ? "fps_avg" : suite.chart.column));
}

/// Called before the configurations are created.
void requireFewEnough(const std::string& what, double runs) {
    if (runs > static_cast<double>(files::limits::plannedRuns))
        throw InputError(fmt::format("{}: got {:.0f} planned runs, allowed: {} (limit of a command)", what, runs,
                                     files::limits::plannedRuns));
}

double combinations(const ParameterLists& lists) {
    double product = 1;
    for (const auto& [name, values] : lists) product *= static_cast<double>(values.size());
    return product;
}

/// The parameter values for one method of the suite.
ParameterLists listsOf(const SuiteDraft& draft, const std::string& id) {
    ParameterLists lists = draft.parameters;
    for (const auto& [method, own] : draft.methodParameters)
        if (method == id)
            for (const auto& [name, values] : own) setList(lists, name, values);
    return lists;
}

void requireFewEnough(const SuiteDraft& draft) {
    double cells = 0;
    for (const std::string& id : draft.methods) cells += combinations(listsOf(draft, id));
    for (const std::size_t count : {draft.scenes.size(), draft.drives.size(), draft.sizes.size(), draft.seeds.size()})
        cells *= static_cast<double>(count);
    requireFewEnough("suite", cells * draft.suite.repetitions);
}

/// `wholeFile`: an exception that excludes nothing is an error. In `[quick]`, which has fewer configurations, it is
/// not.
Suite multiplyOut(SuiteDraft draft, bool wholeFile) {
    results::requireFramesWithinRun(draft.base);
    requireFewEnough(draft);
    requireNothingTimed(draft);
    Suite suite = std::move(draft.suite);
    std::vector<World> worlds;
    std::vector<std::string> labels;  // of the worlds
    for (const std::string& scene : draft.scenes)
        for (const std::string& drive : draft.drives)
            for (const std::string& size : draft.sizes)
                for (const std::uint64_t seed : draft.seeds) {
                    worlds.push_back({scene, drive, results::parseSize(size), seed});
                    labels.push_back((draft.sizes.size() > 1 ? size + " " : "") +
                                     (draft.drives.size() > 1 ? drive + " " : "") +
                                     (draft.seeds.size() > 1 ? fmt::format("seed={} ", seed) : ""));
                }
    Exclusions exclusions(draft.exceptions);
    for (const std::string& id : draft.methods) {
        results::RunSpec base = draft.base;
        base.method = id;
        if (const auto finer = draft.finerSettings.find(id); base.metricPlan && finer != draft.finerSettings.end())
            base.metricPlan->finer = finer->second;
        const std::vector<PlannedRun> settings = expandParameters(base, findMethod(id), listsOf(draft, id));
        std::vector<std::vector<std::size_t>> exceptions;  // of the settings
        for (const PlannedRun& setting : settings) {
            results::requireChangesWithinRun(setting.spec);
            exceptions.push_back(exclusions.of(setting.spec));
        }
        for (std::size_t w = 0; w < worlds.size(); ++w)
            for (std::size_t s = 0; s < settings.size(); ++s)
                if (std::optional<PlannedRun> run = exclusions.in(worlds[w], settings[s], exceptions[s])) {
                    run->label.insert(0, labels[w]);
                    suite.cells.push_back(std::move(*run));
                }
    }
    if (wholeFile) exclusions.requireMatches();
    // Without repetitions there are no intervals, so such a suite does not compare times.
    suite.baseline =
        draft.baseline.value_or(suite.repetitions > 1 || !suite.comparisons.empty() || !suite.fits.empty());
    if (std::ranges::all_of(suite.cells, [](const PlannedRun& cell) { return !cell.skip.empty(); }))
        throw InputError("suite: its exceptions exclude every configuration");
    for (const PlannedComparison& comparison : suite.comparisons) (void)matchCells(suite, comparison);
    for (const PlannedFit& fit : suite.fits) (void)cellsByLoad(suite, fit);
    requireLoad(suite, draft.chartWhere);
    return suite;
}

SuiteForms readSuite(files::TomlReader file, const fs::path& place, const std::string& id) {
    SuiteDraft draft;
    draft.file = place;
    draft.read(file);
    SuiteForms forms{multiplyOut(draft, true), std::nullopt};
    forms.full.id = id;
    if (file.has("quick")) {
        files::TomlReader table = file.table("quick");
        draft.read(table);
        table.finish();
        forms.quick = multiplyOut(std::move(draft), false);
        forms.quick->id = id;
    }
    file.finish();
    return forms;
}

Suite chosen(SuiteForms forms, bool quick) {
    return quick && forms.quick ? std::move(*forms.quick) : std::move(forms.full);
}

/// Random order of a round.
class RoundShuffle {
 public:
    RoundShuffle(std::uint64_t seed, int round) : seed_(seed), round_(static_cast<std::uint32_t>(round)) {}

    /// Fisher-Yates.
    template <typename Thing>
    void operator()(std::vector<Thing>& things) {
        for (std::size_t left = things.size(); left > 1; --left)
            std::swap(things[left - 1], things[maths::randomWords(seed_, round_, draws_++)[0] % left]);
    }

 private:
    std::uint64_t seed_;
    std::uint32_t round_;
    std::uint64_t draws_ = 0;
};

/// Indices of configurations by group.
std::vector<std::vector<std::size_t>> listGroups(const Suite& suite) {
    std::map<std::size_t, std::vector<std::size_t>> members;
    const std::vector<std::size_t> groups = groupCells(suite);
    for (std::size_t i = 0; i < groups.size(); ++i) members[groups[i]].push_back(i);
    std::vector<std::vector<std::size_t>> list;
    list.reserve(members.size());
    for (auto& [first, cells] : members) list.push_back(std::move(cells));
    return list;
}

}  // namespace

std::vector<SuiteFile> listSuites() {
    std::map<std::string, SuiteFile> suites;  // the first suite with a name counts
    const auto add = [&suites](const fs::path& folder, const std::string& paper) {
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder, error)) {
            const std::string id = entry.path().stem();
            if (entry.path().extension() == ".toml") suites.try_emplace(id, SuiteFile{id, entry.path(), paper});
        }
    };
    for (const fs::path& data : files::dataFolders()) {
        add(data / "suites", "");
        for (const std::string& paper : files::listDataFolders("papers"))
            if (const fs::path folder = paperFile(paper, "suites");
                folder.parent_path().parent_path() == data / "papers")
                add(folder, paper);
    }
    std::vector<SuiteFile> list;
    list.reserve(suites.size());
    for (auto& [id, suite] : suites) list.push_back(std::move(suite));
    return list;
}

SuiteForms loadForms(const std::string& idOrFile) {
    fs::path file;
    if (files::isDataFile(idOrFile, ".toml")) {
        file = files::findData("suite", "suites", idOrFile, ".toml");
    } else {
        std::vector<std::string> known;
        for (const SuiteFile& suite : listSuites()) {
            known.push_back(suite.id);
            if (suite.id == idOrFile) file = suite.file;
        }
        if (file.empty()) throw unknownName("suite", idOrFile, known);
    }
    return readSuite(files::TomlReader::parseFile(file), file, file.stem());
}

Suite loadSuite(const std::string& idOrFile, bool quick) {
    return chosen(loadForms(idOrFile), quick);
}

Suite parseSuite(std::string_view text, const std::string& name, bool quick) {
    return chosen(readSuite(files::TomlReader::parseText(text, name), {}, name), quick);
}

void requireDifferentValues(const MethodInfo& method, const std::string& name, const std::vector<std::string>& values) {
    std::map<std::string, std::string> given;  // by canonical value
    for (const std::string& value : values)
        if (const auto [first, isNew] =
                given.emplace(results::canonicalParameters(method, {{name, value}}).at(name), value);
            !isNew)
            throw InputError(fmt::format("parameter {}: {} is given twice{}", name, value,
                                         value == first->second ? "" : ", also as " + first->second));
}

std::vector<PlannedRun> expandParameters(const results::RunSpec& base, const MethodInfo& method,
                                         const ParameterLists& lists) {
    requireFewEnough("-P", combinations(lists));
    for (const auto& [name, values] : lists) requireDifferentValues(method, name, values);
    std::vector<PlannedRun> runs;
    std::vector<std::size_t> choice(lists.size(), 0);
    for (;;) {
        results::ParameterTexts given;
        std::string label;
        for (std::size_t i = 0; i < lists.size(); ++i) {
            given[lists[i].first] = lists[i].second[choice[i]];
            label += (i ? " " : "") + lists[i].first + "=" + lists[i].second[choice[i]];
        }
        runs.push_back({base, label});
        runs.back().spec.parameters = results::canonicalParameters(method, given);

        std::size_t digit = lists.size();
        while (digit > 0 && ++choice[digit - 1] == lists[digit - 1].second.size()) choice[--digit] = 0;
        if (digit == 0) return runs;
    }
}

results::RunSpec inRepetition(results::RunSpec cell, int repetition) {
    cell.repetition = repetition;
    if (repetition > 1) cell.metricPlan.reset();
    return cell;
}

std::vector<PlannedRun> planRuns(const Suite& cellsOnly) {
    requireFewEnough("suite", static_cast<double>(cellsOnly.cells.size()) * cellsOnly.repetitions);
    if (cellsOnly.repetitions > 1 && !cellsOnly.cells.empty() && !cellsOnly.cells.front().spec.timed)
        throw InputError(
            fmt::format("repetitions: got {} for a suite with times = false, allowed: 1, because repetitions "
                        "differ only in their times",
                        cellsOnly.repetitions));
    const Suite suite = withBaselines(cellsOnly);
    std::vector<PlannedRun> plan;
    const auto add = [&plan](PlannedRun run, int repetition) {
        if (run.repetitions > 0 && repetition > run.repetitions) return;
        run.spec = inRepetition(run.spec, repetition);
        plan.push_back(std::move(run));
    };
    if (suite.order == Order::batch) {
        for (const PlannedRun& cell : suite.cells)
            for (int repetition = 1; repetition <= suite.repetitions; ++repetition) add(cell, repetition);
        return plan;
    }
    if (suite.cells.empty()) return plan;
    std::vector<std::vector<std::size_t>> groups = listGroups(suite);
    for (int repetition = 1; repetition <= suite.repetitions; ++repetition) {
        RoundShuffle shuffle(suite.cells.front().spec.seed, repetition);
        shuffle(groups);
        for (std::vector<std::size_t>& cells : groups) {
            shuffle(cells);
            for (const std::size_t cell : cells) add(suite.cells[cell], repetition);
        }
    }
    return plan;
}

}  // namespace dustbench::suite
