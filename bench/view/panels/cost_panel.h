// The costs of the window's frames: times of A and B by stage, the window's own share, memory by structure.
//
// Units: milliseconds, bytes. Threads: the canvas's, within PanelCanvas::draw.
#pragma once

#include "bench/view/panels/panel_canvas.h"
#include "bench/view/viewer.h"

namespace dustbench::view {

/// Milliseconds at the full height of both halves' charts: 1.25 times the slower half's 95th percentile, so that one
/// slow frame does not flatten the others.
[[nodiscard]] double stackScaleMs(const Viewer& viewer);

/// Sections `Costs` and `Memory`.
void showCosts(const Viewer& viewer, WidgetMap& widgets);

}  // namespace dustbench::view
