// Reads mutated OpenVDB and NanoVDB files with readVectors(), readVolume(), readVdbPoints() and a sparse volume. A fork
// of this process, with OpenVDB already loaded, replaces the program dustbench_vdb_reader and reads file after file
// until one ends it.
//
//     vdb_mutants SEED CASES FOLDER
//
// The worker may end in any way, because OpenVDB trusts its input; the ends are counted. This process must read each
// file or refuse it in one line. Memory and processor time of a case are limited and reported.
#include <fcntl.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <stdio_ext.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>

#include "methods/contract/errors.h"
#include "methods/kit/volumes/openvdb/vdb_reader.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/volume_file.h"
#include "methods/volume/sparse/brick_reader.h"
#include "tests/fuzz/mutation.h"
#include "tests/fuzz/nano_ball.h"

// From AddressSanitizer's library; GCC 12 has no header for them.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*allocated)(const volatile void*,
                                                                           std::size_t),  // NOLINT
                                                         void (*freed)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* memory);  // NOLINT

namespace {

namespace fs = std::filesystem;

/// How cases ended: "exit 0", "signal 11" …
std::map<std::string, long> endings;

constexpr int tookTooMuch = 77;      ///< an exit code of the worker
constexpr int casesOfAWorker = 500;  ///< cases per worker: memory that OpenVDB does not free adds up

/// In the worker: memory allocated since the start of the case and not yet freed, and its limit. Without sanitizers,
/// RLIMIT_DATA is the limit.
std::size_t heldBytes = 0, allowedBytes = 0;
bool isWorker = false;

struct Ended {
    int code;
};

}  // namespace

// Linked with --wrap=_exit: instead of the process, the case ends.
extern "C" [[noreturn]] void __real__exit(int code);   // NOLINT
extern "C" [[noreturn]] void __wrap__exit(int code) {  // NOLINT
    if (isWorker) throw Ended{code};
    __real__exit(code);
}

namespace {

void countAllocated(const volatile void*, std::size_t bytes) {
    heldBytes += bytes;
    if (allowedBytes > 0 && heldBytes > allowedBytes) __real__exit(tookTooMuch);
}

void countFreed(const volatile void* memory) {
    if (memory) heldBytes -= std::min(heldBytes, __sanitizer_get_allocated_size(memory));
}

struct Request {
    char first[256], second[256];
};

/// The process that reads. Owns: the process and its pipes.
struct Worker {
    pid_t process = -1;
    int requests = -1, codes = -1, cases = 0;
    std::string answers;  ///< a FIFO in place of the output of dustbench_vdb_reader
} worker;

/// Processor time counts from the worker's start, so the limit is raised for each case.
void limitProcessorTime(const std::string& file) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    rlimit seconds{};
    getrlimit(RLIMIT_CPU, &seconds);
    seconds.rlim_cur = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1 +
                       dustbench::volumes::vdbProcessorSeconds(fs::file_size(file));
    setrlimit(RLIMIT_CPU, &seconds);
}

[[noreturn]] void work(int requests, int codes) {
    isWorker = true;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit noCore{0, 0};
    setrlimit(RLIMIT_CORE, &noCore);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    Request request{};
    while (read(requests, &request, sizeof request) == sizeof request) {
        const int answer = open(worker.answers.c_str(), O_WRONLY);
        dup2(answer, STDOUT_FILENO);
        close(answer);
        const std::string file = dustbench::volumes::vdbFile(request.first, request.second);
        limitProcessorTime(file);
        int code = 0;
        heldBytes = 0;
        allowedBytes = dustbench::volumes::vdbMemoryBytes(fs::file_size(file));
        try {
            dustbench::volumes::runVdbReader(request.first, request.second);
        } catch (const Ended& ended) {
            code = ended.code;
        }
        allowedBytes = 0;
        __fpurge(stdout);
        dup2(nowhere, STDOUT_FILENO);
        if (write(codes, &code, sizeof code) != sizeof code) break;
    }
    __real__exit(0);
}

void startWorker() {
    int requests[2], codes[2];
    if (pipe(requests) != 0 || pipe(codes) != 0) std::abort();
    worker.process = fork();
    if (worker.process < 0) std::abort();
    if (worker.process == 0) {
        close(requests[1]);
        close(codes[0]);
        work(requests[0], codes[1]);
    }
    close(requests[0]);
    close(codes[1]);
    worker.requests = requests[1];
    worker.codes = codes[0];
    worker.cases = 0;
}

}  // namespace

