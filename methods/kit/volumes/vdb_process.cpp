#include "methods/kit/volumes/vdb_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/loaded_library.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/vdb_message.h"

namespace dustbench::volumes {
namespace {

constexpr const char* notWhole = "not a whole file of OpenVDB";
constexpr std::uint64_t maximumReason = 1'000;
constexpr std::int32_t maximumColumns = 1'000;
constexpr const char* pointsMode = "--points";  ///< instead of a field

[[noreturn]] void fail(int error) {
    throw std::runtime_error(std::string("cannot start ") + vdbReaderName +
                             ", which reads volumes: " + std::strerror(error));
}

/// Owns: a running reader and the end of its output.
class Reader {
 public:
    Reader(const std::filesystem::path& file, const std::string& field) {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
        output_ = ends[0];
        const int error = spawn(file, field, ends[1]);
        close(ends[1]);
        if (error == 0) return;
        close(output_);
        fail(error);
    }
    ~Reader() { (void)ended(); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// False at the end of the output.
    [[nodiscard]] bool read(void* to, std::size_t bytes) {
        for (auto* at = static_cast<char*>(to); bytes > 0;) {
            const ssize_t got = ::read(output_, at, bytes);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return false;
            at += got;
            bytes -= static_cast<std::size_t>(got);
        }
        return true;
    }
    /// Whether it wrote nothing more and ended well.
    [[nodiscard]] bool ended() {
        if (process_ < 0) return false;
        char more = 0;
        const bool isAtEnd = !read(&more, 1);
        close(output_);  // what it would still write ends it
        int status = 0;
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
        return isAtEnd && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    }

 private:
    int spawn(const std::filesystem::path& file, const std::string& field, int output) {
        const std::string program = files::besideKit(vdbReaderName);
        std::string name = std::filesystem::absolute(file), argument = field, self = vdbReaderName;
        if (field == pointsMode) std::swap(name, argument);
        std::array<char*, 4> argv{self.data(), name.data(), argument.data(), nullptr};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        const int error = posix_spawn(&process_, program.c_str(), &actions, nullptr, argv.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        return error;
    }

    pid_t process_ = -1;
    int output_ = -1;
};

std::string readReason(Reader& reader, std::uint64_t bytes) {
    std::string reason(std::min(bytes, maximumReason), ' ');
    return reader.read(reason.data(), reason.size()) ? reason : notWhole;
}

/// Memory grows with what arrives.
template <typename Value>
bool readValues(Reader& reader, std::size_t count, std::vector<Value>& values) {
    constexpr std::size_t atOnce = 1 << 20;
    while (values.size() < count) {
        const std::size_t first = values.size();
        values.resize(std::min(count, first + atOnce));
        if (!reader.read(&values[first], (values.size() - first) * sizeof(Value))) return false;
    }
    return true;
}

/// The reason why there are no points, or an empty text.
std::string readTable(Reader& reader, const WantsColumn& wants, PointTable& table) {
    VdbMessage message;
    if (!reader.read(&message, sizeof message)) return notWhole;
    if (message.reasonBytes > 0) return readReason(reader, message.reasonBytes);
    if (message.points > static_cast<std::uint64_t>(files::limits::dustParticles) || message.columns < 1 ||
        message.columns > maximumColumns)
        return notWhole;
    table.points = static_cast<std::size_t>(message.points);
    if (message.hasTime) table.timeSeconds = message.timeSeconds;
    for (std::int32_t i = 0; i < message.columns; ++i) {
        VdbColumn header;
        if (!reader.read(&header, sizeof header) || (header.components != 1 && header.components != 3)) return notWhole;
        header.name[sizeof header.name - 1] = 0;
        PointColumn& column = table.columns.emplace_back(PointColumn{header.name, header.components, {}});
        if (!readValues(reader, table.points * static_cast<std::size_t>(header.components), column.values))
            return notWhole;
        if (!wants(column.name)) column.values = {};
    }
    return reader.ended() ? "" : notWhole;
}

}  // namespace

std::string readVdb(const std::filesystem::path& file, const std::string& field, VectorGrid& grid) {
    Reader reader(file, field);
    VdbMessage message;
    if (!reader.read(&message, sizeof message)) return notWhole;
    if (message.reasonBytes > 0) return readReason(reader, message.reasonBytes);
    double count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (message.cells[axis] < 1) return notWhole;
        grid.cells[axis] = message.cells[axis];
        grid.origin[axis] = message.origin[axis];
        count *= message.cells[axis];
    }
    if (count > static_cast<double>(files::limits::volumeCells)) return notWhole;
    grid.spacing = message.spacing;
    if (message.hasTime) grid.timeSeconds = message.timeSeconds;
    grid.sparse = true;
    return readValues(reader, static_cast<std::size_t>(count), grid.values) && reader.ended() ? "" : notWhole;
}

PointTable readVdbPoints(const std::filesystem::path& file, const WantsColumn& wants) {
    std::string why = files::refusalOf(file, files::limits::geometryBytes);
    PointTable table;
    if (why.empty()) {
        Reader reader(file, pointsMode);
        why = readTable(reader, wants, table);
    }
    if (!why.empty()) throw InputError(file.string() + ": " + files::printable(why));
    return table;
}

}  // namespace dustbench::volumes
