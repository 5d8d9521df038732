#include "bench/suite/method_libraries.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <regex>
#include <system_error>

#include "methods/contract/errors.h"
#include "methods/contract/registry.h"
#include "methods/kit/library/build_fingerprint.h"
#include "methods/kit/library/method_entry.h"
#include "methods/kit/particles/part.h"

namespace dustbench::suite {

namespace fs = std::filesystem;
namespace {

constexpr const char* variable = "DUSTBENCH_METHOD_PATH";
constexpr std::string_view ending = ".dustmethod.so";

std::vector<MethodLibrary>& libraries() {
    static std::vector<MethodLibrary> list;
    return list;
}

std::vector<std::string> partsOf(std::string_view text, char separator) {
    std::vector<std::string> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        if (end > 0) parts.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

std::string checkedFolder(std::string_view option, const std::string& named) {
    if (!fs::is_directory(named))
        throw InputError(
            fmt::format("{}: '{}': no such folder, expected a folder of libraries *{}", option, named, ending));
    if (named.find(':') != std::string::npos)
        throw InputError(fmt::format("{}: '{}': contains a ':', which separates folders", option, named));
    return fs::canonical(named).string();
}

std::vector<fs::path> folders() {
    std::vector<fs::path> list;
    const char* named = std::getenv(variable);
    for (const std::string& folder : partsOf(named ? named : "", ':'))
        list.emplace_back(checkedFolder(variable, folder));
    const fs::path installed = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "lib/dustbench/methods";
    if (fs::is_directory(installed)) list.push_back(installed);
    return list;
}

/// Libraries of a folder, by id, including dangling links.
std::vector<MethodLibrary> librariesIn(const fs::path& folder) {
    std::vector<MethodLibrary> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        std::error_code error;
        const bool isFile = entry.is_regular_file(error) || !entry.exists(error);
        if (name.size() <= ending.size() || !name.ends_with(ending) || !isFile) continue;
        found.push_back({fs::absolute(entry.path()), name.substr(0, name.size() - ending.size()), {}});
    }
    std::ranges::sort(found, {}, &MethodLibrary::id);
    return found;
}

/// Describes a library; returns why it cannot be used, or an empty text. It stays loaded, because methods and parts
/// refer to its code.
std::string describeBy(const library::MethodEntry& entry, const std::string& id, LibraryContents& contents) {
    static const std::string own = library::buildFingerprint();
    if (entry.api != library::methodApi)
        return fmt::format("built for version {} of the interface, expected {}: build it against this dustbench",
                           entry.api, library::methodApi);
    if (const std::string difference = fingerprintDifference(entry.fingerprint, own); !difference.empty())
        return "built with other settings than this program: " + difference;
    if (id != entry.id) return fmt::format("its id is '{}', expected '{}' as in the file name", entry.id, id);
    try {
        if (entry.describe != nullptr) entry.describe(&contents.method.emplace());
        if (entry.describeParts != nullptr) entry.describeParts(&contents.parts);
    } catch (const std::exception& error) {
        return fmt::format("its describe() failed: {}", error.what());
    }
    const bool isWhole = (!contents.method || contents.method->create) &&
                         std::ranges::all_of(contents.parts, [](const auto& part) { return part.create != nullptr; });
    return isWhole ? "" : "its describe() sets no create";
}

std::string lastLoaderError() {
    const char* text = dlerror();
    return text == nullptr ? "cannot be loaded" : text;
}

/// Checks first that the names of all parts are new, so that a library is added completely or not at all. Throws
/// InputError.
void addContents(LibraryContents contents, const MethodLibrary& library) {
    for (const particles::PartInfo& part : contents.parts) particles::requireNewPart(part);
    if (contents.method) {
        contents.method->id = library.id;
        contents.method->library = library.file.string();
        addMethod(std::move(*contents.method));
    }
    for (particles::PartInfo& part : contents.parts) {
        part.library = library.file.string();
        particles::addPart(std::move(part));
    }
}

/// Loads the library in a child first: it may end its process, as libraries with sanitizers do.
std::string whyNotTaken(const MethodLibrary& library) {
    static const std::regex allowed("[a-z][a-z0-9_]*");
    if (!std::regex_match(library.id, allowed))
        return "its name contains characters other than lower-case letters, digits and '_'";
    LibraryContents contents;
    std::string whyNot = triedInChild([&] { return loadLibrary(library.file, library.id, contents); });
    if (whyNot.empty()) whyNot = loadLibrary(library.file, library.id, contents);
    if (whyNot.empty()) try {
            addContents(std::move(contents), library);
        } catch (const InputError& error) {
            whyNot = error.what();
        }
    return whyNot;
}

void add(MethodLibrary library) {
    library.whyNot = whyNotTaken(library);
    if (!library.whyNot.empty()) noteRefusedMethod(library.id, library.file.string(), library.whyNot);
    libraries().push_back(std::move(library));
}

constexpr unsigned patienceSeconds = 60;

/// A temporary file without a name. Owns: its descriptor.
class Note {
 public:
    explicit Note(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), name);
    }
    ~Note() { close(descriptor_); }
    Note(const Note&) = delete;
    Note& operator=(const Note&) = delete;

    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] bool write(const std::string& text) const {
        return ::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    }
    /// Its first 64 KiB.
    [[nodiscard]] std::string text() const {
        std::string text(1 << 16, '\0');
        const ssize_t got = pread(descriptor_, text.data(), text.size(), 0);
        text.resize(got < 0 ? 0 : static_cast<std::size_t>(got));
        return text;
    }

 private:
    int descriptor_;
};

