#include "methods/kit/gpu/texture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <string>

#include "methods/kit/gpu/debug_output.h"
#include "methods/kit/gpu/mip_levels.h"

namespace dustbench::gpu {
namespace {

struct FormatNames {
    GLenum internal;
    GLenum channels;
    int count;
    bool bytes;  ///< 8-bit values rather than floats
};

FormatNames namesOf(Format format) {
    switch (format) {
        case Format::rgba8:
            return {GL_RGBA8, GL_RGBA, 4, true};
        case Format::srgba8:
            return {GL_SRGB8_ALPHA8, GL_RGBA, 4, true};
        case Format::rgba16F:
            return {GL_RGBA16F, GL_RGBA, 4, false};
        case Format::rgba32F:
            return {GL_RGBA32F, GL_RGBA, 4, false};
        case Format::r8:
            return {GL_R8, GL_RED, 1, true};
        case Format::r16F:
            return {GL_R16F, GL_RED, 1, false};
        case Format::r32F:
            return {GL_R32F, GL_RED, 1, false};
        case Format::depth32F:
            return {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, 1, false};
    }
    throw std::invalid_argument("unknown texture format");
}

int mipLevels(int width, int height) {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height))));
}

std::size_t texels(int width, int height, int depth) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(depth);
}

std::size_t bytesWithMips(Format format, int width, int height, int depth, int levels) {
    std::size_t total = 0;
    for (int level = 0; level < levels; ++level)
        total += texels(std::max(width >> level, 1), std::max(height >> level, 1), depth);
    return total * bytesPerTexel(format);
}

}  // namespace

Texture::Texture(Device& device, std::string_view label, Kind kind, Format format, int width, int height, int depth,
                 Filter filter, Wrap wrap)
    : kind_(kind),
      format_(format),
      width_(width),
      height_(height),
      depth_(depth),
      mipmapped_(filter == Filter::mipmapped) {
    if (width < 1 || height < 1 || depth < 1)
        throw std::invalid_argument("texture '" + std::string(label) + "': got " + std::to_string(width) + "x" +
                                    std::to_string(height) + "x" + std::to_string(depth) + ", expected 1 or more each");
    const GLenum target = kind == Kind::flat    ? GL_TEXTURE_2D
                          : kind == Kind::array ? GL_TEXTURE_2D_ARRAY
                                                : GL_TEXTURE_3D;
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    name_ = Name(name, [](std::uint32_t value) { glDeleteTextures(1, &value); });
    glObjectLabel(GL_TEXTURE, name, static_cast<GLsizei>(label.size()), label.data());

    const int levels = mipmapped_ ? mipLevels(width, height) : 1;
    const GLenum internal = namesOf(format).internal;
    if (kind == Kind::flat)
        glTextureStorage2D(name, levels, internal, width, height);
    else
        glTextureStorage3D(name, levels, internal, width, height, depth);
    const std::size_t bytes = bytesWithMips(format, width, height, depth, levels);
    requireAllocated(label, bytes);
    booking_ = Booking(device.ledger().account(label), bytes);

    const GLint edge = wrap == Wrap::repeat ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTextureParameteri(name, axis, edge);
    const bool smooth = filter != Filter::nearest;
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER,
                        mipmapped_ ? GL_LINEAR_MIPMAP_LINEAR
                        : smooth   ? GL_LINEAR
                                   : GL_NEAREST);
    throwOnDebugOutput(label);
}

Texture Texture::make2D(Device& device, std::string_view label, Format format, int width, int height, Filter filter,
                        Wrap wrap) {
    return {device, label, Kind::flat, format, width, height, 1, filter, wrap};
}

Texture Texture::make2DArray(Device& device, std::string_view label, Format format, int width, int height, int layers,
                             Filter filter) {
    return {device, label, Kind::array, format, width, height, layers, filter, Wrap::clamp};
}

Texture Texture::make3D(Device& device, std::string_view label, Format format, int width, int height, int depth,
                        Filter filter) {
    return {device, label, Kind::volume, format, width, height, depth, filter, Wrap::clamp};
}

