// Pictures of puffs that take the Gaussian's place: one, several, or the frames of an animation.
//
// A file is a strip of square frames side by side. Its alpha is read as optical depth, scaled so that each frame's mean
// over the quad is that of the Gaussian exp(−b²/2s²) over its quad: the mass of a puff stays the same. Its colour is
// shade, scaled so that each frame's mean luminance, weighted with the alpha, is 1: the colour of a cloud stays too.
//
// Owns: the texture array.
#pragma once

#include <filesystem>

#include "methods/kit/gpu/texture.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::draw {

class DUSTBENCH_API PuffTextures {
 public:
    enum class Frames { separate, crossFaded };

    /// Throws InputError where the file cannot be read, is no strip of square frames, or has an empty frame.
    PuffTextures(gpu::Device& device, const std::filesystem::path& file, Frames frames);

    [[nodiscard]] int frames() const { return texture_.depth(); }
    [[nodiscard]] bool crossFaded() const { return frames_ == Frames::crossFaded; }
    [[nodiscard]] const gpu::Texture& texture() const { return texture_; }
    /// What a stored alpha of 1 stands for, relative to the puff's τ.
    [[nodiscard]] float opticalDepthScale() const { return opticalDepthScale_; }
    /// What a stored colour of 1 stands for, relative to the puff's colour.
    [[nodiscard]] float shadeScale() const { return shadeScale_; }

 private:
    Frames frames_;
    gpu::Texture texture_;
    float opticalDepthScale_ = 1;
    float shadeScale_ = 1;
};

}  // namespace dustbench::draw
