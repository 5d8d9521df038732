// The report's data as JSON, for the page and for single charts.
#pragma once

#include <string>

#include "bench/report/report_data.h"

namespace dustbench::report {

/// Safe inside a script element: contains no `<`. Invalid UTF-8 is replaced. The fields are documented at the top of
/// reports/page/page.js.
[[nodiscard]] std::string reportJson(const ReportData& data);

}  // namespace dustbench::report
