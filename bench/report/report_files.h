// The files that make up a page: our template, style, scripts and chart specifications, and Debian's Vega.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::report {

/// The content of `reports/page/<name>`. Throws InputError.
[[nodiscard]] std::string reportFile(std::string_view name);

/// The name, unit and direction of each quantity that charts show, as JSON: `reports/page/columns.json` and the image
/// metrics. Throws InputError.
[[nodiscard]] std::string reportColumns();

/// The content of a file. Throws InputError.
[[nodiscard]] std::string fileText(const std::filesystem::path& file);

/// The content of `reports/<name>`: `SCHEMA.md`, `METRICS.md`. Throws InputError.
[[nodiscard]] std::string documentText(std::string_view name);

/// The licence under which Vega may be redistributed with a page, from the package.
[[nodiscard]] std::string vegaLicence();

/// `{"cost": {…}, …}`: every specification of these folders of `reports/page`, by its name without extension.
[[nodiscard]] std::string chartSpecifications(const std::vector<std::string>& folders = {"charts"});

/// Converts the data to chart specifications; for browsers and for node.
[[nodiscard]] std::string chartScript();

/// Builds the page; runs after chartScript().
[[nodiscard]] std::string pageScript();

/// Draws the charts and builds the page of several machines.
[[nodiscard]] std::string machinesScript();

/// Vega as one script, which defines `vega`; for browsers and for node. Throws InputError if the package libjs-vega is
/// not installed.
[[nodiscard]] std::string vegaScript();

}  // namespace dustbench::report
