#include "bench/results/freshness.h"

#include <exception>

#include "bench/measure/sha256.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/matching_files.h"

namespace dustbench::results {

const std::string& Freshness::hashOf(const std::string& input) {
    const auto [entry, isNew] = hashes_.try_emplace(input);
    if (isNew) try {
            const std::filesystem::path file = files::dataPath(input);  // an absolute path stays as it is
            if (!file.empty()) entry->second = measure::sha256OfFile(file);
        } catch (const std::exception&) {
            entry->second.clear();
        }
    return entry->second;
}

std::string Freshness::whyOutdated(const StoredRun& run) {
    if (run.status != RunStatus::done && run.status != RunStatus::skipped) return {};
    const auto build = run.provenance.find("build_id");
    if (build == run.provenance.end() || build->second != buildId_) {
        const auto commit = run.provenance.find("git_commit");
        const bool known = commit != run.provenance.end() && !commit->second.empty();
        return "measured by another build of dustbench" + (known ? ", commit " + commit->second.substr(0, 12) : "");
    }
    for (const measure::InputHash& input : run.inputs) {
        const std::string& now = hashOf(input.file);
        if (now.empty()) return input.file + " can no longer be read";
        if (now != input.sha256) return input.file + " has changed since";
    }
    for (const measure::InputHash& search : run.searches) {
        const auto [entry, isNew] = names_.try_emplace(search.file);
        if (isNew) entry->second = measure::hashOfFoundNames(search.file);
        if (entry->second == search.sha256) continue;
        if (files::isPattern(search.file)) return "other files now match " + search.file;
        return search.file + " did not exist and now does";
    }
    return {};
}

}  // namespace dustbench::results
