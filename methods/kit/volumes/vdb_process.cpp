#include "methods/kit/volumes/vdb_process.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/vdb_message.h"
#include "methods/kit/volumes/vdb_pipe.h"

namespace dustbench::volumes {
namespace {

constexpr const char* notWhole = "not a whole file of OpenVDB";
constexpr std::uint64_t maximumReason = 1'000;
constexpr std::int32_t maximumColumns = 1'000;
constexpr const char* pointsMode = "--points";

std::string readReason(VdbPipe& pipe, std::uint64_t bytes) {
    std::string reason(std::min(bytes, maximumReason), ' ');
    return pipe.read(reason.data(), reason.size()) ? reason : notWhole;
}

/// Memory grows with what arrives.
template <typename Value>
bool readValues(VdbPipe& pipe, std::size_t count, std::vector<Value>& values) {
    constexpr std::size_t atOnce = 1 << 20;
    while (values.size() < count) {
        const std::size_t first = values.size();
        values.resize(std::min(count, first + atOnce));
        if (!pipe.read(&values[first], (values.size() - first) * sizeof(Value))) return false;
    }
    return true;
}

/// The reason why there are no points, or an empty text.
std::string readTable(VdbPipe& pipe, const WantsColumn& wants, PointTable& table) {
    VdbMessage message;
    if (!pipe.read(&message, sizeof message)) return notWhole;
    if (message.reasonBytes > 0) return readReason(pipe, message.reasonBytes);
    if (message.points > static_cast<std::uint64_t>(files::limits::dustParticles) || message.columns < 1 ||
        message.columns > maximumColumns)
        return notWhole;
    table.points = static_cast<std::size_t>(message.points);
    if (message.hasTime) table.timeSeconds = message.timeSeconds;
    for (std::int32_t i = 0; i < message.columns; ++i) {
        VdbColumn header;
        if (!pipe.read(&header, sizeof header) || (header.components != 1 && header.components != 3)) return notWhole;
        header.name[sizeof header.name - 1] = 0;
        PointColumn& column = table.columns.emplace_back(PointColumn{header.name, header.components, {}});
        if (!readValues(pipe, table.points * static_cast<std::size_t>(header.components), column.values))
            return notWhole;
        if (!wants(column.name)) column.values = {};
    }
    return pipe.ended() ? "" : notWhole;
}

}  // namespace

std::string readVdb(const std::filesystem::path& file, const std::string& field, VectorGrid& grid) {
    VdbPipe pipe = startVdbReader(file, field);
    VdbMessage message;
    if (!pipe.read(&message, sizeof message)) return notWhole;
    if (message.reasonBytes > 0) return readReason(pipe, message.reasonBytes);
    double count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (message.cells[axis] < 1) return notWhole;
        grid.cells[axis] = message.cells[axis];
        grid.origin[axis] = message.origin[axis];
        count *= message.cells[axis];
    }
    if (count > static_cast<double>(files::limits::sparseCells)) return notWhole;
    grid.spacing = message.spacing;
    if (message.hasTime) grid.timeSeconds = message.timeSeconds;
    grid.sparse = true;
    return readValues(pipe, static_cast<std::size_t>(count), grid.values) && pipe.ended() ? "" : notWhole;
}

PointTable readVdbPoints(const std::filesystem::path& file, const WantsColumn& wants) {
    std::string why = files::refusalOf(file, files::limits::geometryBytes);
    PointTable table;
    if (why.empty()) {
        VdbPipe pipe = startVdbReader(pointsMode, file);
        why = readTable(pipe, wants, table);
    }
    if (!why.empty()) throw InputError(file.string() + ": " + files::printable(why));
    return table;
}

}  // namespace dustbench::volumes
