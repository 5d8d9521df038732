// The program dustbench_vdb_reader: reads a field of vectors from a `.vdb` and writes it to its standard output
// (vdb_message.h). It is a process of its own, so that a damaged file ends no other.
//
//     dustbench_vdb_reader FILE FIELD
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>

#ifdef __SANITIZE_THREAD__
#include <tbb/global_control.h>
#endif

#include "methods/kit/files/limits.h"
#include "methods/kit/volumes/vdb_message.h"

namespace dustbench::volumes {
namespace {

using Dense = openvdb::tools::Dense<openvdb::Vec3s, openvdb::tools::LayoutXYZ>;

/// A reason to refuse the file, as one clause.
struct Refusal {
    std::string reason;
};

constexpr rlim_t maximumSeconds = 300;
/// The vectors of all cells twice, and a file.
constexpr rlim_t maximumAddresses = rlim_t{8} << 30;

void limitResources() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit none{0, 0}, seconds{maximumSeconds, maximumSeconds};
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_CPU, &seconds);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose shadow takes terabytes of addresses
    const rlimit addresses{maximumAddresses, maximumAddresses};
    setrlimit(RLIMIT_AS, &addresses);
#endif
}

openvdb::Vec3SGrid::Ptr readGrid(const std::string& file, const std::string& field) {
    // OpenVDB does not detect a truncated file and continues with what is in memory; the stream detects the end.
    std::ifstream stream(file, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::io::Stream stored(stream, /*delayLoad=*/false);
    openvdb::Vec3SGrid::Ptr vectors;
    std::string others;
    for (const openvdb::GridBase::Ptr& each : *stored.getGrids()) {
        const auto found = openvdb::gridPtrCast<openvdb::Vec3SGrid>(each);
        if (!found) continue;
        if (found->getName() == field) vectors = found;
        others += (others.empty() ? "; it has: " : ", ") + found->getName();
    }
    if (!vectors) throw Refusal{"it has no field of vectors '" + field + "'" + others};
    return vectors;
}

openvdb::CoordBBox boxOf(const openvdb::Vec3SGrid& grid) {
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (!grid.transform().isLinear() || !grid.hasUniformVoxels() || !(grid.voxelSize()[0] > 0))
        throw Refusal{"its cells are no cubes"};
    if (box.empty()) throw Refusal{"its vectors are zero everywhere"};
    double cells = 1;  // corners are any 32-bit numbers, whose differences overflow
    for (int axis = 0; axis < 3; ++axis)
        cells *= static_cast<double>(box.max()[axis]) - static_cast<double>(box.min()[axis]) + 1;
    if (cells > static_cast<double>(files::limits::volumeCells)) throw Refusal{"it has more than 256 million cells"};
    return box;
}

VdbMessage messageOf(const openvdb::Vec3SGrid& grid, const openvdb::CoordBBox& box) {
    VdbMessage message;
    message.spacing = grid.voxelSize()[0];
    const openvdb::Vec3d first = grid.indexToWorld(box.min());  // the centre of the first cell
    for (int axis = 0; axis < 3; ++axis) {
        message.cells[axis] = box.dim()[axis];
        message.origin[axis] = first[axis] - message.spacing / 2;
    }
    if (const auto time = grid.getMetadata<openvdb::DoubleMetadata>("time_s")) {
        message.hasTime = 1;
        message.timeSeconds = time->value();
    }
    return message;
}

/// Ends the process: what the file left in memory is not taken apart.
[[noreturn]] void write(const VdbMessage& message, const void* data, std::size_t bytes) {
    const bool isWritten = std::fwrite(&message, sizeof message, 1, stdout) == 1 &&
                           std::fwrite(data, 1, bytes, stdout) == bytes && std::fflush(stdout) == 0;
    _exit(isWritten ? 0 : 1);
}

[[noreturn]] void writeReason(const std::string& reason) {
    VdbMessage message;
    message.reasonBytes = reason.size();
    write(message, reason.data(), reason.size());
}

[[noreturn]] void run(const std::string& file, const std::string& field) {
#ifdef __SANITIZE_THREAD__
    // ThreadSanitizer cannot see into an uninstrumented oneTBB.
    static const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
#endif
    try {
        openvdb::initialize();
        const openvdb::Vec3SGrid::Ptr grid = readGrid(file, field);
        Dense dense(boxOf(*grid));
        openvdb::tools::copyToDense(*grid, dense);
        write(messageOf(*grid, dense.bbox()), dense.data(), dense.valueCount() * sizeof(openvdb::Vec3s));
    } catch (const Refusal& refusal) {
        writeReason(refusal.reason);
    } catch (const std::exception&) {
        writeReason("not a whole file of OpenVDB");
    }
}

}  // namespace
}  // namespace dustbench::volumes

int main(int argc, char** argv) {
    if (argc != 3) return 3;
    dustbench::volumes::limitResources();
    dustbench::volumes::run(argv[1], argv[2]);
}
