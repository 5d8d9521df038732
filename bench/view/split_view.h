// Puts two pictures into one: side by side under a divider, one alone, or their signed difference.
//
// Units: pictures display-encoded, as they come. Frame: shares of width and height from the lower left corner. A
// picture is enlarged by repeating its pixels, so that single ones can be told apart.
#pragma once

#include "methods/contract/choices.h"
#include "methods/kit/gpu/framebuffer.h"
#include "methods/kit/gpu/program.h"
#include "methods/kit/gpu/texture.h"
#include "methods/kit/gpu/vertex_array.h"

namespace dustbench::bench {

enum class Shown { a, b, wipe, difference };
inline constexpr Choices<Shown> shownChoices{
    {"A", Shown::a}, {"B", Shown::b}, {"wipe", Shown::wipe}, {"difference", Shown::difference}};

struct SplitSettings {
    Shown shown = Shown::wipe;
    float divider = 0.5f;  ///< share of the width that shows A
    float gain = 4;        ///< of the difference, above 0
    glm::vec2 origin{0};   ///< of the part that is shown: a share of the pictures
    glm::vec2 extent{1};
};

class SplitView {
 public:
    explicit SplitView(gpu::Device& device);

    /// Fills the target, which is `width` × `height`. Throws std::invalid_argument if the pictures differ in size.
    void draw(const gpu::Texture& a, const gpu::Texture& b, const SplitSettings& settings,
              const gpu::Framebuffer& target, int width, int height);

 private:
    gpu::Program program_;
    gpu::VertexArray noVertices_;
};

}  // namespace dustbench::bench
