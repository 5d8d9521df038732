#include "bench/report/selfcheck_findings.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::bench {

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

}  // namespace dustbench::bench
