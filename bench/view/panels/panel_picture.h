// The picture of one frame of the window, drawn without a window.
#pragma once

#include "bench/view/split_view.h"
#include "bench/view/view_state.h"
#include "methods/kit/pictures/image.h"

namespace dustbench::bench {

/// Draws the whole window, `width` × `height`, at the state's frame. Linear light. Throws InputError for a state that
/// cannot be shown, or without OpenGL.
[[nodiscard]] pictures::Image panelPicture(const ViewState& state, const SplitSettings& split, int width, int height);

}  // namespace dustbench::bench
