// Separate from vdb_process.cpp, so that tests/fuzz/openvdb can start the reader in a different way.
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "methods/kit/files/loaded_library.h"
#include "methods/kit/volumes/vdb_message.h"
#include "methods/kit/volumes/vdb_process.h"

namespace dustbench::volumes {
namespace {

[[noreturn]] void fail(int error) {
    throw std::runtime_error(vdbReaderName + std::string(", which reads volumes, cannot be started: ") +
                             std::strerror(error));
}

/// Returns an error number, or 0.
int spawn(std::string first, std::string second, int output, pid_t& process) {
    const std::string program = files::inKitFolder(vdbReaderName);
    std::string self = vdbReaderName;
    std::array<char*, 4> argv{self.data(), first.data(), second.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = posix_spawn(&process, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

}  // namespace

VdbPipe startVdbReader(const std::string& first, const std::string& second) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
    pid_t process = -1;
    const int error = spawn(first, second, ends[1], process);
    close(ends[1]);
    if (error != 0) {
        close(ends[0]);
        fail(error);
    }
    return {process, ends[0]};
}

}  // namespace dustbench::volumes
