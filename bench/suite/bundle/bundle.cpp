#include "bench/suite/bundle/bundle.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "bench/export/whole_file.h"
#include "bench/measure/provenance.h"
#include "bench/measure/sha256.h"
#include "bench/results/compared_runs.h"
#include "bench/results/stored_run.h"
#include "bench/suite/bundle/tar_file.h"
#include "bench/suite/machine/machine_plan.h"
#include "bench/suite/suite.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::suite {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

constexpr const char* sumsName = "SHA256SUMS";
constexpr const char* indexName = "bundle.json";
constexpr int layout = 1;

/// Files by name in the bundle.
using Contents = std::map<std::string, fs::path>;

void addResults(const fs::path& results, Contents& contents) {
    for (auto entry = fs::recursive_directory_iterator(results); entry != fs::recursive_directory_iterator(); ++entry) {
        if (entry->path().filename().string().starts_with('.')) {  // a lock, or a file that is still being written
            entry.disable_recursion_pending();
        } else if (entry->is_regular_file()) {
            const std::string name = entry->path().lexically_relative(results).generic_string();
            contents.emplace("results/" + name, entry->path());
        }
    }
}

std::string placeOf(const measure::InputHash& input) {
    const fs::path file(input.file);
    if (file.is_relative()) return "inputs/" + input.file;
    return fmt::format("outside/{}-{}", input.sha256.substr(0, 12), file.filename().string());
}

/// All inputs without duplicates. Throws InputError if two runs read different versions of a file.
std::vector<measure::InputHash> inputsOf(const results::StoredRuns& runs) {
    std::map<std::string, std::string> sums;
    for (const auto& [id, run] : runs)
        for (const measure::InputHash& input : run.inputs)
            if (const auto [at, isNew] = sums.emplace(input.file, input.sha256); !isNew && at->second != input.sha256)
                throw InputError(
                    fmt::format("input '{}': the runs read different versions of it; `dustbench suite … "
                                "--redo-outdated` repeats the outdated runs",
                                input.file));
    std::vector<measure::InputHash> inputs;
    inputs.reserve(sums.size());
    for (const auto& [file, sum] : sums) inputs.push_back({file, sum});
    return inputs;
}

Json addInputs(const std::vector<measure::InputHash>& inputs, Contents& contents) {
    Json index = Json::array();
    for (const measure::InputHash& input : inputs) {
        const fs::path file = files::dataPath(input.file);  // an absolute path stays as it is
        if (file.empty() || !fs::is_regular_file(file))
            throw InputError(fmt::format("input '{}': was read by the runs but no longer exists", input.file));
        if (measure::sha256OfFile(file) != input.sha256)
            throw InputError(fmt::format("input '{}': has changed since the runs read it", file.string()));
        contents.emplace(placeOf(input), file);
        index.push_back({{"file", input.file}, {"sha256", input.sha256}, {"at", placeOf(input)}});
    }
    return index;
}

/// The commands that measured the runs, without duplicates.
std::set<std::vector<std::string>> commandsOf(const fs::path& results, const results::StoredRuns& runs) {
    std::set<std::vector<std::string>> commands;
    for (const auto& [id, run] : runs) {
        const Json json = Json::parse(files::wholeText(results / "runs" / id / "run.json", "a run.json"));
        commands.insert(json.at("provenance").at("argv").get<std::vector<std::string>>());
    }
    return commands;
}

/// The arguments after the subcommand `name`; empty if it is another subcommand.
std::vector<std::string> wordsOf(const std::vector<std::string>& command, std::string_view name) {
    const auto word = std::ranges::find(command, name);
    return word == command.end() ? std::vector<std::string>() : std::vector<std::string>(word + 1, command.end());
}

/// The file of the suite named on a `dustbench suite` command line.
std::vector<fs::path> suiteOf(const std::vector<std::string>& words, const std::vector<SuiteFile>& known) {
    for (const std::string& word : words) {
        if (word.starts_with('-')) continue;
        if (files::isDataFile(word, ".toml") && fs::is_regular_file(word)) return {fs::path(word)};
        const auto found = std::ranges::find(known, word, &SuiteFile::id);
        if (found != known.end()) return {found->file};
    }
    return {};
}

