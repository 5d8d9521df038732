// An array that keeps its memory between frames and grows on demand.
#pragma once

#include <span>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::octree {

/// Owns: its elements, booked on a ledger. Growth reserves extra capacity, so that a steady load does not allocate.
template <typename T>
class ReusedArray {
 public:
    explicit ReusedArray(MemoryAccount& account) : memory_(account) {}

    /// Space for `count` elements of unspecified value; growth discards the old contents.
    T* hold(std::size_t count) {
        if (memory_.size() < count) {
            const std::size_t size = count + count / 8;
            memory_.clear();
            memory_.shrink_to_fit();
            memory_.resize(size);
        }
        return memory_.data();
    }
    /// Space for `count` elements; keeps the first `used`.
    T* extend(std::size_t count, std::size_t used) {
        if (memory_.size() < count) {
            memory_.resize(used);
            memory_.resize(count + count / 2);
        }
        return memory_.data();
    }
    [[nodiscard]] T* data() { return memory_.data(); }
    [[nodiscard]] const T* data() const { return memory_.data(); }
    [[nodiscard]] std::size_t size() const { return memory_.size(); }

 private:
    LedgerVector<T> memory_;
};

}  // namespace dustbench::octree
