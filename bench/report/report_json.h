// The report's data as JSON, for the page and for charts by themselves.
#pragma once

#include <string>

#include "bench/report/report_data.h"

namespace dustbench::bench {

/// Safe within a script element: no `<` in it. Texts that are no UTF-8 are mended. The fields are listed at the top of
/// reports/report/page.js.
[[nodiscard]] std::string reportJson(const ReportData& data);

}  // namespace dustbench::bench
