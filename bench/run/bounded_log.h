// The file that takes what a process prints: whole where it is short, its beginning and its end where it is not.
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

    /// Throws InputError where the file cannot be made.
    explicit BoundedLog(const std::filesystem::path& file);

    void write(std::string_view text);
    /// Writes what is left: a line that says how much is missing, where something is, and the end.
    void finish();

    /// The last line so far that is not blank, cut after 500 bytes.
    [[nodiscard]] std::string lastLine() const;

 private:
    std::ofstream stream_;
    std::uint64_t written_ = 0;
    std::uint64_t received_ = 0;
    std::string tail_;  ///< the last bytes received, up to twice `tailBytes`
};

}  // namespace dustbench::bench
