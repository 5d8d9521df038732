#include "methods/shared/particles/death_list.h"

#include <bit>
#include <cstring>

namespace dustbench::particles {

static_assert(std::endian::native == std::endian::little);

DeathList::DeathList(MemoryLedger& ledger)
    : within_(ledger.account("particle deaths")),
      counts_(ledger.account("particle deaths")),
      indices_(ledger.account("particle deaths")) {}

void DeathList::prepare(std::size_t particles) {
    const std::size_t chunks = (particles + chunkSize - 1) / chunkSize;
    if (chunks > counts_.capacity()) {
        const std::size_t room = chunks + chunks / 4;
        counts_.reserve(room);
        within_.reserve(room * chunkSize);
    }
    counts_.resize(chunks);
    within_.resize(chunks * chunkSize);
}

void DeathList::note(std::size_t chunk, const std::uint8_t* dead, std::size_t count) {
    std::uint16_t* const list = within_.data() + chunk * chunkSize;
    std::uint32_t found = 0;
    std::size_t i = 0;
    // Most particles live: eight flags at a time.
    for (; i + 8 <= count; i += 8) {
        std::uint64_t flags;
        std::memcpy(&flags, dead + i, sizeof flags);
        // A flag is 1 in its byte: the lowest byte, the first particle, comes first.
        for (; flags != 0; flags &= flags - 1)
            list[found++] = static_cast<std::uint16_t>(i + static_cast<std::size_t>(std::countr_zero(flags)) / 8);
    }
    for (; i < count; ++i)
        if (dead[i]) list[found++] = static_cast<std::uint16_t>(i);
    counts_[chunk] = found;
}

std::span<const std::uint32_t> DeathList::collect() {
    indices_.clear();
    for (std::size_t chunk = 0; chunk < counts_.size(); ++chunk)
        for (std::uint32_t k = 0; k < counts_[chunk]; ++k)
            indices_.push_back(static_cast<std::uint32_t>(chunk * chunkSize + within_[chunk * chunkSize + k]));
    return indices_;
}

}  // namespace dustbench::particles
