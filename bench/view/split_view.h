// Combines the pictures of two halves: with a divider, side by side, one alone, or as a signed difference.
//
// Units: shares of width and height from the lower left corner. Zooming in repeats pixels, so that single pixels stay
// visible. Pictures with fewer rows than the target are interpolated. Threads: the device's.
#pragma once

#include <array>
#include <span>

#include "methods/contract/choices.h"
#include "methods/kit/gpu/draw_call.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::view {

/// How the two pictures are combined. flip: FLIP's map between them.
enum class Shown { a, b, wipe, sideBySide, difference, flip };
inline constexpr Choices<Shown> shownChoices{{"A", Shown::a},
                                             {"B", Shown::b},
                                             {"wipe", Shown::wipe},
                                             {"beside", Shown::sideBySide},
                                             {"difference", Shown::difference},
                                             {"flip", Shown::flip}};

/// The quantity that is shown.
///   alpha     of the layer: 0 black, 1 white
///   depth     of the opaque scene along the camera's axis, by its logarithm: white at 1 m, black from 1 km on
///   overdraw  primitives over each pixel
///   outlines  of these primitives, over the darkened picture
///   faults    magenta: a value is not finite; cyan: a colour is negative; yellow: alpha is outside [0, 1]
enum class Channel { picture, alpha, depth, overdraw, outlines, faults };
inline constexpr Choices<Channel> channelChoices{{"picture", Channel::picture},   {"alpha", Channel::alpha},
                                                 {"depth", Channel::depth},       {"overdraw", Channel::overdraw},
                                                 {"outlines", Channel::outlines}, {"faults", Channel::faults}};

struct SplitSettings {
    Shown shown = Shown::wipe;
    float divider = 0.5f;  ///< share of the width that shows A
    float gain = 4;        ///< of the difference, above 0
    glm::vec2 origin{0};   ///< of the visible part: a share of the pictures
    glm::vec2 extent{1};
    Channel channel = Channel::picture;
    float stops = 0;      ///< exposure: light is multiplied by 2^stops before it is encoded
    bool encoded = true;  ///< for display; otherwise linear light, only for the channel `picture`

    friend bool operator==(const SplitSettings&, const SplitSettings&) = default;
};

/// A rectangle of a picture, in shares.
struct PicturePart {
    glm::vec2 from{0}, to{1};
    [[nodiscard]] bool isEmpty() const { return !(from.x < to.x && from.y < to.y); }
    [[nodiscard]] double area() const { return isEmpty() ? 0 : static_cast<double>((to.x - from.x) * (to.y - from.y)); }

    friend bool operator==(const PicturePart&, const PicturePart&) = default;
};
/// Of A and of B.
using PictureParts = std::array<PicturePart, 2>;
/// What the settings show of each picture.
[[nodiscard]] PictureParts shownParts(const SplitSettings& settings);

/// The textures that a half has drawn, all of the same size.
struct HalfTextures {
    const gpu::Texture& display;  ///< the picture, display-encoded
    const gpu::Texture& scene;    ///< linear light
    const gpu::Texture& layer;    ///< premultiplied, linear light
    const gpu::Texture& depth;    ///< reversed depth of the scene
};

class SplitView {
 public:
    explicit SplitView(gpu::Device& device);

    /// Fills the target, which is `width` × `height`. `flip`, `overdraw` and `outlines` show `display`, into which the
    /// caller must have put these maps. Throws std::invalid_argument if the halves differ in size.
    void draw(const HalfTextures& a, const HalfTextures& b, const SplitSettings& settings, double nearMetres,
              const gpu::Framebuffer& target, int width, int height);

 private:
    gpu::Program program_;
    gpu::VertexArray noVertices_;
};

// --- Pictures and maps computed on the CPU, as textures. Rows from the top become rows from the bottom.

/// Uploads into a texture of the image's size: unchanged into rgba32F, display-encoded and opaque into rgba8.
void upload(const pictures::Image& image, gpu::Texture& texture);
/// Uploads one number per pixel into a texture with one channel.
void uploadRows(std::span<const float> values, gpu::Texture& texture);

}  // namespace dustbench::view
