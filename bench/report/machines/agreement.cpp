#include "bench/report/machines/agreement.h"

#include <algorithm>
#include <set>

#include "methods/contract/choices.h"

namespace dustbench::bench {
namespace {

constexpr Choices<Agreement> agreementTexts{{"agree", Agreement::agree},
                                            {"agree, by different factors", Agreement::factor},
                                            {"differ", Agreement::differ},
                                            {"open", Agreement::open},
                                            {"one machine only", Agreement::alone}};

}  // namespace

std::string_view agreementText(Agreement agreement) {
    return agreementTexts.wordOf(agreement);
}

Agreement agreementOf(const std::vector<SideRatio>& sides) {
    std::vector<const PairedRatio*> measured;
    std::set<Verdict> resolved;
    for (const SideRatio& side : sides) {
        if (side.result.pairs == 0) continue;
        measured.push_back(&side.result);
        if (side.result.verdict != Verdict::unresolved) resolved.insert(side.result.verdict);
    }
    if (measured.size() < 2) return Agreement::alone;
    if (resolved.size() > 1) return Agreement::differ;
    if (std::ranges::any_of(measured, [](const PairedRatio* one) { return one->verdict == Verdict::unresolved; }))
        return Agreement::open;
    for (const PairedRatio* a : measured)
        for (const PairedRatio* b : measured)
            if (a->low > b->high) return Agreement::factor;
    return Agreement::agree;
}

Agreement agreementOf(const std::vector<ClaimVerdict>& verdicts) {
    std::set<ClaimVerdict> decided;
    std::size_t tested = 0, open = 0;
    for (const ClaimVerdict verdict : verdicts) {
        if (verdict == ClaimVerdict::notTested) continue;
        ++tested;
        if (verdict == ClaimVerdict::unresolved || verdict == ClaimVerdict::untestable)
            ++open;
        else
            decided.insert(verdict);
    }
    if (tested < 2) return Agreement::alone;
    if (decided.size() > 1) return Agreement::differ;
    return open > 0 ? Agreement::open : Agreement::agree;
}

const EvaluatedClaim& SharedClaim::any() const {
    return **std::ranges::find_if(folders, [](const EvaluatedClaim* claim) { return claim != nullptr; });
}

std::vector<SharedClaim> sharedClaims(const MachineSet& set) {
    std::vector<SharedClaim> claims;
    for (std::size_t folder = 0; folder < set.folders.size(); ++folder)
        for (const EvaluatedClaim& evaluated : set.folders[folder].claims) {
            auto found = std::ranges::find_if(claims, [&](const SharedClaim& known) {
                return known.any().paper == evaluated.paper && known.any().claim.id == evaluated.claim.id;
            });
            if (found == claims.end()) {
                claims.push_back({std::vector<const EvaluatedClaim*>(set.folders.size(), nullptr), {}});
                found = std::prev(claims.end());
            }
            found->folders[folder] = &evaluated;
        }
    for (SharedClaim& claim : claims) {
        std::vector<ClaimVerdict> verdicts;
        for (const EvaluatedClaim* evaluated : claim.folders)
            if (evaluated) verdicts.push_back(evaluated->result.verdict);
        claim.agreement = agreementOf(verdicts);
    }
    std::ranges::stable_sort(claims, {}, [](const SharedClaim& claim) { return claim.any().paper; });
    return claims;
}

}  // namespace dustbench::bench
