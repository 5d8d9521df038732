// Writes and reads tar archives that contain only files. Equal contents give equal bytes: entries have no owner, and
// time 0.
//
// The format is `ustar`, of IEEE Std 1003.1-2017. Units: bytes. Threads: one for each archive.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::suite {

/// Writes an archive, entries in the order of the calls. Call `finish` at the end.
class TarWriter {
 public:
    /// Throws as files::failWriting.
    explicit TarWriter(std::filesystem::path file);

    /// `name` in the archive: relative, `/` between folders, at most 255 bytes. Throws InputError if it is too long, or
    /// if `file` is truncated while it is read.
    void add(const std::string& name, const std::filesystem::path& file);
    void addText(const std::string& name, std::string_view text);
    void finish();

 private:
    void header(const std::string& name, std::uintmax_t bytes);
    void pad(std::uintmax_t bytes);
    void write(const char* from, std::size_t bytes);

    std::filesystem::path file_;
    std::ofstream stream_;
};

/// Writes all files of the archive below `folder` and returns their names, in order. Throws InputError with the archive
/// and the reason: it is truncated, a header is damaged, or an entry is not a file, points outside the folder or
/// appears twice. Files before the error have been written by then.
std::vector<std::string> extractTar(const std::filesystem::path& archive, const std::filesystem::path& folder);

}  // namespace dustbench::suite
