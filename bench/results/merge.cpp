#include "bench/results/merge.h"

#include <fmt/format.h>

#include <map>

#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::results {
namespace fs = std::filesystem;
namespace {

/// Refuses links: their targets may be anywhere and do not belong to the run.
void requireOwn(const fs::path& path, fs::file_type type) {
    if (type == fs::file_type::regular || type == fs::file_type::directory) return;
    throw InputError(fmt::format("'{}': is {}, allowed: regular files and folders", path.string(),
                                 type == fs::file_type::symlink ? "a symbolic link" : "not a regular file"));
}

/// Sizes of all files below the run's folder, by relative name.
std::map<std::string, std::uintmax_t> filesOf(const fs::path& run) {
    std::map<std::string, std::uintmax_t> sizes;
    requireOwn(run, fs::symlink_status(run).type());
    for (const auto& entry : fs::recursive_directory_iterator(run)) {
        requireOwn(entry.path(), entry.symlink_status().type());
        if (!entry.is_directory()) sizes[entry.path().lexically_relative(run)] = entry.file_size();
    }
    return sizes;
}

std::string contentOf(const fs::path& file) {
    return files::wholeText(file, "a run's record");
}

void requireEqual(const std::string& runId, const fs::path& first, const fs::path& second) {
    if (contentOf(first / "run.json") == contentOf(second / "run.json") && filesOf(first) == filesOf(second)) return;
    throw InputError(fmt::format("run '{}': has two different results, '{}' and '{}'; remove one of them", runId,
                                 first.string(), second.string()));
}

}  // namespace

MergePlan planMerge(const std::vector<MergeSource>& sources, const ResultsFolder& results) {
    MergePlan plan;
    std::map<std::string, fs::path> places;
    for (const auto& [id, run] : results.runs()) places[id] = results.runFolder(id);
    for (const auto& [source, runs] : sources) {
        requireOwn(source / "runs", fs::symlink_status(source / "runs").type());
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
    }
    return plan;
}

void requireSpace(const MergePlan& plan, const fs::path& folder, std::uintmax_t availableBytes) {
    if (plan.bytes > availableBytes)
        throw InputError(fmt::format("output '{}': {} runs need {} bytes, but only {} are free", folder.string(),
                                     plan.copies.size(), plan.bytes, availableBytes));
}

bool merge(const MergePlan& plan, ResultsFolder& results, const std::function<bool()>& interrupted) {
    for (const MergePlan::Copy& copy : plan.copies) {
        if (interrupted()) {
            results.writeSummary();
            return false;
        }
        const fs::path hidden = results.beginRun(copy.runId);
        std::error_code error;
        fs::copy(copy.from, hidden, fs::copy_options::recursive | fs::copy_options::skip_symlinks, error);
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

}  // namespace dustbench::results
