// A list of parameters, built from their declarations: slider, list, switch or text, with default, unit and help.
//
// Threads: the canvas's, within PanelCanvas::draw.
#pragma once

#include <optional>
#include <string>

#include "bench/view/panels/panel_canvas.h"
#include "methods/contract/parameters.h"

namespace dustbench::view {

/// A parameter whose value was changed by hand.
struct ParameterEdit {
    std::string name;
    std::optional<std::string> text;  ///< empty: back to its default
};

class ParameterPanel {
 public:
    /// Widgets are named `id/parameter`, and `id/parameter/reset` for a parameter that is set.
    explicit ParameterPanel(std::string id) : id_(std::move(id)) {}

    /// Shows all parameters with their values. Editing a slider ends when it is released, editing a text with Enter.
    [[nodiscard]] std::optional<ParameterEdit> show(const ParameterValues& values,
                                                    const std::map<std::string, std::string, std::less<>>& given,
                                                    WidgetMap& widgets);

 private:
    [[nodiscard]] std::optional<std::string> edit(const Parameter& parameter, const std::string& value);
    [[nodiscard]] std::optional<std::string> slide(const Parameter& parameter, const std::string& value);
    [[nodiscard]] std::optional<std::string> choose(const Parameter& parameter, const std::string& value);
    [[nodiscard]] std::optional<std::string> type(const Parameter& parameter, const std::string& value);

    std::string id_;
    std::string edited_;  ///< name of the parameter that is being edited; empty: none
    double slid_ = 0;
    std::string typed_;
};

}  // namespace dustbench::view
