// Exports frames of one run: every requested format, the surrounding scene, and the series files.
//
// In the folder: `f000120.vti .htg .vtp .vdb .vtm` of frame 120, `extinction.pvd extinction.vti.series octree.pvd
// particles.pvd density.vdb.series scene.pvd` over the frames; `f000120_ID.vtp ID.pvd` of a method's own particles,
// which are then those of particles.pvd, and dust.pvd has the shared dust; `f000120_ID.vti .vdb ID_grid.pvd
// ID_grid.vdb.series` of its own grid; `f000120_ID_NAME.vtp ID_NAME.pvd` and `f000120_ID_NAME_heights.exr
// ID_NAME_heights.exr.series` of each surface that it changes, with `.vtp`. The scene is written unless every format
// does without it (exporter.h). ParaView takes origin, spacing and size of `extinction.vti.series` from its first file,
// and misplaces the others if theirs differ; `extinction.pvd` is always right.
//
// Owns: a lock on the folder, so that two programs never write to the same one. Threads: one at a time; grids use the
// current oneTBB arena.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/export/exporter.h"

namespace dustbench::exports {

/// Why this cloud cannot be written in the format (`provides no octree`); empty if it can.
[[nodiscard]] std::string whyNotWritable(const CollectedVolume& volume, std::string_view format);
/// Throws InputError with the method, the reason and the possible formats if one of the formats cannot be written.
void requireWritable(const CollectedVolume& volume, const std::vector<std::string>& formats, std::string_view method);

class VolumeExporter {
 public:
    /// Creates the folder and removes files left by interrupted exports. Throws InputError if it cannot be written, or
    /// if a grid of the requested region does not fit into memory.
    VolumeExporter(VolumeSettings settings, std::filesystem::path folder);
    /// Removes the folder if it was created here and is empty.
    ~VolumeExporter();
    VolumeExporter(const VolumeExporter&) = delete;
    VolumeExporter& operator=(const VolumeExporter&) = delete;

    [[nodiscard]] const VolumeSettings& settings() const { return folder_.settings(); }
    /// Stops writing this format.
    void leaveOut(std::string_view format);
    /// Throws InputError if a format cannot represent this cloud, the grid does not fit into memory, or a file cannot
    /// be written.
    void write(const ExportedMoment& moment);
    /// The grids have different placements: readers of `extinction.vti.series` must look into each file.
    [[nodiscard]] bool gridsDiffer() const { return gridsDiffer_; }
    /// The series written so far: those of the formats first, that of the scene last.
    [[nodiscard]] std::vector<std::filesystem::path> seriesFiles() const { return folder_.series(); }

 private:
    void writeGrids(const ExportedMoment& moment);

    ExportFolder folder_;
    bool madeFolder_ = false;
    int lock_ = -1;
    std::optional<GridPlan> firstGrid_;
    bool gridsDiffer_ = false;
};

}  // namespace dustbench::exports
