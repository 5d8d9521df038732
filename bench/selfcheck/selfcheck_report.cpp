#include "bench/selfcheck/selfcheck_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::selfcheck {

std::string selfcheckJson(const measure::Provenance& provenance, const std::vector<Check>& checks) {
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

std::vector<std::string> selfcheckProblems(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "selfcheck.json";
    std::error_code none;
    if (!std::filesystem::exists(file, none)) return {};
    std::vector<std::string> problems;
    try {
        const auto found = nlohmann::json::parse(files::wholeText(file, "a self-check"));
        for (const auto& check : found.at("checks"))
            if (check.at("outcome") == "failed")
                problems.push_back(
                    fmt::format("the self-check failed, the results may be wrong: {}: got {}, expected {}",
                                check.at("name").get<std::string>(), check.at("measured").get<std::string>(),
                                check.at("expected").get<std::string>()));
    } catch (const nlohmann::json::exception&) {
        return {"selfcheck.json cannot be read: whether this machine draws correctly is not known"};
    } catch (const InputError& error) {
        return {error.what()};
    }
    return problems;
}

}  // namespace dustbench::selfcheck
