#include "methods/kit/volumes/vdb_pipe.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

namespace dustbench::volumes {

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

}  // namespace dustbench::volumes
