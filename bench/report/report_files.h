// The files that a page is made of: our own template, style, scripts and chart specifications, and Debian's Vega.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dustbench::bench {

/// The content of `reports/report/<name>`. Throws InputError.
[[nodiscard]] std::string reportFile(std::string_view name);

/// The content of reports/SCHEMA.md.
[[nodiscard]] std::string schemaText();

/// Under which Vega may be handed on with a page, as the package says it.
[[nodiscard]] std::string vegaLicence();

/// `{"cost": {…}, …}`: every specification of `reports/report/charts`, by its name without extension.
[[nodiscard]] std::string chartSpecifications();

/// What turns the data into specifications, for browsers and for node.
[[nodiscard]] std::string chartScript();

/// What builds the page; behind chartScript().
[[nodiscard]] std::string pageScript();

/// Vega as one script, which leaves it behind as `vega`; for browsers and for node. Throws InputError where the package
/// libjs-vega is not installed.
[[nodiscard]] std::string vegaScript();

}  // namespace dustbench::bench
