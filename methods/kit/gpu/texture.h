// A 2D, 2D-array or 3D texture of fixed size.
//
// Owns: the OpenGL texture. Its bytes are booked on the device's ledger under `label`.
// Frame: rows from the bottom, as in OpenGL. Edges clamp by default.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/ownership.h"

namespace dustbench::gpu {

/// Named after OpenGL's.
enum class Format { rgba8, srgba8, rgba16F, rgba32F, r8, r16F, r32F, depth32F };

/// Bytes of one texel.
[[nodiscard]] constexpr std::size_t bytesPerTexel(Format format) {
    switch (format) {
        case Format::r8:
            return 1;
        case Format::r16F:
            return 2;
        case Format::rgba8:
        case Format::srgba8:
        case Format::r32F:
        case Format::depth32F:
            return 4;
        case Format::rgba16F:
            return 8;
        case Format::rgba32F:
            return 16;
    }
    return 0;
}

enum class Filter { nearest, linear, mipmapped };
enum class Wrap { clamp, repeat };

class DUSTBENCH_API Texture {
 public:
    Texture() = default;
    [[nodiscard]] static Texture make2D(Device& device, std::string_view label, Format format, int width, int height,
                                        Filter filter = Filter::nearest, Wrap wrap = Wrap::clamp);
    [[nodiscard]] static Texture make2DArray(Device& device, std::string_view label, Format format, int width,
                                             int height, int layers, Filter filter = Filter::linear);
    [[nodiscard]] static Texture make3D(Device& device, std::string_view label, Format format, int width, int height,
                                        int depth, Filter filter = Filter::linear);

    /// All texels, tightly packed in the texture's own channels: bytes for the 8-bit formats, floats for the others.
    /// Writes the mip levels too if the filter needs them: of 8-bit formats by `mipLevelsOf`, equal on all devices.
    /// Throws std::invalid_argument for a wrong number of values.
    void write(std::span<const std::uint8_t> values);
    void write(std::span<const float> values);
    /// Writes `width` × `height` texels of a 2D texture of 8-bit channels, starting at (column, row). Mipmaps stay
    /// unchanged until `makeMipmaps`. Throws std::invalid_argument for a wrong number of values, or if the texels lie
    /// outside of the texture.
    void writeRectangle(int column, int row, int width, int height, std::span<const std::uint8_t> values);
    /// By the driver, which is fast enough for every frame; drivers round differently.
    void makeMipmaps();
    /// Writes one layer of an array.
    void writeLayer(int layer, std::span<const std::uint8_t> values);
    /// All texels as floats, tightly packed. Waits for the GPU.
    [[nodiscard]] std::vector<float> readFloats() const;

    /// Enables comparison on sampling (`sampler2DShadow`): 1 if the reference is ≥ the stored depth (reversed depth).
    void setDepthComparison();

    void bind(std::uint32_t unit) const;
    void bindImage(std::uint32_t unit, bool read, bool write) const;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] int depth() const { return depth_; }
    [[nodiscard]] Format format() const { return format_; }
    [[nodiscard]] std::size_t bytes() const { return booking_.bytes(); }
    [[nodiscard]] const Name& name() const { return name_; }

 private:
    enum class Kind { flat, array, volume };
    Texture(Device& device, std::string_view label, Kind kind, Format format, int width, int height, int depth,
            Filter filter, Wrap wrap);
    void writeTexels(int firstLayer, int layers, const void* values, std::size_t count, std::size_t valueBytes);
    void writeMipLevels(int firstLayer, int layers, const std::uint8_t* values, std::size_t count);

    Name name_;
    Booking booking_;
    Kind kind_ = Kind::flat;
    Format format_ = Format::rgba8;
    int width_ = 0;
    int height_ = 0;
    int depth_ = 1;
    bool mipmapped_ = false;
};

}  // namespace dustbench::gpu
