// Owns an OpenGL object name.
#pragma once

#include <cstdint>
#include <utility>

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

}  // namespace dustbench::gpu
