#include "methods/kit/files/input_log.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"

namespace dustbench::files {
namespace {

std::mutex guard;
InputLog* current = nullptr;

}  // namespace

InputLog::InputLog() {
    const std::scoped_lock lock(guard);
    if (current) throw std::logic_error("InputLog: one already exists");
    current = this;
}

InputLog::~InputLog() {
    const std::scoped_lock lock(guard);
    current = nullptr;
}

std::vector<std::filesystem::path> InputLog::files() const {
    const std::scoped_lock lock(guard);
    return {files_.begin(), files_.end()};
}

std::vector<std::filesystem::path> InputLog::searches() const {
    const std::scoped_lock lock(guard);
    return {searches_.begin(), searches_.end()};
}

std::map<std::filesystem::path, std::vector<std::string>> InputLog::ignored() const {
    const std::scoped_lock lock(guard);
    return ignored_;
}

void noteIgnored(const std::filesystem::path& file, const std::vector<std::string>& parts) {
    const std::scoped_lock lock(guard);
    if (!current || parts.empty()) return;
    std::vector<std::string>& known = current->ignored_[std::filesystem::absolute(file).lexically_normal()];
    for (const std::string& part : parts)
        if (std::ranges::find(known, part) == known.end()) known.push_back(part);
}

void noteSearch(const std::filesystem::path& path) {
    const std::scoped_lock lock(guard);
    if (current) current->searches_.insert(std::filesystem::absolute(path).lexically_normal());
}

void noteInput(const std::filesystem::path& file) {
    if (!isUtf8(file.native()))
        throw InputError(printable(file.native()) + ": the file's name is not UTF-8, as results require; rename it");
    const std::scoped_lock lock(guard);
    if (current) current->files_.insert(std::filesystem::absolute(file).lexically_normal());
}

}  // namespace dustbench::files
