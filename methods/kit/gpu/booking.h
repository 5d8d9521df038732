// Books bytes on a ledger for an object's lifetime.
#pragma once

#include <utility>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::gpu {

class Booking {
 public:
    Booking() = default;
    Booking(MemoryAccount& account, std::size_t bytes) : account_(&account), bytes_(bytes) { account.book(bytes); }
    ~Booking() {
        if (account_) account_->release(bytes_);
    }
    Booking(Booking&& other) noexcept
        : account_(std::exchange(other.account_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
    Booking& operator=(Booking&& other) noexcept {
        std::swap(account_, other.account_);
        std::swap(bytes_, other.bytes_);
        return *this;
    }

    [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
    MemoryAccount* account_ = nullptr;
    std::size_t bytes_ = 0;
};

}  // namespace dustbench::gpu
