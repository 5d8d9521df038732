// What the objects of this folder own: an OpenGL name, and bytes on a ledger.
#pragma once

#include <cstdint>
#include <utility>

#include "methods/kit/memory/memory_ledger.h"

namespace dustbench::gpu {

/// Move-only owner of one OpenGL name; `remove` deletes it.
class Name {
 public:
    using Remove = void (*)(std::uint32_t);

    Name() = default;
    Name(std::uint32_t value, Remove remove) : value_(value), remove_(remove) {}
    ~Name() {
        if (value_) remove_(value_);
    }
    Name(Name&& other) noexcept : value_(std::exchange(other.value_, 0)), remove_(other.remove_) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(value_, other.value_);
        std::swap(remove_, other.remove_);
        return *this;
    }

    [[nodiscard]] std::uint32_t get() const { return value_; }

 private:
    std::uint32_t value_ = 0;
    Remove remove_ = nullptr;
};

/// Move-only; books bytes on a ledger for its lifetime.
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
