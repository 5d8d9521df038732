#include "bench/selfcheck/picture_checks.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "bench/measure/image/heat_map.h"
#include "bench/measure/image/picture.h"
#include "bench/measure/image/picture_error.h"
#include "bench/results/temporary_folder.h"
#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/files/toml_reader.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::selfcheck {
namespace fs = std::filesystem;
namespace {

using Reference = PlannedPicture::Reference;
constexpr Choices<Reference> references{
    {"kept", Reference::kept}, {"exact", Reference::exact}, {"variant", Reference::variant}};

results::ParameterTexts parametersOf(files::TomlReader table) {
    results::ParameterTexts given;
    for (const std::string& key : table.keys()) {
        const std::vector<std::string> values = table.scalars(key);
        if (values.size() != 1)
            throw InputError(fmt::format("{}got {} values, expected one", table.where(key), values.size()));
        given[key] = values.front();
    }
    return given;
}

PlannedPicture readPicture(files::TomlReader& table, results::ImageSize size) {
    PlannedPicture picture;
    picture.name = table.text("name");
    results::RunSpec& spec = picture.spec;
    spec.method = table.text("method");
    spec.scene = table.text("scene", spec.scene);
    spec.drive = table.text("drive", "");
    spec.size = size;
    spec.warmup = 0;
    spec.frames = 1;
    spec.imagesEvery = 1;
    spec.timed = false;
    picture.flipLimit = table.number("flip", 0, 1);
    results::ParameterTexts given, instead;
    if (table.has("parameters")) given = parametersOf(table.table("parameters"));
    if (table.has("variant")) {
        picture.reference = Reference::variant;
        instead = parametersOf(table.table("variant"));
    }
    if (table.has("reference")) picture.reference = table.choice("reference", references);
    if (picture.reference == Reference::exact) {
        spec.frames = reference::minimumMoments;
        spec.metricPlan.emplace();
    }
    table.finish();
    if (std::ranges::find(methods(), spec.method, &MethodInfo::id) == methods().end()) {
        picture.skip = "this build lacks the method " + spec.method;
        return picture;
    }
    if (picture.reference == Reference::variant) {
        picture.variant = spec;
        results::ParameterTexts changed = given;
        for (const auto& [name, value] : instead) changed[name] = value;
        picture.variant->parameters = results::canonicalParameters(findMethod(spec.method), changed);
    }
    spec.parameters = results::canonicalParameters(findMethod(spec.method), given);
    return picture;
}

fs::path pictureOf(const results::ResultsFolder& results, const results::RunSpec& spec) {
    return results.runFolder(results::runId(spec)) / "images" / "f000000.png";
}

/// Why the run has no picture; empty if it has one.
std::string whyNoPicture(const results::ResultsFolder& results, const results::RunSpec& spec) {
    const auto run = results.runs().find(results::runId(spec));
    if (run == results.runs().end()) return "not drawn";
    return run->second.status == results::RunStatus::done ? "" : run->second.reason;
}

/// FLIP against `reference`; saves the map as `difference` where it exceeds the limit.
double compared(const fs::path& reference, const fs::path& picture, double limit, const fs::path& difference) {
    const measure::Measured found =
        measure::flip(measure::preparePicture(pictures::readImage(reference), reference.string()),
                      measure::preparePicture(pictures::readImage(picture), picture.string()));
    if (!found.value) throw InputError(reference.string() + ": too small to compare");
    if (*found.value > limit) pictures::writeImage(measure::heatMap(found.map), difference);
    return *found.value;
}

Check checkOf(const PlannedPicture& planned, const results::ResultsFolder& results, const fs::path& kept,
              const fs::path& drawn) {
    Check check{"picture " + planned.name, Outcome::failed, "", fmt::format("FLIP at most {}", planned.flipLimit)};
    if (!planned.skip.empty()) {
        check.outcome = Outcome::attention;
        check.measured = planned.skip;
        return check;
    }
    for (const results::RunSpec* spec : {&planned.spec, planned.variant ? &*planned.variant : nullptr}) {
        if (!spec) continue;
        check.measured = whyNoPicture(results, *spec);
        if (!check.measured.empty()) return check;
    }
    const fs::path picture = drawn / (planned.name + ".png");
    fs::copy_file(pictureOf(results, planned.spec), picture, fs::copy_options::overwrite_existing);
    double error = 0;
    if (planned.reference == Reference::exact) {
        error = std::stod(results.runs().at(results::runId(planned.spec)).cells.at("flip"));
        check.note = "against the ground truth, computed on the CPU";
    } else {
        const fs::path reference =
            planned.variant ? pictureOf(results, *planned.variant) : kept / (planned.name + ".png");
        if (!fs::exists(reference)) {
            check.measured = reference.string() + " does not exist";
            return check;
        }
        error = compared(reference, picture, planned.flipLimit, drawn / (planned.name + ".difference.png"));
        check.note = planned.variant ? "against the same method with other settings" : "against the kept picture";
    }
    check.measured = fmt::format("FLIP {:.2g}", error);
    if (error <= planned.flipLimit) check.outcome = Outcome::ok;
    return check;
}

}  // namespace

std::vector<PlannedPicture> readPlannedPictures(const fs::path& file) {
    files::TomlReader toml = files::TomlReader::parseFile(file);
    const results::ImageSize size = results::parseSize(toml.text("size"));
    std::vector<PlannedPicture> planned;
    std::set<std::string> names;
    for (files::TomlReader& table : toml.tables("picture")) {
        const std::string where = table.where("name");
        planned.push_back(readPicture(table, size));
        if (!names.insert(planned.back().name).second)
            throw InputError(where + "'" + planned.back().name + "' appears twice");
    }
    toml.finish();
    return planned;
}

std::vector<Check> pictureChecks(const std::vector<PlannedPicture>& planned, const fs::path& kept,
                                 const fs::path& drawn, const run::ExecutionOptions& options,
                                 run::ExecutionListener& listener) {
    fs::create_directories(drawn);
    std::vector<suite::PlannedRun> plan;
    std::set<std::string> ids, seen;
    for (const PlannedPicture& picture : planned) {
        seen.insert(picture.spec.method);
        if (!picture.skip.empty()) continue;
        for (const results::RunSpec* spec : {&picture.spec, picture.variant ? &*picture.variant : nullptr})
            if (spec && ids.insert(results::runId(*spec)).second) plan.push_back({*spec, picture.name});
    }
    const results::TemporaryFolder folder;
    results::ResultsFolder results(folder.path());
    (void)run::execute(plan, 1, results, options, listener);
    std::vector<Check> checks;
    checks.reserve(planned.size() + 1);
    for (const PlannedPicture& picture : planned) checks.push_back(checkOf(picture, results, kept, drawn));
    std::vector<std::string> others;
    for (const MethodInfo& method : methods())
        if (!seen.contains(method.id)) others.push_back(method.id);
    if (!others.empty())
        checks.push_back({"other methods", Outcome::attention, fmt::format("{}", fmt::join(others, ", ")), "",
                          "no picture to compare with"});
    return checks;
}

}  // namespace dustbench::selfcheck
