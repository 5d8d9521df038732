// Formats of volumes as declarations: each with its id, what lists and documents say of it, its options, and its
// functions.
//
// A file NAME_format.cpp of this folder declares one:
//
//     namespace dustbench::exports::NAME_format {
//     Exporter describe() { … }
//     }
//
// CMake generates the list from these files. The values and errors of `--format`, its help, the options of formats, the
// keys of suites and the table of reports/guide/paraview-blender.md are made from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/export/collected_volume.h"
#include "bench/export/extinction_grid.h"
#include "bench/export/vtk_file.h"
#include "methods/contract/scene.h"
#include "methods/contract/volume.h"

namespace dustbench::exports {

/// The state of a run at one exported frame.
struct ExportedMoment {
    std::int64_t frame;
    std::string_view method;  ///< its id
    const CollectedVolume& volume;
    const scene::Scene& scene;
    const scene::SceneState& state;
    Puffs dust;
    std::span<const std::string> configuration{};  ///< what determines the state, `name=value` each

    [[nodiscard]] FileOrigin origin() const { return {state.timeSeconds, method, configuration}; }
};

/// An index file that maps the files of single frames to simulation times: `.pvd` for ParaView and PyVista, `.series`
/// for ParaView's file reader.
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

/// The folder of an export, the series in it and its settings.
class ExportFolder {
 public:
    ExportFolder(std::filesystem::path path, VolumeSettings settings)
        : path_(std::move(path)), settings_(std::move(settings)) {}

    [[nodiscard]] VolumeSettings& settings() { return settings_; }
    [[nodiscard]] const VolumeSettings& settings() const { return settings_; }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path file(const std::string& name) const { return path_ / name; }
    /// Adds a file of the moment to a series. Throws InputError if it cannot be written.
    void addTo(const std::string& series, Series::Kind kind, const std::string& name, const ExportedMoment& moment);
    [[nodiscard]] std::vector<std::filesystem::path> series() const;

 private:
    std::filesystem::path path_;
    VolumeSettings settings_;
    std::vector<Series> series_;
};

/// `f000120.vti`, and of what a method alone has `f000120_METHOD.vti`.
[[nodiscard]] std::string fileOf(const ExportedMoment& moment, std::string_view extension);
[[nodiscard]] std::string ownFileOf(const ExportedMoment& moment, std::string_view extension);

/// A choice of words: `vdb_precision` in files, `--vdb-precision` on the command line.
struct ExporterOption {
    std::string id;
    std::vector<std::string> words;  ///< the first is the default
    std::string help;
    [[nodiscard]] std::string commandName() const;  ///< `--vdb-precision`
    bool isAlwaysNamed = false;  ///< also at its default in the keys and records of runs, as in older results
};

/// The functions throw InputError if a file cannot be written, or the format cannot hold a value.
struct Exporter {
    std::string id;                  ///< for `--format`
    std::string extension;           ///< without a dot
    std::string kind;                ///< one or two words for the help of `--format`
    std::string contents, programs;  ///< for documents, Markdown
    std::vector<ExporterOption> options{};
    /// Why this cloud cannot be written (`provides no octree`); empty if it can. None: every cloud can, if there is
    /// anything to make a grid of.
    std::function<std::string(const CollectedVolume&)> whyNot{};
    /// Writes the cloud's grid, which formats share. None: the format needs no grid.
    std::function<void(const ExtinctionGrid&, const ExportedMoment&, ExportFolder&)> writeGrid{};
    /// Writes the rest: particles, an octree, what the method alone has.
    std::function<void(const ExportedMoment&, ExportFolder&)> write{};
    int gridTenths = 0;                  ///< memory for writing a grid, in tenths of the grid
    bool readersNeedEqualGrids = false;  ///< a series is right only if the grids of all frames have the same place
    bool withScene = true;               ///< programs for this format show the scene's files (.vtm)
    int place = 1000;                    ///< in lists; those without one follow at the end
};

/// In the order of lists.
[[nodiscard]] const std::vector<Exporter>& exporters();
/// Throws std::invalid_argument if there is none.
[[nodiscard]] const Exporter& exporterOf(std::string_view id);

/// The options of all formats.
[[nodiscard]] std::vector<ExporterOption> exporterOptions();
/// Throws std::invalid_argument if there is none.
[[nodiscard]] const ExporterOption& exporterOption(std::string_view id);

}  // namespace dustbench::exports
