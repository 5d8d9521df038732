#include "methods/kit/volumes/vdb_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/field_request.h"
#include "methods/kit/volumes/vdb_message.h"

namespace dustbench::volumes {
namespace {

constexpr const char* notWhole = "not a complete OpenVDB file";
constexpr std::uint64_t maximumReason = 1'000;
constexpr std::int32_t maximumColumns = 1'000;

std::string readReason(VdbPipe& pipe, std::uint64_t bytes) {
    std::string reason(std::min(bytes, maximumReason), ' ');
    return pipe.read(reason.data(), reason.size()) ? reason : notWhole;
}

/// Reads the list of ignored parts; false if it is incomplete.
bool readIgnored(VdbPipe& pipe, const VdbMessage& message, std::vector<std::string>& ignored) {
    if (message.ignoredBytes < 0 || message.ignoredBytes > maximumIgnoredBytes) return false;
    std::string lines(static_cast<std::size_t>(message.ignoredBytes), ' ');
    if (!pipe.read(lines.data(), lines.size())) return false;
    for (std::size_t at = 0; at < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', at), lines.size());
        ignored.push_back(files::printable(std::string_view(lines).substr(at, end - at)));
        at = end + 1;
    }
    return true;
}

/// Allocates memory as data arrive.
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

/// The reason if there are no points; empty on success.
std::string readTable(VdbPipe& pipe, const WantsColumn& wants, PointTable& table, std::vector<std::string>& ignored) {
    VdbMessage message;
    if (!pipe.read(&message, sizeof message)) return notWhole;
    if (message.reasonBytes > 0) return readReason(pipe, message.reasonBytes);
    if (message.points > static_cast<std::uint64_t>(files::limits::dustParticles) || message.columns < 1 ||
        message.columns > maximumColumns || !readIgnored(pipe, message, ignored))
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

/// The reason if there is no grid; empty on success.
std::string readPlace(VdbPipe& pipe, std::int64_t maximumCells, VdbMessage& message, GridPlace& place,
                      std::vector<std::string>& ignored) {
    if (!pipe.read(&message, sizeof message)) return notWhole;
    if (message.reasonBytes > 0) return readReason(pipe, message.reasonBytes);
    for (int axis = 0; axis < 3; ++axis) {
        if (message.cells[axis] < 1) return notWhole;
        place.cells[axis] = message.cells[axis];
        place.origin[axis] = message.origin[axis];
    }
    if (cellsOf(place) > static_cast<double>(maximumCells) || !readIgnored(pipe, message, ignored)) return notWhole;
    place.spacing = message.spacing;
    if (message.hasTime) place.timeSeconds = message.timeSeconds;
    place.sparse = true;
    return "";
}

/// The reason if there is no volume; empty on success.
std::string readAnswer(const std::filesystem::path& file, const VolumeFields& fields, VolumeGrid& grid) {
    VdbPipe pipe = startVdbReader(volumeMode + textOf(fields), file);
    VdbMessage message;
    std::vector<std::string> ignored;
    if (const std::string why = readPlace(pipe, maximumCells(fields), message, grid, ignored); !why.empty()) return why;
    files::noteIgnored(file, ignored);
    if (message.columns < 1 || message.columns > 3) return notWhole;
    for (std::int32_t i = 0; i < message.columns; ++i) {
        VdbColumn header;
        if (!pipe.read(&header, sizeof header)) return notWhole;
        header.name[sizeof header.name - 1] = 0;
        const std::string_view name = header.name;
        const bool isRead = name == "density"       ? readValues(pipe, grid.cellCount(), grid.density)
                            : name == "temperature" ? readValues(pipe, grid.cellCount(), grid.temperature)
                                                    : readValues(pipe, grid.cellCount(), grid.velocity);
        if (!isRead) return notWhole;
    }
    return pipe.ended() && !grid.density.empty() ? "" : notWhole;
}

/// The reason if there is no volume; empty on success.
std::string streamAnswer(const std::filesystem::path& file, const VolumeFields& fields, VolumeSink& sink) {
    VdbPipe pipe = startVdbReader(volumeMode + textOf(fields), file);
    VdbMessage message;
    GridPlace place;
    std::vector<std::string> ignored;
    if (const std::string why = readPlace(pipe, maximumCells(fields), message, place, ignored); !why.empty())
        return why;
    files::noteIgnored(file, ignored);
    if (message.columns < 1 || message.columns > 3) return notWhole;
    sink.begin(place);
    constexpr std::uint64_t atOnce = 1 << 18;
    std::vector<float> numbers(atOnce);
    bool hasDensity = false;
    for (std::int32_t i = 0; i < message.columns; ++i) {
        VdbColumn header;
        if (!pipe.read(&header, sizeof header)) return notWhole;
        header.name[sizeof header.name - 1] = 0;
        const std::string_view name = header.name;
        hasDensity |= name == "density";
        const bool isWanted = sink.beginField(name);
        for (std::uint64_t left = place.cellCount() * (name == "velocity" ? 3 : 1); left > 0;) {
            const std::uint64_t count = std::min(left, atOnce);
            if (!pipe.read(numbers.data(), count * sizeof(float))) return notWhole;
            if (isWanted) sink.take({numbers.data(), count});
            left -= count;
        }
    }
    return pipe.ended() && hasDensity ? "" : notWhole;
}

}  // namespace

bool VdbPipe::read(void* to, std::size_t bytes) {
    for (auto* at = static_cast<char*>(to); bytes > 0;) {
        const ssize_t got = ::read(output_, at, bytes);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        at += got;
        bytes -= static_cast<std::size_t>(got);
    }
    return true;
}

bool VdbPipe::ended() {
    if (process_ < 0) return false;
    char more = 0;
    const bool isAtEnd = !read(&more, 1);
    close(output_);  // ends the process if it still writes
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return isAtEnd && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string readVdb(const std::filesystem::path& file, const std::string& field, VectorGrid& grid) {
    VdbPipe pipe = startVdbReader(file, field);
    VdbMessage message;
    std::vector<std::string> ignored;
    if (const std::string why = readPlace(pipe, files::limits::sparseCells, message, grid, ignored); !why.empty())
        return why;
    files::noteIgnored(file, ignored);
    return readValues(pipe, grid.cellCount(), grid.values) && pipe.ended() ? "" : notWhole;
}

std::string readVdbVolume(const std::filesystem::path& file, const VolumeFields& fields, VolumeGrid& grid) {
    const std::string why = readAnswer(file, fields, grid);
    return why == notWhole ? notWholeOf(file.native()) : why;
}

std::string streamVdbVolume(const std::filesystem::path& file, const VolumeFields& fields, VolumeSink& sink) {
    const std::string why = streamAnswer(file, fields, sink);
    return why == notWhole ? notWholeOf(file.native()) : why;
}

std::optional<PointTable> findVdbPoints(const std::filesystem::path& file, const WantsColumn& wants) {
    std::string why = files::refusalOf(file, files::limits::geometryBytes);
    PointTable table;
    if (why.empty()) {
        VdbPipe pipe = startVdbReader(pointsMode, file);
        why = readTable(pipe, wants, table, table.ignored);
    }
    if (why == noPoints) return std::nullopt;
    if (!why.empty()) throw InputError(file.string() + ": " + files::printable(why));
    return table;
}

PointTable readVdbPoints(const std::filesystem::path& file, const WantsColumn& wants) {
    std::optional<PointTable> table = findVdbPoints(file, wants);
    if (!table) throw InputError(file.string() + ": " + noPoints);
    return *std::move(table);
}

}  // namespace dustbench::volumes
