// Dust from files: the particles at any time between the first moment and the last.
//
// Between two moments there are the particles of the first of them. Those that are in the second too, by their id, move
// from one to the other in a straight line, and their other quantities change evenly; the others move on by their
// velocity until then. Without ids, particles are matched by their row.
// Units: m, m/s, s; times count from the first moment. Frame: world. Threads: const members are safe from any.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/scene/dust_moment.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::bench {

/// A time that misses a moment by less is that moment: files round their times.
inline constexpr double sameMomentSeconds = 1e-5;

class DustSeries {
 public:
    /// `columns` as for DustColumns::parse. Throws InputError, one line with the file.
    static DustSeries read(const std::filesystem::path& path, const std::string& columns);
    /// One moment or more. Throws InputError if times are missing or do not ascend, or the moments have not the same
    /// columns.
    explicit DustSeries(std::vector<DustMoment> moments);

    /// One moment alone is a still cloud, which lasts.
    [[nodiscard]] bool isStill() const { return moments_.size() == 1; }
    /// From the first moment to the last.
    [[nodiscard]] double seconds() const;
    [[nodiscard]] std::size_t moments() const { return moments_.size(); }
    /// Particles that are new in a moment, or missing in the next, over the whole series.
    [[nodiscard]] std::size_t births() const { return births_; }
    [[nodiscard]] std::size_t deaths() const { return deaths_; }
    /// Of all moments.
    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] bool hasColour() const { return moments_.front().hasColour; }
    /// What dust of one colour reflects, as the file says; empty: as the scene's.
    [[nodiscard]] const std::optional<glm::vec3>& albedo() const { return albedo_; }
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

    /// The particles so many seconds after the first moment; before it the first moment, after the end the last.
    void show(double seconds, particles::ParticleStore& store) const;

 private:
    void match();
    void fillAges();

    std::vector<DustMoment> moments_;
    std::vector<std::filesystem::path> files_;
    std::optional<glm::vec3> albedo_;
    std::size_t births_ = 0, deaths_ = 0;
};

}  // namespace dustbench::bench
