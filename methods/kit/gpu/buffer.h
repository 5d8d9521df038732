// A block of GPU memory.
//
// Owns: the OpenGL buffer. Its bytes are booked on the device's ledger under `label`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/ownership.h"

namespace dustbench::gpu {

class DUSTBENCH_API Buffer {
 public:
    /// An empty buffer; assign a real one before use.
    Buffer() = default;
    /// Contents are undefined until written.
    Buffer(Device& device, std::string_view label, std::size_t bytes);

    template <typename T>
    Buffer(Device& device, std::string_view label, std::span<const T> data) : Buffer(device, label, data.size_bytes()) {
        write(data);
    }

    /// Replaces the first `data.size()` elements. Throws std::out_of_range if they do not fit.
    template <typename T>
    void write(std::span<const T> data) {
        writeBytes(data.data(), data.size_bytes());
    }
    /// Replaces `data.size()` elements from element `first` on. Throws std::out_of_range if they do not fit.
    template <typename T>
    void writeFrom(std::size_t first, std::span<const T> data) {
        writeBytes(data.data(), data.size_bytes(), first * sizeof(T));
    }
    /// Reads back the first `data.size()` elements. Waits for the GPU.
    template <typename T>
    void read(std::span<T> data) const {
        readBytes(data.data(), data.size_bytes());
    }

    /// Replaces the first `bytes` by those of another buffer, on the GPU. Throws std::out_of_range if they do not fit.
    void copyFrom(const Buffer& other, std::size_t bytes);

    /// Sets all bytes to 0.
    void clear();

    /// Returns `bytes` of memory to fill. Discards the old contents, so that it need not wait for queued draws. The
    /// memory is write-only and valid until `unmap`.
    [[nodiscard]] void* mapForWriting(std::size_t bytes);
    void unmap();

    void bindStorage(std::uint32_t binding) const;
    void bindUniform(std::uint32_t binding) const;

    [[nodiscard]] std::size_t bytes() const { return booking_.bytes(); }
    [[nodiscard]] const Name& name() const { return name_; }

 private:
    void writeBytes(const void* data, std::size_t bytes, std::size_t from = 0);
    void readBytes(void* data, std::size_t bytes) const;

    Name name_;
    Booking booking_;
};

}  // namespace dustbench::gpu