// Linked with --wrap=waitpid, to see the end of each case.
extern "C" pid_t __real_waitpid(pid_t process, int* status, int options);  // NOLINT

namespace {

/// Status of the worker, as from waitpid().
int endWorker() {
    close(worker.requests);
    close(worker.codes);
    int status = 0;
    if (__real_waitpid(worker.process, &status, 0) != worker.process) std::abort();
    worker.process = -1;
    return status;
}

}  // namespace

extern "C" pid_t __wrap_waitpid(pid_t process, int* status, int) {  // NOLINT
    int code = 0;
    if (read(worker.codes, &code, sizeof code) == sizeof code) {
        *status = W_EXITCODE(code, 0);
        if (++worker.cases == casesOfAWorker) (void)endWorker();
    } else {
        *status = endWorker();
    }
    ++endings[WIFEXITED(*status) ? "exit " + std::to_string(WEXITSTATUS(*status))
                                 : "signal " + std::to_string(WTERMSIG(*status))];
    return process;
}

namespace dustbench::volumes {

VdbPipe startVdbReader(const std::string& first, const std::string& second) {
    if (worker.process < 0) startWorker();
    Request request{};
    if (first.size() >= sizeof request.first || second.size() >= sizeof request.second) std::abort();
    first.copy(request.first, first.size());
    second.copy(request.second, second.size());
    if (write(worker.requests, &request, sizeof request) != sizeof request) std::abort();
    return {worker.process, open(worker.answers.c_str(), O_RDONLY)};
}

}  // namespace dustbench::volumes