std::string lastLine(std::string text) {
    text.erase(text.find_last_not_of(" \n") + 1);
    const std::size_t before = text.rfind('\n');
    return before == std::string::npos ? text : text.substr(before + 1);
}

std::string howItEnded(int status, const std::string& errors) {
    std::string text = WIFSIGNALED(status)
                           ? fmt::format("a process that tried it ended by signal {} ({})", WTERMSIG(status),
                                         strsignal(WTERMSIG(status)))
                           : fmt::format("a process that tried it ended with exit code {}", WEXITSTATUS(status));
    if (const std::string line = lastLine(errors); !line.empty()) text += ": " + line;
    return text;
}

}  // namespace

void useMethodFolders(std::string_view option, const std::vector<std::string>& folders) {
    std::vector<std::string> checked;
    checked.reserve(folders.size());
    for (const std::string& folder : folders) checked.push_back(checkedFolder(option, folder));
    setenv(variable, fmt::format("{}", fmt::join(checked, ":")).c_str(), 1);
}

void loadMethodLibraries() {
    for (const fs::path& folder : folders())
        for (MethodLibrary& library : librariesIn(folder)) add(std::move(library));
    std::ranges::stable_sort(libraries(), {}, &MethodLibrary::id);
}

const std::vector<MethodLibrary>& methodLibraries() {
    return libraries();
}

std::string loadLibrary(const fs::path& file, const std::string& id, LibraryContents& contents) {
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) return lastLoaderError();
    void* const function = dlsym(library, library::methodEntryName);
    if (function == nullptr) {
        dlclose(library);
        return fmt::format("not a method library: it has no function {}", library::methodEntryName);
    }
    const library::MethodEntry* const entry = reinterpret_cast<library::MethodEntryFunction>(function)();
    return entry == nullptr ? "its entry function returns null" : describeBy(*entry, id, contents);
}

std::string fingerprintDifference(std::string_view got, std::string_view expected) {
    const auto facts = [](std::string_view text) {
        std::map<std::string, std::string> byName;
        for (const std::string& fact : partsOf(text, ';')) {
            const std::size_t equals = std::min(fact.find('='), fact.size());
            const std::string name = fact.substr(0, equals), value = fact.substr(std::min(equals + 1, fact.size()));
            byName[name] = value == name ? "undefined" : value.empty() ? "defined" : value;
        }
        return byName;
    };
    const auto has = facts(got), wants = facts(expected);
    std::vector<std::string> differences;
    const auto valueIn = [](const auto& map, const std::string& name) {
        const auto found = map.find(name);
        return found == map.end() ? std::string("unknown") : found->second;
    };
    for (const auto& [name, value] : wants)
        if (valueIn(has, name) != value)
            differences.push_back(fmt::format("{} is {}, expected {}", name, valueIn(has, name), value));
    for (const auto& [name, value] : has)
        if (!wants.contains(name)) differences.push_back(fmt::format("{} is {}, expected unknown", name, value));
    return fmt::format("{}", fmt::join(differences, "; "));
}

std::string triedInChild(const std::function<std::string()>& task) {
    constexpr int done = 113;  // no other exit code counts
    const Note result("result"), errors("errors");
    const pid_t child = fork();
    if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (child == 0) {
        alarm(patienceSeconds);
        dup2(errors.descriptor(), STDERR_FILENO);
        dup2(errors.descriptor(), STDOUT_FILENO);
        _exit(result.write(task()) ? done : 1);
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == done ? result.text() : howItEnded(status, errors.text());
}

}  // namespace dustbench::suite