void Texture::writeTexels(int firstLayer, int layers, const void* values, std::size_t count, std::size_t valueBytes) {
    const FormatNames names = namesOf(format_);
    const std::size_t expected = texels(width_, height_, layers) * static_cast<std::size_t>(names.count);
    if (count != expected || names.bytes != (valueBytes == 1))
        throw std::invalid_argument("texture: got " + std::to_string(count) + (valueBytes == 1 ? " bytes" : " floats") +
                                    ", expected " + std::to_string(expected) + (names.bytes ? " bytes" : " floats"));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const GLenum type = names.bytes ? GL_UNSIGNED_BYTE : GL_FLOAT;
    if (kind_ == Kind::flat)
        glTextureSubImage2D(name_.get(), 0, 0, 0, width_, height_, names.channels, type, values);
    else
        glTextureSubImage3D(name_.get(), 0, 0, 0, firstLayer, width_, height_, layers, names.channels, type, values);
    if (mipmapped_ && names.bytes && kind_ != Kind::volume)
        writeMipLevels(firstLayer, layers, static_cast<const std::uint8_t*>(values), expected);
    else if (mipmapped_)
        glGenerateTextureMipmap(name_.get());
    throwOnDebugOutput("writing a texture");
}

void Texture::writeMipLevels(int firstLayer, int layers, const std::uint8_t* values, std::size_t count) {
    const FormatNames names = namesOf(format_);
    const std::size_t ofLayer = count / static_cast<std::size_t>(layers);
    for (int layer = 0; layer < layers; ++layer) {
        const std::span texture(values + static_cast<std::size_t>(layer) * ofLayer, ofLayer);
        GLint level = 0;
        for (const MipLevel& mip : mipLevelsOf(texture, width_, height_, names.count, format_ == Format::srgba8)) {
            ++level;
            if (kind_ == Kind::flat)
                glTextureSubImage2D(name_.get(), level, 0, 0, mip.width, mip.height, names.channels, GL_UNSIGNED_BYTE,
                                    mip.values.data());
            else
                glTextureSubImage3D(name_.get(), level, 0, 0, firstLayer + layer, mip.width, mip.height, 1,
                                    names.channels, GL_UNSIGNED_BYTE, mip.values.data());
        }
    }
}

void Texture::write(std::span<const std::uint8_t> values) {
    writeTexels(0, depth_, values.data(), values.size(), 1);
}

void Texture::write(std::span<const float> values) {
    writeTexels(0, depth_, values.data(), values.size(), sizeof(float));
}

void Texture::writeRectangle(int column, int row, int width, int height, std::span<const std::uint8_t> values) {
    const FormatNames names = namesOf(format_);
    const bool inside = column >= 0 && row >= 0 && width >= 1 && height >= 1 && column + width <= width_ &&
                        row + height <= height_ && kind_ == Kind::flat && names.bytes;
    if (!inside || values.size() != texels(width, height, 1) * static_cast<std::size_t>(names.count))
        throw std::invalid_argument("texture of " + std::to_string(width_) + "x" + std::to_string(height_) + ": got " +
                                    std::to_string(values.size()) + " bytes for " + std::to_string(width) + "x" +
                                    std::to_string(height) + " texels from (" + std::to_string(column) + ", " +
                                    std::to_string(row) +
                                    ") on, expected texels within it and a byte for each channel");
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(name_.get(), 0, column, row, width, height, names.channels, GL_UNSIGNED_BYTE, values.data());
    throwOnDebugOutput("writing a texture");
}

void Texture::makeMipmaps() {
    if (mipmapped_) glGenerateTextureMipmap(name_.get());
}

void Texture::writeLayer(int layer, std::span<const std::uint8_t> values) {
    if (kind_ != Kind::array || layer < 0 || layer >= depth_)
        throw std::out_of_range("texture layer " + std::to_string(layer) + ": expected 0.." +
                                std::to_string(depth_ - 1));
    writeTexels(layer, 1, values.data(), values.size(), 1);
}

std::vector<float> Texture::readFloats() const {
    const FormatNames names = namesOf(format_);
    std::vector<float> values(texels(width_, height_, depth_) * static_cast<std::size_t>(names.count));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(name_.get(), 0, names.channels, GL_FLOAT, static_cast<GLsizei>(values.size() * sizeof(float)),
                      values.data());
    return values;
}

void Texture::setDepthComparison() {
    glTextureParameteri(name_.get(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTextureParameteri(name_.get(), GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
}

void Texture::bind(std::uint32_t unit) const {
    glBindTextureUnit(unit, name_.get());
}

void Texture::bindImage(std::uint32_t unit, bool read, bool write) const {
    const GLenum access = read && write ? GL_READ_WRITE : write ? GL_WRITE_ONLY : GL_READ_ONLY;
    glBindImageTexture(unit, name_.get(), 0, kind_ == Kind::flat ? GL_FALSE : GL_TRUE, 0, access,
                       namesOf(format_).internal);
}

}  // namespace dustbench::gpu
