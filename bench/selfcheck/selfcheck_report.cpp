#include "bench/selfcheck/selfcheck_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dustbench::bench {

std::string selfcheckJson(const Provenance& provenance, const std::vector<Check>& checks) {
    using Json = nlohmann::ordered_json;
    Json list = Json::array();
    for (const Check& check : checks)
        list.push_back({{"name", check.name},
                        {"outcome", outcomes.wordOf(check.outcome)},
                        {"measured", check.measured},
                        {"expected", check.expected},
                        {"note", check.note}});
    const Json object{
        {"passed", std::ranges::none_of(checks, [](const Check& check) { return check.outcome == Outcome::failed; })},
        {"device",
         {{"renderer", provenance.device.renderer},
          {"version", provenance.device.version},
          {"adapter", provenance.device.adapter}}},
        {"machine",
         {{"cpu", provenance.machine.cpu},
          {"cores", provenance.machine.cores},
          {"ram_bytes", provenance.machine.ramBytes},
          {"kernel", provenance.machine.kernel}}},
        {"program",
         {{"version", provenance.build.version},
          {"commit", provenance.build.gitCommit},
          {"compiler", provenance.build.compiler}}},
        {"started_utc", provenance.startedUtc},
        {"checks", list}};
    return object.dump(2) + "\n";
}

}  // namespace dustbench::bench
