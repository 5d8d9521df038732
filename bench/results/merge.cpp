#include "bench/results/merge.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <map>

#include "methods/contract/errors.h"

namespace dustbench::bench {
namespace fs = std::filesystem;
namespace {

/// Sizes of all files below the run's folder, by relative name.
std::map<std::string, std::uintmax_t> filesOf(const fs::path& run) {
    std::map<std::string, std::uintmax_t> sizes;
    for (const auto& entry : fs::recursive_directory_iterator(run))
        if (!entry.is_directory()) sizes[entry.path().lexically_relative(run)] = entry.file_size();
    return sizes;
}

std::string contentOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void requireEqual(const std::string& runId, const fs::path& first, const fs::path& second) {
    if (contentOf(first / "run.json") == contentOf(second / "run.json") && filesOf(first) == filesOf(second)) return;
    throw InputError(fmt::format("run '{}': got two different results, '{}' and '{}', allowed: one; remove either",
                                 runId, first.string(), second.string()));
}

}  // namespace

MergePlan planMerge(const std::vector<MergeSource>& sources, const ResultsFolder& results) {
    MergePlan plan;
    std::map<std::string, fs::path> places;
    for (const auto& [id, run] : results.runs()) places[id] = results.runFolder(id);
    for (const auto& [source, runs] : sources)
        for (const auto& [id, run] : runs) {
            const fs::path from = source / "runs" / id;
            try {
                const auto [known, isNew] = places.emplace(id, from);
                if (isNew) {
                    plan.copies.push_back({id, from});
                    for (const auto& [name, bytes] : filesOf(from)) plan.bytes += bytes;
                } else {
                    requireEqual(id, known->second, from);
                    ++plan.there;
                }
            } catch (const fs::filesystem_error& error) {
                throw InputError(fmt::format("'{}': cannot be read: {}", from.string(), error.code().message()));
            }
        }
    return plan;
}

void requireSpace(const MergePlan& plan, const fs::path& folder, std::uintmax_t availableBytes) {
    if (plan.bytes > availableBytes)
        throw InputError(fmt::format("output '{}': {} runs of {} bytes do not fit into the {} bytes that are free",
                                     folder.string(), plan.copies.size(), plan.bytes, availableBytes));
}

bool merge(const MergePlan& plan, ResultsFolder& results, const std::function<bool()>& interrupted) {
    for (const MergePlan::Copy& copy : plan.copies) {
        if (interrupted()) {
            results.writeSummary();
            return false;
        }
        const fs::path hidden = results.beginRun(copy.runId);
        std::error_code error;
        fs::copy(copy.from, hidden, fs::copy_options::recursive, error);
        if (error) {
            results.discard(copy.runId);
            throw InputError(fmt::format("'{}': cannot be copied to '{}': {}", copy.from.string(),
                                         results.path().string(), error.message()));
        }
        results.place(copy.runId);
    }
    results.writeSummary();
    return true;
}

}  // namespace dustbench::bench