/// The suites of the papers named on a `dustbench reproduce` command line; of all papers if it names none.
std::vector<fs::path> suitesOfPapers(const std::vector<std::string>& words, const std::vector<SuiteFile>& known) {
    std::vector<fs::path> named, all;
    for (const SuiteFile& suite : known) {
        if (suite.paper.empty()) continue;
        all.push_back(suite.file);
        const bool isNamed = std::ranges::any_of(
            words, [&](const std::string& word) { return word == suite.paper || word == "--paper=" + suite.paper; });
        if (isNamed) named.push_back(suite.file);
    }
    return named.empty() ? all : named;
}

void addSuites(const std::set<std::vector<std::string>>& commands, Contents& contents, PackedBundle& packed) {
    const std::vector<SuiteFile> known = listSuites();
    std::set<fs::path> suites;
    for (const std::vector<std::string>& command : commands) {
        const auto ofSuite = wordsOf(command, "suite"), ofPaper = wordsOf(command, "reproduce");
        if (std::ranges::find(command, "measure-machine") != command.end())
            for (fs::path& file : machinePlanFiles()) suites.insert(std::move(file));
        const auto found = ofSuite.empty() ? std::vector<fs::path>() : suiteOf(ofSuite, known);
        suites.insert(found.begin(), found.end());
        if (!ofSuite.empty() && found.empty())
            packed.missing.push_back(fmt::format("the suite of `{}` no longer exists", fmt::join(command, " ")));
        if (ofSuite.empty() && !ofPaper.empty())
            for (fs::path& file : suitesOfPapers(ofPaper, known)) suites.insert(std::move(file));
    }
    for (const fs::path& file : suites)
        if (!contents.emplace("suites/" + file.filename().string(), file).second)
            packed.missing.push_back(
                fmt::format("suite '{}': the bundle already contains a suite with this name", file.string()));
}

Json indexHead(const std::set<std::vector<std::string>>& commands) {
    const measure::BuildFacts build = measure::buildFacts();
    return {{"bundle", layout}, {"version", build.version}, {"git_commit", build.gitCommit}, {"commands", commands}};
}

void writeArchive(const Contents& contents, const std::string& index, const std::string& top, TarWriter& tar,
                  PackedBundle& packed) {
    std::string sums;
    for (const auto& [name, file] : contents) {
        if (name.find('\n') != std::string::npos)
            throw InputError(fmt::format("'{}': its name contains a line break", file.string()));
        tar.add(top + name, file);
        sums += fmt::format("{}  {}\n", measure::sha256OfFile(file, std::uintmax_t(-1)), name);
        packed.bytes += fs::file_size(file);
    }
    tar.addText(top + indexName, index);
    sums += fmt::format("{}  {}\n", measure::sha256(index), indexName);
    tar.addText(top + sumsName, sums);
    packed.files = contents.size() + 2;
}

// opening

/// Parses lines of `<sum>  <name>`; sums by name.
std::map<std::string, std::string> readSums(const fs::path& file) {
    constexpr std::size_t digits = 64;
    std::istringstream lines(files::wholeText(file, "a bundle's checksums"));
    std::map<std::string, std::string> sums;
    for (std::string line; std::getline(lines, line);) {
        if (line.size() < digits + 3 || line.compare(digits, 2, "  ") != 0)
            throw InputError(fmt::format("'{}': line '{}', expected a SHA-256 and a name", file.string(), line));
        sums[line.substr(digits + 2)] = line.substr(0, digits);
    }
    return sums;
}

/// The folder that contains all entries.
std::string topOf(const fs::path& archive, const std::vector<std::string>& names) {
    const std::string top = names.empty() ? "" : names.front().substr(0, names.front().find('/') + 1);
    const bool isBundle = !top.empty() && std::ranges::find(names, top + sumsName) != names.end() &&
                          std::ranges::all_of(names, [&](const std::string& name) { return name.starts_with(top); });
    if (!isBundle)
        throw InputError(
            fmt::format("'{}': is not a bundle, expected one folder that contains {}", archive.string(), sumsName));
    return top;
}

