#include "bench/measure/provenance.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <thread>

#include "bench/measure/sha256.h"
#include "build_facts_values.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/memory/available_memory.h"

namespace dustbench::measure {
namespace {

std::string firstLine(const char* file) {
    std::string line;
    std::ifstream stream(file);
    std::getline(stream, line);
    return line;
}

std::string cpuModel() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) {
            const auto colon = line.find(": ");
            if (colon != std::string::npos) return line.substr(colon + 2);
        }
    return {};
}

bool hasHypervisor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("flags")) return (line + " ").find(" hypervisor ") != std::string::npos;
    return false;
}

/// The eighth number of the first line is steal time: the machine was runnable but the host did not run it.
double stolenShareSinceBoot() {
    std::ifstream file("/proc/stat");
    std::string name;
    file >> name;
    double sum = 0, stolen = 0, ticks = 0;
    for (int field = 1; field <= 8 && file >> ticks; ++field) {
        sum += ticks;
        stolen = field == 8 ? ticks : 0;
    }
    return sum > 0 ? stolen / sum : 0;
}

/// CPU quota of a container, from cgroups version 2 or 1.
double quotaCores() {
    std::string quota;
    double allowed = 0, period = 0;
    if (std::ifstream file("/sys/fs/cgroup/cpu.max"); file >> quota >> period && quota != "max")
        allowed = std::strtod(quota.c_str(), nullptr);
    else if (std::ifstream older("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"); older >> allowed)
        std::ifstream("/sys/fs/cgroup/cpu/cpu.cfs_period_us") >> period;
    return allowed > 0 && period > 0 ? allowed / period : 0;
}

int usableCores() {
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) return CPU_COUNT(&set);
    return static_cast<int>(std::thread::hardware_concurrency());
}

/// The NT_GNU_BUILD_ID note that the linker wrote into the program.
std::string ownBuildId() {
    std::string id;
    const auto lookAt = [](dl_phdr_info* object, std::size_t, void* result) {
        for (int i = 0; i < object->dlpi_phnum; ++i) {
            const ElfW(Phdr)& segment = object->dlpi_phdr[i];
            if (segment.p_type != PT_NOTE) continue;
            const auto* at = reinterpret_cast<const char*>(object->dlpi_addr + segment.p_vaddr);
            const char* const end = at + segment.p_memsz;
            while (at + sizeof(ElfW(Nhdr)) <= end) {
                ElfW(Nhdr) note;
                std::memcpy(&note, at, sizeof note);
                const char* const name = at + sizeof note;
                const auto padded = [&](std::size_t size) { return (size + 3) / 4 * 4; };
                const char* const content = name + padded(note.n_namesz);
                if (note.n_type == NT_GNU_BUILD_ID &&
                    std::string_view(name, note.n_namesz) == std::string_view("GNU\0", 4))
                    for (std::size_t byte = 0; byte < note.n_descsz; ++byte)
                        *static_cast<std::string*>(result) +=
                            fmt::format("{:02x}", static_cast<unsigned char>(content[byte]));
                at = content + padded(note.n_descsz);
            }
        }
        return 1;  // the first object is the program itself
    };
    dl_iterate_phdr(lookAt, &id);
    return id;
}

/// The path within its data folder, which is the same on every machine; the absolute path of other files.
std::string nameOfInput(const std::filesystem::path& file) {
    const auto whole = std::filesystem::absolute(file).lexically_normal();
    for (const std::filesystem::path& folder : files::dataFolders()) {
        const auto inside = whole.lexically_relative(folder.lexically_normal());
        if (!inside.empty() && *inside.begin() != "..") return inside.generic_string();
    }
    return whole.generic_string();
}

}  // namespace

