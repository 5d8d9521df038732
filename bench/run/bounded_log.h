// A log file of bounded size for a process's output: complete if short, otherwise only its beginning and end.
//
// Threads: one at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace dustbench::bench {

class BoundedLog {
 public:
    static constexpr std::size_t headBytes = 1 << 20;
    static constexpr std::size_t tailBytes = 64 << 10;

    /// Throws InputError if the file cannot be created.
    explicit BoundedLog(const std::filesystem::path& file);

    void write(std::string_view text);
    /// Writes the rest: the number of missing bytes, if any, and the end of the output.
    void finish();

    /// The last non-blank line so far, cut after 500 bytes.
    [[nodiscard]] std::string lastLine() const;

 private:
    std::ofstream stream_;
    std::uint64_t written_ = 0;
    std::uint64_t received_ = 0;
    std::string tail_;  ///< the last bytes received, up to twice `tailBytes`
};

}  // namespace dustbench::bench
