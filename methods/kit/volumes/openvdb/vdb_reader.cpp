#include "methods/kit/volumes/openvdb/vdb_reader.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/Dense.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

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

// Points.

using openvdb::points::PointDataGrid;
using openvdb::points::PointDataTree;

struct Column {
    std::string name;
    int components = 1;
    std::vector<double> values;
};

template <typename Number>
void append(const openvdb::points::AttributeArray& array, const PointDataTree::LeafNodeType& leaf, Column& column) {
    const openvdb::points::AttributeHandle<Number> handle(array);
    for (auto index = leaf.beginIndexOn(); index; ++index)
        if constexpr (openvdb::VecTraits<Number>::IsVec)
            for (int i = 0; i < 3; ++i) column.values.push_back(static_cast<double>(handle.get(*index)[i]));
        else
            column.values.push_back(static_cast<double>(handle.get(*index)));
}

/// False for a type that is no number.
bool appendAttribute(const openvdb::points::AttributeArray& array, const PointDataTree::LeafNodeType& leaf,
                     Column& column) {
    const std::string type = array.valueType();
    column.components = type.starts_with("vec3") ? 3 : 1;
    if (type == "float")
        append<float>(array, leaf, column);
    else if (type == "double")
        append<double>(array, leaf, column);
    else if (type == "int16")
        append<int16_t>(array, leaf, column);
    else if (type == "int32")
        append<int32_t>(array, leaf, column);
    else if (type == "int64")
        append<int64_t>(array, leaf, column);
    else if (type == "vec3s")
        append<openvdb::Vec3s>(array, leaf, column);
    else if (type == "vec3d")
        append<openvdb::Vec3d>(array, leaf, column);
    else if (type == "vec3i")
        append<openvdb::Vec3i>(array, leaf, column);
    else
        return false;
    return true;
}

PointDataGrid::Ptr readPointGrid(const std::string& file, double& timeSeconds, bool& hasTime) {
    std::ifstream stream(file, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::io::Stream stored(stream, /*delayLoad=*/false);
    PointDataGrid::Ptr points;
    for (const openvdb::GridBase::Ptr& each : *stored.getGrids()) {
        const auto found = openvdb::gridPtrCast<PointDataGrid>(each);
        if (found && points) throw Refusal{"it has more than one grid of points"};
        if (found) points = found;
    }
    if (!points) throw Refusal{"it has no grid of points"};
    if (const auto time = points->getMetadata<openvdb::DoubleMetadata>("time_s")) {
        timeSeconds = time->value();
        hasTime = true;
    }
    return points;
}

std::vector<Column> columnsOf(const PointDataGrid& grid) {
    std::vector<Column> columns{{"Points", 3, {}}};
    const auto first = grid.tree().cbeginLeaf();
    if (!first) return columns;
    const openvdb::points::AttributeSet::Descriptor& names = first->attributeSet().descriptor();
    std::vector<std::pair<std::size_t, std::size_t>> places;  // attribute, column
    for (const auto& [name, place] : names.map()) {
        const openvdb::points::AttributeArray& array = first->constAttributeArray(place);
        Column column{name, 1, {}};
        if (openvdb::points::isGroup(array) || array.stride() != 1 || !appendAttribute(array, *first, column)) continue;
        column.values.clear();
        places.emplace_back(place, columns.size());
        columns.push_back(std::move(column));
    }
    const std::size_t position = names.find("P");
    if (position == openvdb::points::AttributeSet::INVALID_POS) throw Refusal{"its points have no positions"};
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        if (leaf->attributeSet().descriptor() != names) throw Refusal{"its leaves have different attributes"};
        const openvdb::points::AttributeHandle<openvdb::Vec3f> within(leaf->constAttributeArray(position));
        for (auto index = leaf->beginIndexOn(); index; ++index) {
            const openvdb::Vec3d place =
                grid.indexToWorld(openvdb::Vec3d(within.get(*index)) + index.getCoord().asVec3d());
            for (int i = 0; i < 3; ++i) columns[0].values.push_back(place[i]);
        }
        for (const auto& [place, column] : places)
            if (!appendAttribute(leaf->constAttributeArray(place), *leaf, columns[column]))
                throw Refusal{"its leaves have different attributes"};
    }
    return columns;
}

[[noreturn]] void runPoints(const std::string& file) {
    double timeSeconds = 0;
    bool hasTime = false;
    const PointDataGrid::Ptr grid = readPointGrid(file, timeSeconds, hasTime);
    const openvdb::Index64 count = openvdb::points::pointCount(grid->tree());
    if (count > static_cast<openvdb::Index64>(files::limits::dustParticles))
        throw Refusal{"it has more than 10 million particles"};
    const std::vector<Column> columns = columnsOf(*grid);
    VdbMessage message;
    message.points = columns[0].values.size() / 3;
    message.columns = static_cast<std::int32_t>(columns.size());
    message.hasTime = hasTime ? 1 : 0;
    message.timeSeconds = timeSeconds;
    std::string bytes;
    for (const Column& column : columns) {
        if (column.values.size() != message.points * static_cast<std::size_t>(column.components))
            throw Refusal{"an attribute has not a value for each point"};
        VdbColumn header;
        column.name.copy(header.name, sizeof header.name - 1);
        header.components = column.components;
        bytes.append(reinterpret_cast<const char*>(&header), sizeof header);
        bytes.append(reinterpret_cast<const char*>(column.values.data()), column.values.size() * sizeof(double));
    }
    write(message, bytes.data(), bytes.size());
}

}  // namespace

void limitVdbReader() {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const rlimit none{0, 0}, seconds{maximumSeconds, maximumSeconds};
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_CPU, &seconds);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // whose shadow takes terabytes of addresses
    const rlimit addresses{maximumAddresses, maximumAddresses};
    setrlimit(RLIMIT_AS, &addresses);
#endif
}

void runVdbReader(const std::string& first, const std::string& second) {
#ifdef __SANITIZE_THREAD__
    // ThreadSanitizer cannot see into an uninstrumented oneTBB.
    static const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
#endif
    try {
        openvdb::initialize();
        if (first == "--points") runPoints(second);
        const openvdb::Vec3SGrid::Ptr grid = readGrid(first, second);
        Dense dense(boxOf(*grid));
        openvdb::tools::copyToDense(*grid, dense);
        write(messageOf(*grid, dense.bbox()), dense.data(), dense.valueCount() * sizeof(openvdb::Vec3s));
    } catch (const Refusal& refusal) {
        writeReason(refusal.reason);
    } catch (const std::exception&) {
        writeReason("not a whole file of OpenVDB");
    }
}

}  // namespace dustbench::volumes
