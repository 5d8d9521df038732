// Dust from files: the particles at any time between the first moment and the last.
//
// Between two moments, the particles are those of the first. Particles that are also in the second, by their id, move
// to their new positions in a straight line, and their other quantities change linearly; the others continue with their
// velocity. Without ids, particles are matched by row.
// Units: m, m/s, s; times count from the first moment. Frame: world. Threads: const members are safe from any.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/world/dust_moment.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::world {

/// Times closer than this are the same moment: files round their times.
inline constexpr double sameMomentSeconds = 1e-5;

class DustSeries {
 public:
    /// `columns` as for DustColumns::parse. Throws InputError, one line with the file.
    static DustSeries read(const std::filesystem::path& path, const std::string& columns);
    /// One or more moments. Throws InputError if times are missing or do not ascend, or if the moments have different
    /// columns.
    explicit DustSeries(std::vector<DustMoment> moments);

    /// True for a single moment: a still cloud that lasts.
    [[nodiscard]] bool isStill() const { return moments_.size() == 1; }
    /// Duration from the first moment to the last.
    [[nodiscard]] double seconds() const;
    [[nodiscard]] std::size_t moments() const { return moments_.size(); }
    /// Number of particles that are new in a moment or missing in the next one, over the whole series.
    [[nodiscard]] std::size_t births() const { return births_; }
    [[nodiscard]] std::size_t deaths() const { return deaths_; }
    /// Memory of all moments.
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] bool hasColour() const { return moments_.front().hasColour; }
    /// Albedo of dust of one colour from the file; empty: that of the scene.
    [[nodiscard]] const std::optional<glm::vec3>& albedo() const { return albedo_; }
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

    /// The particles this many seconds after the first moment; before it those of the first moment, after the end those
    /// of the last.
    void show(double seconds, particles::ParticleStore& store) const;

 private:
    void match();
    void fillAges();

    std::vector<DustMoment> moments_;
    std::vector<std::filesystem::path> files_;
    std::optional<glm::vec3> albedo_;
    std::size_t births_ = 0, deaths_ = 0;
};

}  // namespace dustbench::world
