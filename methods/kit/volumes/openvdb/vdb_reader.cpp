#include "methods/kit/volumes/openvdb/vdb_reader.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/points/PointDataGrid.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/files/limits.h"
#include "methods/kit/volumes/openvdb/answer.h"
#include "methods/kit/volumes/openvdb/dense_answer.h"
#include "methods/kit/volumes/vdb_message.h"

namespace dustbench::volumes {
namespace {

openvdb::Vec3SGrid::Ptr readGrid(const std::string& file, const std::string& field, std::vector<std::string>& ignored) {
    // OpenVDB does not detect a truncated file and continues with what is in memory; the stream detects the end.
    std::ifstream stream(file, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::io::Stream stored(stream, /*delayLoad=*/false);
    const openvdb::GridPtrVecPtr grids = stored.getGrids();
    std::vector<PresentField> present;
    for (const openvdb::GridBase::Ptr& each : *grids)
        present.push_back({each->getName(), each->isType<openvdb::Vec3SGrid>() ? 3 : 0,
                           "grid " + std::to_string(present.size() + 1) + " of " + each->valueType()});
    const int at = chosenField<Refusal>(WantedField{"velocity", 3, {field}, true, false}, present);
    const auto place = static_cast<std::size_t>(at);
    ignored = restOf(present, {&place, 1});
    return openvdb::gridPtrCast<openvdb::Vec3SGrid>((*grids)[place]);
}

openvdb::CoordBBox boxOfVectors(const openvdb::Vec3SGrid& grid) {
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (!grid.transform().isLinear() || !grid.hasUniformVoxels() || !(grid.voxelSize()[0] > 0))
        throw Refusal{"its cells are not cubes"};
    if (box.empty()) throw Refusal{"its vectors are zero everywhere"};
    if (countOf(box) > static_cast<double>(files::limits::sparseCells))
        throw Refusal{"the box of its vectors has more than 89 million cells"};
    return box;
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

/// False for a type that is not a number.
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

PointDataGrid::Ptr readPointGrid(const std::string& file, double& timeSeconds, bool& hasTime,
                                 std::vector<std::string>& ignored) {
    std::ifstream stream(file, std::ios::binary);
    stream.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
    openvdb::io::Stream stored(stream, /*delayLoad=*/false);
    PointDataGrid::Ptr points;
    for (const openvdb::GridBase::Ptr& each : *stored.getGrids()) {
        const auto found = openvdb::gridPtrCast<PointDataGrid>(each);
        if (found && points) throw Refusal{"it has more than one grid of points"};
        if (found)
            points = found;
        else
            ignored.push_back("grid '" + each->getName().substr(0, 60) + "'");
    }
    if (!points) throw Refusal{noPoints};
    if (const std::optional<double> time = timeOf(*points)) {
        timeSeconds = *time;
        hasTime = true;
    }
    return points;
}

/// Attributes that are not numbers, or that have several values per point, are named in `ignored`.
std::vector<Column> columnsOf(const PointDataGrid& grid, std::vector<std::string>& ignored) {
    std::vector<Column> columns{{"Points", 3, {}}};
    const auto first = grid.tree().cbeginLeaf();
    if (!first) return columns;
    const openvdb::points::AttributeSet::Descriptor& names = first->attributeSet().descriptor();
    std::vector<std::pair<std::size_t, std::size_t>> places;  // attribute, column
    for (const auto& [name, place] : names.map()) {
        const openvdb::points::AttributeArray& array = first->constAttributeArray(place);
        Column column{name, 1, {}};
        if (openvdb::points::isGroup(array) || array.stride() != 1 || !appendAttribute(array, *first, column)) {
            ignored.push_back((openvdb::points::isGroup(array) ? "group '" : "attribute '") + name.substr(0, 60) + "'");
            continue;
        }
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

[[noreturn]] void runVectors(const std::string& file, const std::string& field) {
    std::vector<std::string> ignored;
    const openvdb::Vec3SGrid::Ptr grid = readGrid(file, field, ignored);
    const openvdb::CoordBBox box = boxOfVectors(*grid);
    putMessage(messageOf(*grid, box), ignored);
    forgetInactive(*grid);
    putVectors(*grid, box);
    finish();
}

[[noreturn]] void runPoints(const std::string& file) {
    double timeSeconds = 0;
    bool hasTime = false;
    std::vector<std::string> ignored;
    const PointDataGrid::Ptr grid = readPointGrid(file, timeSeconds, hasTime, ignored);
    const openvdb::Index64 count = openvdb::points::pointCount(grid->tree());
    if (count > static_cast<openvdb::Index64>(files::limits::dustParticles))
        throw Refusal{"it has more than 10 million particles"};
    const std::vector<Column> columns = columnsOf(*grid, ignored);
    VdbMessage message;
    message.points = columns[0].values.size() / 3;
    message.columns = static_cast<std::int32_t>(columns.size());
    message.hasTime = hasTime ? 1 : 0;
    message.timeSeconds = timeSeconds;
    for (const Column& column : columns)
        if (column.values.size() != message.points * static_cast<std::size_t>(column.components))
            throw Refusal{"an attribute does not have one value per point"};
    putMessage(message, ignored);
    for (const Column& column : columns) {
        VdbColumn header;
        column.name.copy(header.name, sizeof header.name - 1);
        header.components = column.components;
        put(header);
        put(column.values.data(), column.values.size() * sizeof(double));
    }
    finish();
}

}  // namespace

std::uintmax_t vdbMemoryBytes(std::uintmax_t fileBytes) {
    constexpr std::uintmax_t atMost = std::uintmax_t{8} << 30;
    return std::min((std::uintmax_t{64} << 20) + 64 * fileBytes, atMost);
}

std::uintmax_t vdbProcessorSeconds(std::uintmax_t fileBytes) {
    return 10 + fileBytes / 4'000'000;
}

const char* vdbFile(const char* first, const char* second) {
    return std::string_view(first).starts_with("--") ? second : first;
}

void limitVdbReader(const std::string& file) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::error_code none;
    const std::uintmax_t bytes = std::filesystem::file_size(file, none);
    const rlim_t fileBytes = none ? 0 : bytes, allowed = vdbProcessorSeconds(fileBytes);
    const rlimit noCore{0, 0}, seconds{allowed, allowed};
    setrlimit(RLIMIT_CORE, &noCore);
    setrlimit(RLIMIT_CPU, &seconds);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their shadow memory takes terabytes
    const rlimit memory{vdbMemoryBytes(fileBytes), vdbMemoryBytes(fileBytes)};
    setrlimit(RLIMIT_DATA, &memory);
#endif
}

void runVdbReader(const std::string& first, const std::string& second) {
    const std::string file = vdbFile(first.c_str(), second.c_str());
    // Keeps memory independent of the number of cores. (ThreadSanitizer cannot see into oneTBB either.)
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    try {
        openvdb::initialize();
        if (first == pointsMode) runPoints(file);
        if (!first.starts_with(volumeMode)) runVectors(file, second);
        const VolumeFields fields = fieldsOf(std::string_view(first).substr(std::string_view(volumeMode).size()));
        if (file.ends_with(".nvdb")) answerNanoVolume(file, fields);
        answerVolume(file, fields);
    } catch (const Refusal& refusal) {
        writeReason(refusal.reason);
    } catch (const std::bad_alloc&) {
        writeReason("reading it takes too much memory, allowed: 64 MiB and 64 times the file's size");
    } catch (const std::exception&) {
        writeReason(notWholeOf(file));
    }
}

}  // namespace dustbench::volumes
