// Reference images on disk, shared by the runs of a suite: methods are compared in the same worlds, so that most runs
// need references that an earlier run has rendered.
//
// An image is found by the SHA-256 of everything that it depends on: particles, view, opaque distances, light and
// options. So it is the image that would be rendered, bit for bit, or it is not found.
// Owns: nothing; the folder belongs to the caller. Threads: one at a time; any number of processes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "bench/reference/camera_rays.h"
#include "bench/reference/cloud_march.h"
#include "bench/reference/particle_image.h"

namespace dustbench::reference {

class ReferenceStore {
 public:
    /// More would not be read again: the runs of one world follow each other (Order in bench/suite/suite.h).
    static constexpr std::uintmax_t defaultBytes = std::uintmax_t{2} << 30;

    /// Without a folder: always renders. The folder is created with the first image; if the images need more than
    /// `maximumBytes`, the oldest are removed. Nothing is stored that would leave the disk less than this free.
    explicit ReferenceStore(std::filesystem::path folder = {}, std::uintmax_t maximumBytes = defaultBytes);

    /// The image of renderParticles or, with light, renderLitParticles; throws as they do. Errors of the disk are not
    /// reported: the image is rendered.
    [[nodiscard]] pictures::Image render(const Puffs& dust, const scene::View& view, const OpaqueDistances& distances,
                                         const std::optional<SunLight>& light, const ReferenceOptions& options);

    /// Number of images that were not rendered because they were found.
    [[nodiscard]] std::int64_t found() const { return found_; }

 private:
    [[nodiscard]] std::optional<pictures::Image> read(const std::string& key, const scene::View& view) const;
    void write(const std::string& key, const pictures::Image& image);
    void makeRoom();

    std::filesystem::path folder_;
    std::uintmax_t maximumBytes_;
    std::optional<std::uintmax_t> storedBytes_;  ///< of the folder, as far as this process knows
    std::int64_t found_ = 0;
};

}  // namespace dustbench::reference
