#include "bench/results/results_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>
#include <set>
#include <thread>

#include "bench/results/compared_runs.h"
#include "bench/results/stored_run.h"
#include "bench/results/summary.h"
#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::results {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view hiddenStart = ".unfinished-";
constexpr std::string_view oldStart = ".replaced-";
constexpr std::string_view asideStart = ".damaged-";
constexpr std::string_view references = ".references";

/// Removes a folder. Retries, because a run whose program was just killed may write one last file into it.
void removeLeft(const fs::path& folder) {
    std::error_code error;
    for (int attempt = 0; attempt < 20; ++attempt) {
        fs::remove_all(folder, error);
        if (error != std::errc::directory_not_empty) break;
        std::this_thread::sleep_for(std::chrono::milliseconds(25));
    }
    if (error) throw fs::filesystem_error("remove", folder, error);
}

}  // namespace

ResultsFolder::ResultsFolder(fs::path folder) : folder_(std::move(folder)) {
    if (folder_.empty()) throw InputError("output: got an empty name, expected a folder");
    const fs::path runs = folder_ / "runs";
    std::error_code error;
    isNew_ = !fs::exists(folder_, error);
    fs::create_directories(runs, error);
    if (error) files::failWriting(folder_, error.value());
    for (const fs::path& each : {folder_, runs})
        if (access(each.c_str(), W_OK | X_OK) != 0) files::failWriting(each, errno);

    lock_ = open(runs.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock_ < 0) files::failWriting(runs, errno);
    // The lock of a program that was just killed is released a moment later, when its child process has ended too.
    for (int attempt = 0; attempt < 10 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++attempt)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        const int why = errno;
        close(lock_);
        if (why == EWOULDBLOCK) throw exports::cannotWrite(folder_, "another dustbench is writing into it");
        files::failWriting(folder_, why);
    }

    try {
        cleanUp();
        readRuns();
        addMethodTimes(runs_);
    } catch (const fs::filesystem_error& failure) {
        close(lock_);
        files::failWriting(folder_, failure.code().value());
    } catch (...) {
        close(lock_);
        throw;
    }
}

void ResultsFolder::cleanUp() {
    std::vector<fs::path> left;
    for (const auto& entry : fs::directory_iterator(folder_ / "runs"))
        if (const std::string name = entry.path().filename();
            name.starts_with(hiddenStart) || name.starts_with(oldStart) || name == references)
            left.push_back(entry.path());
    for (const fs::path& path : left) {
        const std::string name = path.filename();
        // If `publish` was killed between its two renames, the old result is restored.
        if (name.starts_with(oldStart) && !fs::exists(runFolder(name.substr(oldStart.size()))))
            fs::rename(path, runFolder(name.substr(oldStart.size())));
        else
            removeLeft(path);
    }
}

void ResultsFolder::readRuns() {
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(folder_ / "runs"))
        if (!entry.path().filename().string().starts_with('.') && fs::exists(entry.path() / "run.json"))
            folders.push_back(entry.path());
    for (const fs::path& folder : folders) {
        const std::string name = folder.filename();
        try {
            runs_[name] = readRunFolder(folder);
        } catch (const InputError& damage) {
            fs::path aside = folder.parent_path() / fmt::format("{}{}", asideStart, name);
            for (int i = 2; fs::exists(aside); ++i)
                aside = folder.parent_path() / fmt::format("{}{}-{}", asideStart, name, i);
            fs::rename(folder, aside);
            setAside_.push_back(fmt::format("{}; set aside as {}", damage.what(), aside.string()));
        }
    }
}

ResultsFolder::~ResultsFolder() {
    std::error_code error;
    const auto entriesOf = [&error](const fs::path& folder) {
        return std::distance(fs::directory_iterator(folder, error), fs::directory_iterator());
    };
    const fs::path runs = folder_ / "runs";
    fs::remove_all(runs / references, error);
    if (isNew_ && entriesOf(folder_) == 1 && entriesOf(runs) == 0 && fs::remove(runs, error))
        fs::remove(folder_, error);
    close(lock_);
}

fs::path ResultsFolder::hidden(const std::string& runId) const {
    return folder_ / "runs" / fmt::format("{}{}", hiddenStart, runId);
}

fs::path ResultsFolder::beginRun(const std::string& runId) {
    std::error_code error;
    fs::remove_all(hidden(runId), error);
    fs::create_directory(hidden(runId), error);
    if (error) files::failWriting(hidden(runId), error.value());
    return hidden(runId);
}

void ResultsFolder::publish(const std::string& runId) {
    place(runId);
    writeSummary();
}

void ResultsFolder::place(const std::string& runId) {
    StoredRun run = readRunFile(hidden(runId) / "run.json");
    exports::putOnDisk(hidden(runId));
    const fs::path old = folder_ / "runs" / fmt::format("{}{}", oldStart, runId);
    std::error_code error;
    if (fs::exists(runFolder(runId))) {
        fs::remove_all(old, error);
        fs::rename(runFolder(runId), old, error);
        if (error) files::failWriting(runFolder(runId), error.value());
    }
    fs::rename(hidden(runId), runFolder(runId), error);
    if (error) files::failWriting(runFolder(runId), error.value());
    exports::putNameOnDisk(runFolder(runId));
    fs::remove_all(old, error);
    runs_[runId] = std::move(run);
}

void ResultsFolder::discard(const std::string& runId) {
    std::error_code error;
    fs::remove_all(hidden(runId), error);
}

void ResultsFolder::writeSummary() {
    addMethodTimes(runs_);
    exports::writeWhole(folder_ / "summary.csv", summaryCsv(runs_));
}

fs::path referencesBeside(const fs::path& runFolder) {
    return runFolder.parent_path() / references;
}

std::string summaryCsv(const StoredRuns& runs) {
    std::set<std::string> parameters;
    for (const auto& [id, run] : runs)
        for (const auto& [name, text] : run.parameters) parameters.insert(name);

    std::string text;
    for (const std::string& name : columnsBeforeParameters()) text.append(name).append(1, ',');
    for (const std::string& name : parameters) text.append(files::csvCell(fmt::format("p.{}", name))).append(1, ',');
    for (const std::string& name : columnsAfterParameters()) text.append(name).append(1, ',');
    text.back() = '\n';

    for (const auto& [id, run] : runs) {
        std::string row;
        const auto add = [&row](std::string_view cell) { row.append(files::csvCell(cell)).append(1, ','); };
        const auto cellOf = [&run = run](const std::string& name) {
            const auto found = run.cells.find(name);
            return found == run.cells.end() ? std::string() : found->second;
        };
        for (const std::string& name : columnsBeforeParameters()) add(cellOf(name));
        for (const std::string& name : parameters) {
            const auto found = run.parameters.find(name);
            add(found == run.parameters.end() ? std::string() : found->second);
        }
        for (const std::string& name : columnsAfterParameters()) add(cellOf(name));
        row.back() = '\n';
        text += row;
    }
    return text;
}

}  // namespace dustbench::results
