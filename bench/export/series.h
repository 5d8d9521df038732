// Index files that map the files of single frames to simulation times: `.pvd` for ParaView and PyVista, `.series` for
// ParaView's file reader.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::bench {

class Series {
 public:
    enum class Kind { pvd, json };

    Series(std::filesystem::path file, Kind kind) : file_(std::move(file)), kind_(kind) {}

    /// Adds a frame; `name` is its file, in the folder of the series. Rewrites the whole series, so that it never names
    /// an incomplete file. Throws InputError if it cannot be written.
    void add(std::string_view name, double timeSeconds);
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
    std::filesystem::path file_;
    Kind kind_;
    struct Entry {
        std::string name;
        double timeSeconds;
    };
    std::vector<Entry> entries_;

    [[nodiscard]] std::string pvdText() const;
    [[nodiscard]] std::string jsonText() const;
};

}  // namespace dustbench::bench
