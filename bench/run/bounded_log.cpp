#include "bench/run/bounded_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bench/export/whole_file.h"
#include "methods/kit/files/machine_error.h"

namespace dustbench::bench {

BoundedLog::BoundedLog(const std::filesystem::path& file) : stream_(file, std::ios::binary | std::ios::trunc) {
    if (!stream_) files::failWriting(file, errno);
}

void BoundedLog::write(std::string_view text) {
    received_ += text.size();
    tail_ += text;
    if (tail_.size() > 2 * tailBytes) tail_.erase(0, tail_.size() - tailBytes);
    const std::string_view fits = text.substr(0, headBytes - std::min<std::uint64_t>(written_, headBytes));
    stream_ << fits << std::flush;
    written_ += fits.size();
}

void BoundedLog::finish() {
    const std::uint64_t missing = received_ - written_;
    const std::size_t end =
        static_cast<std::size_t>(std::min<std::uint64_t>(missing, std::min(tail_.size(), tailBytes)));
    if (missing > end) stream_ << fmt::format("\n[{} bytes left out]\n", missing - end);
    stream_ << std::string_view(tail_).substr(tail_.size() - end) << std::flush;
    written_ = received_;
}

std::string BoundedLog::lastLine() const {
    const std::string_view blank = " \t\r\n";
    const std::size_t last = tail_.find_last_not_of(blank);
    if (last == std::string::npos) return {};
    const std::size_t lineBreak = tail_.find_last_of('\n', last);
    const std::size_t first = lineBreak == std::string::npos ? 0 : lineBreak + 1;
    return tail_.substr(first, std::min<std::size_t>(last + 1 - first, 500));
}

}  // namespace dustbench::bench
