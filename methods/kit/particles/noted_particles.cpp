#include "methods/kit/particles/noted_particles.h"

#include <numeric>

namespace dustbench::particles {

NotedParticles::NotedParticles(MemoryLedger& ledger, const char* account)
    : within_(ledger.account(account)), counts_(ledger.account(account)), indices_(ledger.account(account)) {}

void NotedParticles::prepare(std::size_t particles) {
    const std::size_t chunks = (particles + chunkSize - 1) / chunkSize;
    if (chunks > counts_.capacity()) {
        const std::size_t room = chunks + chunks / 4;
        counts_.reserve(room);
        within_.reserve(room * chunkSize);
    }
    counts_.resize(chunks);
    within_.resize(chunks * chunkSize);
}

void NotedParticles::note(std::size_t chunk, const std::uint8_t* flags, std::size_t count) {
    std::uint16_t* const list = within_.data() + chunk * chunkSize;
    std::uint32_t found = 0;
    forEachFlagged(flags, count, [&](std::size_t i) { list[found++] = static_cast<std::uint16_t>(i); });
    counts_[chunk] = found;
}

std::span<const std::uint32_t> NotedParticles::collect() {
    indices_.resize(std::accumulate(counts_.begin(), counts_.end(), std::size_t{0}));
    std::uint32_t* next = indices_.data();
    for (std::size_t chunk = 0; chunk < counts_.size(); ++chunk) {
        const std::uint16_t* const within = within_.data() + chunk * chunkSize;
        for (std::uint32_t k = 0; k < counts_[chunk]; ++k)
            *next++ = static_cast<std::uint32_t>(chunk * chunkSize + within[k]);
    }
    return indices_;
}

}  // namespace dustbench::particles
