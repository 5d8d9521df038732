// Looks up bricks of a sparse grid. Remembers the nodes of the last one, which makes nearby lookups cheap.
//
// Units: bricks and cells of the lattice. Threads: one walk per thread. Internal to marches on the CPU.
#pragma once

#include <nanovdb/NanoVDB.h>

#include "methods/volume/sparse/nano_tree.h"

namespace dustbench::volume {

class NanoWalk {
 public:
    explicit NanoWalk(const NanoTree& tree)
        : root_(tree.empty() ? nullptr
                             : &reinterpret_cast<const nanovdb::NanoGrid<float>*>(tree.bytes().data())->tree().root()) {
    }

    struct Found {
        const float* values = nullptr;          ///< of a leaf, z fastest
        const std::uint64_t* active = nullptr;  ///< cells of a leaf, a word for each x
        int emptyEdge = 0;  ///< cells along the edge of the empty node that contains the brick; 0: it is active
    };

    [[gnu::always_inline]] Found at(const glm::ivec3& brick) {
        constexpr int lowerBits = 4, upperBits = 9;  // bricks along a node's edge
        if (const glm::ivec3 node = brick >> lowerBits; node != lowerPlace_) findLower(node);
        if (!lower_) return {nullptr, nullptr, emptyEdge_};
        const auto place = static_cast<std::uint32_t>((brick.x & 15) << 8 | (brick.y & 15) << 4 | (brick.z & 15));
        static_assert(upperBits - lowerBits == 5);
        if (lower_->mChildMask.isOn(place)) {
            const auto* const leaf = lower_->getChild(place)->data();
            return {leaf->mValues, &leaf->mValueMask.template getWord<std::uint64_t>(0), 0};
        }
        return {nullptr, nullptr, lower_->mValueMask.isOn(place) ? 0 : brickEdge};
    }

 private:
    using Lower = nanovdb::NanoLower<float>::DataType;

    void findLower(const glm::ivec3& node) {
        lowerPlace_ = node;
        lower_ = nullptr;
        emptyEdge_ = 4096;
        if (!root_) return;
        const nanovdb::Coord first(node.x * 128, node.y * 128, node.z * 128);
        const auto* const tile = root_->probeTile(first);
        if (!tile) return;
        emptyEdge_ = 128;
        const auto* const upper = root_->data()->getChild(tile)->data();
        const std::uint32_t place = nanovdb::NanoUpper<float>::CoordToOffset(first);
        if (upper->mChildMask.isOn(place)) lower_ = upper->getChild(place)->data();
    }

    const nanovdb::NanoRoot<float>* root_;
    const Lower* lower_ = nullptr;
    glm::ivec3 lowerPlace_{1 << 30};
    int emptyEdge_ = 4096;
};

}  // namespace dustbench::volume
