// Memory that is kept from frame to frame and grows where it must; what it held before is not kept when it grows.
#pragma once

#include <span>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::octree {

/// Owns: its elements, booked on a ledger. A steady load allocates nothing: growth leaves an eighth to spare.
template <typename T>
class ReusedArray {
 public:
    explicit ReusedArray(MemoryAccount& account) : memory_(account) {}

    /// Room for `count` elements of any value; what was there is lost if it had to grow.
    T* hold(std::size_t count) {
        if (memory_.size() < count) {
            const std::size_t size = count + count / 8;
            memory_.clear();
            memory_.shrink_to_fit();
            memory_.resize(size);
        }
        return memory_.data();
    }
    /// Room for `count` elements; the first `used` stay.
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
