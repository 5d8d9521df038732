#include "methods/voxel_shape/particles/shape_particles.h"

#include <algorithm>
#include <span>

#include "methods/kit/maths/hash.h"

namespace dustbench::voxel_shape {

ShapeParticles::ShapeParticles(MemoryLedger& ledger)
    : store(ledger),
      place(ledger.account("particle places")),
      settlingSeconds(ledger.account("particle looks")),
      picture(ledger.account("particle looks")),
      pictureSpeed(ledger.account("particle looks")),
      birthplace(ledger.account("particle births")) {
    store.keepOneColour(false);
}

void ShapeParticles::resize(std::size_t count) {
    if (count > place.capacity()) {
        const std::size_t room = std::max(count, place.capacity() + place.capacity() / 4);
        place.reserve(room);
        for (auto* column : {&settlingSeconds, &picture, &pictureSpeed}) column->reserve(room);
    }
    store.resize(count);
    place.resize(count);
    for (auto* column : {&settlingSeconds, &picture, &pictureSpeed}) column->resize(count);
    if (keepsBirthplaces_) birthplace.resize(count);
}

void ShapeParticles::move(std::size_t from, std::size_t to) {
    store.move(from, to);
    place[to] = place[from];
    for (auto* column : {&settlingSeconds, &picture, &pictureSpeed}) (*column)[to] = (*column)[from];
    if (keepsBirthplaces_) birthplace[to] = birthplace[from];
}

std::uint64_t ShapeParticles::hash() const {
    maths::Hash hash;
    hash.add(store.hash()).add(std::span<const std::uint32_t>(place));
    for (const auto* column : {&settlingSeconds, &picture, &pictureSpeed}) hash.add(std::span<const float>(*column));
    return hash.value();
}

}  // namespace dustbench::voxel_shape
