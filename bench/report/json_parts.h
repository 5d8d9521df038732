// Pieces of JSON that the pages share. Include it only in sources that write JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/claims/claim_ledger.h"

namespace dustbench::report {

/// Rounded to six digits, which is more than any chart shows and keeps a page small; null if not finite.
[[nodiscard]] nlohmann::json number(double value);

/// A claim with its rule and its result, without its runs.
[[nodiscard]] nlohmann::json claimJson(const claims::EvaluatedClaim& evaluated);

/// As text inside a script element: contains no `<`. Invalid UTF-8 is replaced.
[[nodiscard]] std::string scriptSafe(const nlohmann::json& root);

template <typename List, typename ToJson>
nlohmann::json each(const List& list, const ToJson& toJson) {
    nlohmann::json result = nlohmann::json::array();
    for (const auto& item : list) result.push_back(toJson(item));
    return result;
}

}  // namespace dustbench::report