namespace {

void writeVectors(const fs::path& file, std::uint32_t compression, bool half, int edge) {
    const auto grid = openvdb::Vec3SGrid::create();
    grid->setName("velocity");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    grid->setSaveFloatAsHalf(half);
    grid->insertMeta("time_s", openvdb::DoubleMetadata(1.5));
    auto accessor = grid->getAccessor();
    for (int i = 0; i < edge * edge * edge; ++i) {
        const openvdb::Coord at(i % edge, i / edge % edge, i / edge / edge);
        const auto x = static_cast<float>(i);
        accessor.setValue(at, {std::sin(x), std::cos(x), 0.01f * x});
    }
    const auto other = openvdb::FloatGrid::create();
    other->setName("density");
    other->getAccessor().setValue({1, 2, 3}, 0.5f);
    openvdb::io::File written(file.string());
    written.setCompression(compression);
    written.write({other, grid});
}

/// Fog in tiles and in leaves, with its temperature.
void writeFog(const fs::path& file) {
    const auto fog = openvdb::FloatGrid::create(), heat = openvdb::FloatGrid::create();
    fog->setName("density");
    heat->setName("temperature");
    fog->fill({{0, 0, 0}, {15, 7, 7}}, 0.5f);
    for (int i = 0; i < 40; ++i) {
        fog->getAccessor().setValue({i % 7, 20, i / 7}, 0.01f * static_cast<float>(i));
        heat->getAccessor().setValue({i % 7, 20, i / 7}, 300 + static_cast<float>(i));
    }
    openvdb::io::File(file.string()).write({fog, heat});
}

void writePoints(const fs::path& file, int count) {
    std::vector<openvdb::Vec3f> places;
    std::vector<float> radii;
    for (int i = 0; i < count; ++i) {
        places.emplace_back(0.1f * static_cast<float>(i % 10), 0.3f * static_cast<float>(i / 10), 0.0f);
        radii.push_back(0.01f * static_cast<float>(i + 1));
    }
    using namespace openvdb::points;
    const PointAttributeVector<openvdb::Vec3f> wrapper(places);
    const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
    const auto index = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(wrapper, *transform);
    const auto grid = createPointDataGrid<NullCodec, PointDataGrid>(*index, wrapper, *transform);
    appendAttribute<float>(grid->tree(), "pscale");
    const PointAttributeVector<float> radiusWrapper(radii);
    populateAttribute(grid->tree(), index->tree(), "pscale", radiusWrapper);
    openvdb::io::File(file.string()).write({grid});
}

/// Runs in a child, because OpenVDB starts threads, which a fork does not have.
void writeOriginals(const fs::path& folder) {
    const pid_t child = fork();
    if (child == 0) {
        openvdb::initialize();
        using namespace openvdb::io;
        writeVectors(folder / "mask.vdb", COMPRESS_ACTIVE_MASK, false, 9);
        writeVectors(folder / "zip.vdb", COMPRESS_ZIP | COMPRESS_ACTIVE_MASK, true, 5);
        writeVectors(folder / "blosc.vdb", COMPRESS_BLOSC | COMPRESS_ACTIVE_MASK, false, 6);
        writeFog(folder / "fog.vdb");
        dustbench::fuzz::writeNanoBall(folder / "ball.nvdb");
        writePoints(folder / "points.vdb", 5);
        writePoints(folder / "more_points.vdb", 60);
        __real__exit(0);
    }
    int status = 0;
    if (__real_waitpid(child, &status, 0) != child || status != 0) std::abort();
}

std::string bytesOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

struct Original {
    std::string name, bytes;
    std::function<void(const fs::path&)> read;
    long accepted = 0;
};

std::vector<Original> originalsIn(const fs::path& folder) {
    const auto vectors = [](const fs::path& file) { (void)dustbench::volumes::readVectors(file, "velocity"); };
    const auto points = [](const fs::path& file) {
        (void)dustbench::volumes::readVdbPoints(file, [](std::string_view) { return true; });
    };
    const auto volume = [](const fs::path& file) { (void)dustbench::volumes::readVolume(file, {}); };
    std::vector<Original> originals;
    const auto sparse = [](const fs::path& file) {
        const dustbench::volumes::VolumeSetup setup;
        dustbench::volume::BrickReader(file, setup, nullptr).readDensities();
    };
    for (const char* name : {"fog.vdb", "ball.nvdb"}) {
        originals.push_back({name, bytesOf(folder / name), volume});
        originals.push_back({name, bytesOf(folder / name), sparse});
    }
    for (const char* name : {"mask.vdb", "zip.vdb", "blosc.vdb"})
        originals.push_back({name, bytesOf(folder / name), vectors});
    for (const char* name : {"points.vdb", "more_points.vdb"})
        originals.push_back({name, bytesOf(folder / name), points});
    return originals;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 3;
    __sanitizer_install_malloc_and_free_hooks(countAllocated, countFreed);
    const long cases = std::atol(argv[2]);
    const fs::path folder = argv[3];
    fs::create_directories(folder);
    writeOriginals(folder);
    worker.answers = folder / "answers";
    unlink(worker.answers.c_str());
    if (mkfifo(worker.answers.c_str(), 0600) != 0) std::abort();
    std::signal(SIGPIPE, SIG_IGN);
    openvdb::initialize();  // once for all workers; it starts no thread
    std::vector<Original> originals = originalsIn(folder);
    for (const Original& original : originals) original.read(folder / original.name);  // throws if refused
    endings.clear();
    dustbench::fuzz::Mutation mutate(static_cast<std::uint32_t>(std::atol(argv[1])));
    double slowest = 0;
    long findings = 0;
    for (long n = 0; n < cases; ++n) {
        Original& original = originals[static_cast<std::size_t>(n) % originals.size()];
        const fs::path file = folder / ("mutant" + fs::path(original.name).extension().string());
        std::ofstream(file, std::ios::binary) << mutate(original.bytes);
        const auto begin = std::chrono::steady_clock::now();
        try {
            original.read(file);
            ++original.accepted;
        } catch (const dustbench::InputError& error) {
            const std::string line = error.what();
            if (line.find('\n') != std::string::npos || line.size() > 1000) {
                std::printf("finding: case %ld of seed %s: %s\n", n, argv[1], line.c_str());
                ++findings;
            }
        }  // any other exception ends the program, and the file stays
        slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        if ((n + 1) % 20'000 == 0) std::printf("%ld cases\n", n + 1), std::fflush(stdout);
    }
    if (worker.process >= 0) (void)endWorker();
    unlink(worker.answers.c_str());
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    std::printf("%ld cases of seed %s, %ld findings; slowest %.2f s; maximum memory of a worker %ld MB\n", cases,
                argv[1], findings, slowest, used.ru_maxrss / 1024);
    for (const Original& original : originals)
        std::printf("%s: %zu bytes, %ld mutants read\n", original.name.c_str(), original.bytes.size(),
                    original.accepted);
    for (const auto& [ending, count] : endings) std::printf("cases, %s: %ld\n", ending.c_str(), count);
    return findings > 0 ? 1 : 0;
}
