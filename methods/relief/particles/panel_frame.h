// Entry of dust into a panel: transforms of positions and velocities between the world and the frame of the panel,
// which may move and turn; and the set of the particles that have entered.
//
// Units: m, m/s. Threads: pure; a set may be read by any thread and has one writer. Source: Bergeron, 5 (as future
// work).
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>

#include "methods/contract/scene.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::relief {

/// Position and velocity in one frame.
struct Moving {
    glm::dvec3 place{0}, velocity{0};
};

/// A panel's pose at the beginning and at the end of a step.
class PanelFrame {
 public:
    PanelFrame() = default;
    PanelFrame(const glm::dmat4& toWorldBefore, const glm::dmat4& toWorldAfter, double seconds);

    /// Transforms at the end of the step. The velocity is relative to the panel's own at that place.
    [[nodiscard]] Moving toPanel(const Moving& world) const;
    /// The inverse of `toPanel`.
    [[nodiscard]] Moving toWorld(const Moving& panel) const;
    /// Transforms a place at the beginning of the step.
    [[nodiscard]] glm::dvec3 toPanelBefore(const glm::dvec3& world) const;
    /// Transforms a direction of the world, such as gravity, at the end of the step.
    [[nodiscard]] glm::dvec3 directionToPanel(const glm::dvec3& world) const;

 private:
    [[nodiscard]] glm::dvec3 velocityAt(const glm::dvec3& panelPlace) const;

    glm::dmat4 before_{1}, after_{1};
    glm::dmat4 fromWorldBefore_{1}, fromWorldAfter_{1};
    double seconds_ = 1;
};

/// A set of serials of particles. Serials increase with time and particles live for a limited time, so the set is a
/// moving window of bits, booked on a ledger.
class SerialSet {
 public:
    explicit SerialSet(MemoryLedger& ledger) : words_(ledger.account("relief serials")) {}

    [[nodiscard]] bool contains(std::uint64_t serial) const {
        if (serial < first_ || serial - first_ >= 64 * words_.size()) return false;
        return (words_[(serial - first_) / 64] >> ((serial - first_) % 64) & 1) != 0;
    }
    /// Serials below the last `forgetBelow` are not added.
    void insert(std::uint64_t serial) {
        if (serial < first_) return;
        const std::uint64_t word = (serial - first_) / 64;
        if (word >= words_.size()) words_.resize(word + 1, 0);
        words_[word] |= std::uint64_t{1} << ((serial - first_) % 64);
    }
    /// Drops serials below `oldest`, whose particles are dead; up to 63 of them may remain.
    void forgetBelow(std::uint64_t oldest) {
        if (oldest < first_ + 64) return;
        const std::uint64_t words = std::min<std::uint64_t>((oldest - first_) / 64, words_.size());
        words_.erase(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(words));
        first_ = oldest - oldest % 64;
    }

 private:
    std::uint64_t first_ = 0;  ///< serial of the first bit, a multiple of 64
    LedgerVector<std::uint64_t> words_;
};

}  // namespace dustbench::relief
