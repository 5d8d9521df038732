// What the frames of the window cost: times of A and B by stage, the window's own share, memory by structure.
//
// Units: milliseconds, bytes. Threads: the canvas's, within PanelCanvas::draw.
#pragma once

#include "bench/view/panels/panel_canvas.h"
#include "bench/view/viewer.h"

namespace dustbench::bench {

/// Sections `Costs` and `Memory`.
void showCosts(const Viewer& viewer, WidgetMap& widgets);

}  // namespace dustbench::bench