void checkSums(const fs::path& folder, const std::string& top, const std::vector<std::string>& names) {
    std::map<std::string, std::string> sums = readSums(folder / sumsName);
    for (const std::string& entry : names) {
        const std::string name = entry.substr(top.size());
        if (name == sumsName) continue;
        const auto sum = sums.find(name);
        if (sum == sums.end())
            throw InputError(fmt::format("'{}': is in the bundle but not listed in {}", name, sumsName));
        if (measure::sha256OfFile(folder / name, std::uintmax_t(-1)) != sum->second)
            throw InputError(fmt::format("'{}': was altered, its SHA-256 differs from that in {}", name, sumsName));
        sums.erase(sum);
    }
    if (!sums.empty()) throw InputError(fmt::format("'{}': is missing from the bundle", sums.begin()->first));
}

/// Checks that the bundle contains the inputs of every run, as the run read them.
void checkInputs(const OpenedBundle& bundle) {
    for (const measure::InputHash& input : inputsOf(bundle.runs)) {
        const fs::path file = bundle.folder / placeOf(input);
        if (measure::sha256OfFile(file) != input.sha256)
            throw InputError(fmt::format("'{}': differs from the '{}' that the runs read", placeOf(input), input.file));
    }
}

// repeating

/// Settings that do not affect the state get the defaults of RunSpec.
results::RunSpec specOf(const results::StoredRun& run) {
    results::RunSpec spec = results::specFromKey(run);
    const results::RunSpec usual;
    // The dust of a GPU may differ in its last bits: where it was, not where it may be now.
    if (const auto place = run.provenance.find("dust_on"); place != run.provenance.end())
        if (const auto known = results::dustPlaces.find(place->second); known && *known == results::DustOn::gpu)
            spec.dustOn = *known;
    spec.threads = usual.threads;
    spec.sync = usual.sync;
    spec.timed = usual.timed;
    spec.imagesEvery = usual.imagesEvery;
    spec.repetition = usual.repetition;
    return spec;
}

}  // namespace

PackedBundle packBundle(const fs::path& results, const fs::path& archive) {
    const results::StoredRuns runs = results::readStoredRuns(results);
    PackedBundle packed;
    Contents contents;
    addResults(results, contents);
    const std::set<std::vector<std::string>> commands = commandsOf(results, runs);
    Json index = indexHead(commands);
    index["inputs"] = addInputs(inputsOf(runs), contents);
    addSuites(commands, contents, packed);
    exports::WholeFile whole(archive);
    TarWriter tar(whole.temporaryPath());
    writeArchive(contents, index.dump(1) + "\n", archive.stem().string() + "/", tar, packed);
    tar.finish();
    whole.publish();
    return packed;
}

OpenedBundle openBundle(const fs::path& archive, const fs::path& below) {
    const std::vector<std::string> names = extractTar(archive, below);
    const std::string top = topOf(archive, names);
    OpenedBundle bundle{below / top, names.size(), {}};
    checkSums(bundle.folder, top, names);
    bundle.runs = results::readStoredRuns(bundle.folder / "results");
    checkInputs(bundle);
    return bundle;
}

std::vector<ExactRun> exactRuns(const results::StoredRuns& runs) {
    std::vector<ExactRun> exact;
    std::map<std::string, std::size_t> places;  // by key
    for (const auto& [id, run] : runs) {
        if (run.status != results::RunStatus::done || run.stateHash.empty()) continue;
        results::RunSpec spec = specOf(run);
        const auto [place, isNew] = places.try_emplace(results::canonicalKey(spec), exact.size());
        if (isNew) exact.push_back({{}, run.stateHash, run.methodHash, std::move(spec)});
        ExactRun& one = exact[place->second];
        if (const std::string difference = hashDifference(run, one); !difference.empty())
            throw InputError(
                fmt::format("run '{}': {}, as in run '{}' of the same simulation", id, difference, one.runIds.front()));
        one.runIds.push_back(id);
    }
    return exact;
}

std::string hashDifference(const results::StoredRun& got, const ExactRun& expected) {
    std::vector<std::string> differences;
    const auto compare = [&](const char* name, const std::string& mine, const std::string& wanted) {
        const auto shown = [](const std::string& hash) { return hash.empty() ? "none" : hash; };
        if (mine != wanted)
            differences.push_back(fmt::format("{} is {}, expected {}", name, shown(mine), shown(wanted)));
    };
    compare("state_hash", got.stateHash, expected.stateHash);
    compare("method_hash", got.methodHash, expected.methodHash);
    return fmt::format("{}", fmt::join(differences, "; "));
}

}  // namespace dustbench::suite
