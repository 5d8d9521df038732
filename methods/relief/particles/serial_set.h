// A set of serials of particles. Serials increase with time and particles live for a limited time, so the set is a
// moving window of bits.
//
// Owns: its bits, booked on a ledger. Threads: any thread may read; one writer.
#pragma once

#include <algorithm>
#include <cstdint>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::relief {

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
