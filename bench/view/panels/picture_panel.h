// The picture in the window with its stamp and mouse input, and the panel's controls for it: view, zoom, exposure, and
// the metrics of this frame.
//
// Threads: the canvas's, within PanelCanvas::draw.
#pragma once

#include <optional>

#include "bench/view/panels/panel_canvas.h"
#include "bench/view/viewer.h"

namespace dustbench::view {

class PicturePanel {
 public:
    /// Draws the picture behind everything, right of `left`, as large as fits.
    void showPicture(const Viewer& viewer, float left, int width, int height);
    /// Shows its stamp and the value under the cursor.
    void showStamp(Viewer& viewer, const PanelInput& input) const;
    /// Handles the mouse over the picture, unless the panels use it.
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

}  // namespace dustbench::view