Machine readMachine() {
    Machine machine;
    machine.cpu = cpuModel();
    machine.governor = firstLine("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
    machine.cores = usableCores();
    machine.ramBytes = bytesInKernelFile("/proc/meminfo", "MemTotal:").value_or(0);
    utsname names{};
    if (uname(&names) == 0) machine.kernel = std::string(names.sysname) + " " + names.release + " " + names.machine;
    double load = 0;
    if (getloadavg(&load, 1) == 1) machine.loadAverage = load;
    machine.virtualMachine = hasHypervisor();
    machine.stolenShare = stolenShareSinceBoot();
    machine.quotaCores = quotaCores();
    std::ifstream("/sys/devices/system/cpu/cpu0/thermal_throttle/core_throttle_count") >> machine.throttled;
    return machine;
}

std::vector<std::string> disturbances(const Machine& machine) {
    std::vector<std::string> list;
    const auto add = [&list](std::string sentence) { list.push_back(std::move(sentence)); };
    if (!machine.governor.empty() && machine.governor != "performance")
        add(
            fmt::format("the CPU's frequency governor is '{}', not 'performance' (as root: cpupower frequency-set -g "
                        "performance)",
                        machine.governor));
    if (machine.loadAverage > 0.25 * machine.cores)
        add(fmt::format("the machine is busy: load average {:.2f} on {} cores (stop other programs and wait a minute)",
                        machine.loadAverage, machine.cores));
    if (machine.quotaCores > 0 && machine.quotaCores < machine.cores)
        add(
            fmt::format("the container may use {:.2f} cores but sees {} (assign whole cores: --cpuset-cpus "
                        "instead of --cpus)",
                        machine.quotaCores, machine.cores));
    if (machine.stolenShare > 0.005)
        add(
            fmt::format("the host has taken {:.1f} % of this virtual machine's CPU time since boot (use a machine that "
                        "is not shared, or more repetitions)",
                        100 * machine.stolenShare));
    if (machine.throttled > 0)
        add(
            fmt::format("the CPU has been throttled {} times since boot (improve the cooling, or set cooldown_s in "
                        "the suite)",
                        machine.throttled));
    return list;
}

BuildFacts buildFacts() {
    return {built::version, built::commit, built::dirty, built::compiler, built::flags, built::buildType, ownBuildId()};
}

std::string drawingEnvironment(const char* const* variables) {
    constexpr std::array<std::string_view, 25> beginnings{
        "MESA_", "LP_",  "GALLIUM_", "GALLIVM_", "LIBGL_",    "DRAW_", "DRI_",   "EGL_",  "GLSL_",
        "GLX_",  "NIR_", "ST_DEBUG", "ZINK_",    "SOFTPIPE_", "LLVM_", "__EGL_", "__GL_", "__GLX_",
        "RADV_", "AMD_", "INTEL_",   "NOUVEAU_", "TBB_",      "OMP_",  "VK_"};
    constexpr std::array<std::string_view, 4> names{"mesa_glthread", "vblank_mode", "force_glsl_version", "LD_PRELOAD"};
    std::set<std::string> found;
    for (; variables && *variables; ++variables) {
        const std::string_view variable(*variables), name = variable.substr(0, variable.find('='));
        if (std::ranges::any_of(beginnings, [&](std::string_view each) { return name.starts_with(each); }) ||
            std::ranges::find(names, name) != names.end())
            found.insert(files::printable(variable.substr(0, 1'000)));
    }
    return fmt::format("{}", fmt::join(found, " "));
}

Provenance startProvenance(std::vector<std::string> argv, bool measuresTimes) {
    Provenance provenance;
    provenance.argv = std::move(argv);
    provenance.build = buildFacts();
    provenance.machine = readMachine();
    provenance.clock = measureClockCost();
    provenance.environment = drawingEnvironment(environ);
    provenance.startedUtc = fmt::format(
        "{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
    if (measuresTimes) provenance.warnings = disturbances(provenance.machine);
    if (provenance.build.buildType != "Release")
        provenance.warnings.push_back("not a release build: " + provenance.build.buildType);
    if (provenance.build.flags.find("-fsanitize") != std::string::npos)
        provenance.warnings.push_back("built with a sanitizer");
    if (provenance.build.gitDirty) provenance.warnings.push_back("built from a tree with uncommitted changes");
    return provenance;
}

std::vector<InputHash> hashInputs(const std::vector<std::filesystem::path>& inputs) {
    std::vector<InputHash> hashes;
    std::map<std::string, std::filesystem::path> files;  // a mesh may be used more than once, under different names
    for (const std::filesystem::path& file : inputs) files.try_emplace(nameOfInput(file), file);
    hashes.reserve(files.size());
    for (const auto& [name, file] : files) hashes.push_back({name, sha256OfFile(file)});
    return hashes;
}

std::vector<IgnoredParts> ignoredParts(const std::map<std::filesystem::path, std::vector<std::string>>& ofFiles) {
    std::vector<IgnoredParts> list;
    list.reserve(ofFiles.size());
    for (const auto& [file, parts] : ofFiles) list.push_back({nameOfInput(file), parts});
    return list;
}

std::string saysIgnored(const std::vector<IgnoredParts>& ignored) {
    std::string line;
    std::vector<std::vector<std::string>> said;
    for (const IgnoredParts& each : ignored) {
        if (std::ranges::find(said, each.parts) != said.end()) continue;
        said.push_back(each.parts);
        const auto others = std::ranges::count(ignored, each.parts, &IgnoredParts::parts) - 1;
        line +=
            fmt::format("{}{}{}: {}", line.empty() ? "" : "; ", std::filesystem::path(each.file).filename().string(),
                        others == 0 ? "" : fmt::format(" and {} other {}", others, others == 1 ? "file" : "files"),
                        fmt::join(each.parts, ", "));
    }
    return line;
}

std::string hashOfFoundNames(const std::filesystem::path& path) {
    std::string names;
    for (const std::filesystem::path& file : files::foundFiles(path)) names += file.filename().string() + '\n';
    return sha256(names);
}

std::vector<InputHash> hashSearches(const std::vector<std::filesystem::path>& paths) {
    std::vector<InputHash> hashes;
    hashes.reserve(paths.size());
    for (const std::filesystem::path& path : paths) hashes.push_back({path.generic_string(), hashOfFoundNames(path)});
    return hashes;
}

std::vector<std::string> commandLine() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    std::vector<std::string> words;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t end = bytes.find('\0', at);
        words.push_back(bytes.substr(at, end - at));
        if (end == std::string::npos) break;
        at = end + 1;
    }
    return words;
}

}  // namespace dustbench::measure
