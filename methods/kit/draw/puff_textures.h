// Textures that replace a puff's Gaussian: one picture, several, the frames of an animation, or a video.
//
// A file is a strip of square frames side by side. Its alpha is read as optical depth and scaled so that each frame's
// mean over the quad equals that of the Gaussian exp(−b²/2s²): a puff keeps its mass. Its colour is shading, scaled so
// that each frame's mean luminance, weighted by alpha, is 1: a cloud keeps its colour. A video has these means over all
// of its frames, so that it flickers as recorded.
//
// Owns: the texture array.
#pragma once

#include <filesystem>

#include "methods/kit/gpu/texture.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::draw {

class DUSTBENCH_API PuffTextures {
 public:
    enum class Frames {
        separate,
        crossFaded,  ///< each frame fades into the next one
        looped,      ///< a video: cross-faded, and the last frame fades into the first one
    };

    /// Throws InputError if the file cannot be read, is not a strip of square frames, or has an empty frame.
    PuffTextures(gpu::Device& device, const std::filesystem::path& file, Frames frames);

    [[nodiscard]] int frames() const { return texture_.depth() - (frames_ == Frames::looped ? 1 : 0); }
    [[nodiscard]] bool crossFaded() const { return frames_ != Frames::separate; }
    [[nodiscard]] const gpu::Texture& texture() const { return texture_; }
    /// Optical depth of a stored alpha of 1, relative to the puff's τ.
    [[nodiscard]] float opticalDepthScale() const { return opticalDepthScale_; }
    /// Colour of a stored colour of 1, relative to the puff's colour.
    [[nodiscard]] float shadeScale() const { return shadeScale_; }

 private:
    Frames frames_;
    gpu::Texture texture_;
    float opticalDepthScale_ = 1;
    float shadeScale_ = 1;
};

}  // namespace dustbench::draw
