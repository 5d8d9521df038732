// The picture in the window with its stamp and the mouse over it, and what the panel says of it: which view, how large,
// how bright, and the numbers of this frame.
//
// Threads: the canvas's, within PanelCanvas::draw.
#pragma once

#include <optional>

#include "bench/view/panels/panel_canvas.h"
#include "bench/view/viewer.h"

namespace dustbench::bench {

class PicturePanel {
 public:
    /// Behind everything, right of `left`, as large as it fits.
    void showPicture(const Viewer& viewer, float left, int width, int height);
    /// Its stamp, and the value under the cursor.
    void showStamp(Viewer& viewer, const PanelInput& input) const;
    /// The mouse over the picture, unless the panels use it.
    void useMouse(Viewer& viewer, const PanelInput& input);
    /// Widgets are named by their labels: `wipe`, `divider`, `channel`, `exposure`, `zoom` …
    void showChoices(Viewer& viewer, WidgetMap& widgets);

 private:
    [[nodiscard]] std::optional<glm::vec2> placeOf(glm::vec2 mouse) const;
    static void showHalves(Viewer& viewer, WidgetMap& widgets);
    static void showChannel(Viewer& viewer, WidgetMap& widgets);
    static void showExact(Viewer& viewer, WidgetMap& widgets);

    PanelRectangle picture_;
    std::optional<PanelInput> before_;
};

}  // namespace dustbench::bench
