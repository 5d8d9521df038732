// Reads mutants of OpenVDB's files as readVectors() and readVdbPoints() do, some 15 ms a case: what they start is a
// fork of this process, in which OpenVDB is loaded already, instead of the program dustbench_vdb_reader.
//
//     vdb_mutants SEED CASES FOLDER
//
// The children may end in any way, as OpenVDB trusts what it reads; how often they did is counted. This process must
// read each file, or refuse it in one line. A child's memory and processor time are limited and reported.
#include <fcntl.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <memory>

#include "methods/contract/errors.h"
#include "methods/kit/volumes/openvdb/vdb_reader.h"
#include "methods/kit/volumes/vdb_pipe.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/vector_file.h"
#include "tests/fuzz/mutation.h"

// Of AddressSanitizer's library; GCC 12 brings no header for them.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*allocated)(const volatile void*,
                                                                           std::size_t),  // NOLINT
                                                         void (*freed)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* memory);  // NOLINT

namespace {

namespace fs = std::filesystem;

/// How children ended: "exit 0", "signal 11" …
std::map<std::string, long> endings;

constexpr int tookTooMuch = 77;  ///< a child's exit code

/// In a child: memory that was allocated and not yet freed, and what it may be at most. Without sanitizers RLIMIT_DATA
/// is the limit.
std::size_t heldBytes = 0, allowedBytes = 0;

void countAllocated(const volatile void*, std::size_t bytes) {
    heldBytes += bytes;
    if (allowedBytes > 0 && heldBytes > allowedBytes) _exit(tookTooMuch);
}

void countFreed(const volatile void* memory) {
    if (memory) heldBytes -= std::min(heldBytes, __sanitizer_get_allocated_size(memory));
}

}  // namespace

// Linked with --wrap=waitpid: every child's end passes here.
extern "C" pid_t __real_waitpid(pid_t process, int* status, int options);   // NOLINT
extern "C" pid_t __wrap_waitpid(pid_t process, int* status, int options) {  // NOLINT
    const pid_t ended = __real_waitpid(process, status, options);
    if (ended > 0)
        ++endings[WIFEXITED(*status) ? "exit " + std::to_string(WEXITSTATUS(*status))
                                     : "signal " + std::to_string(WTERMSIG(*status))];
    return ended;
}

namespace dustbench::volumes {

VdbPipe startVdbReader(const std::string& first, const std::string& second) {
    int ends[2];
    if (pipe(ends) != 0) std::abort();
    const pid_t child = fork();
    if (child < 0) std::abort();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        close(ends[0]);
        close(ends[1]);
        const std::string file = vdbFile(first.c_str(), second.c_str());
        limitVdbReader(file);
        allowedBytes = vdbMemoryBytes(fs::file_size(file));
        runVdbReader(first, second);
    }
    close(ends[1]);
    return {child, ends[0]};
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

/// In a child: OpenVDB starts threads, which a fork does not have.
void writeOriginals(const fs::path& folder) {
    const pid_t child = fork();
    if (child == 0) {
        openvdb::initialize();
        using namespace openvdb::io;
        writeVectors(folder / "mask.vdb", COMPRESS_ACTIVE_MASK, false, 9);
        writeVectors(folder / "zip.vdb", COMPRESS_ZIP | COMPRESS_ACTIVE_MASK, true, 5);
        writeVectors(folder / "blosc.vdb", COMPRESS_BLOSC | COMPRESS_ACTIVE_MASK, false, 6);
        writePoints(folder / "points.vdb", 5);
        writePoints(folder / "more_points.vdb", 60);
        _exit(0);
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
    std::vector<Original> originals;
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
    const fs::path folder = argv[3], file = folder / "mutant.vdb";
    fs::create_directories(folder);
    writeOriginals(folder);
    std::vector<Original> originals = originalsIn(folder);
    for (const Original& original : originals) original.read(folder / original.name);  // throws if it is refused
    endings.clear();
    openvdb::initialize();  // once for all children; it starts no thread
    dustbench::fuzz::Mutation mutate(static_cast<std::uint32_t>(std::atol(argv[1])));
    double slowest = 0;
    long findings = 0;
    for (long n = 0; n < cases; ++n) {
        Original& original = originals[static_cast<std::size_t>(n) % originals.size()];
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
        }  // anything else ends the program, and the file stays
        slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        if ((n + 1) % 20'000 == 0) std::printf("%ld cases\n", n + 1), std::fflush(stdout);
    }
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    std::printf("%ld cases of seed %s, %ld findings; slowest %.2f s; most memory of a child %ld MB\n", cases, argv[1],
                findings, slowest, used.ru_maxrss / 1024);
    for (const Original& original : originals)
        std::printf("%s: %zu bytes, %ld mutants read\n", original.name.c_str(), original.bytes.size(),
                    original.accepted);
    for (const auto& [ending, count] : endings) std::printf("children, %s: %ld\n", ending.c_str(), count);
    return findings > 0 ? 1 : 0;
}
