#include "bench/results/method_facts.h"

#include <map>
#include <stdexcept>

#include "methods/contract/registry.h"

namespace dustbench::bench {

const std::vector<MethodFact>& methodFacts() {
    static const std::vector<MethodFact> all = [] {
        std::map<std::string, MethodFact> byName;
        for (const MethodInfo& method : methods())
            for (const FactInfo& info : method.facts) {
                MethodFact& fact = byName.try_emplace(info.name, MethodFact{info, {}}).first->second;
                if (fact.info != info)
                    throw std::logic_error("methods " + fact.methods.front() + " and " + method.id +
                                           " declare the fact '" + info.name + "' with different definitions");
                fact.methods.push_back(method.id);
            }
        std::vector<MethodFact> list;
        list.reserve(byName.size());
        for (auto& [name, fact] : byName) list.push_back(std::move(fact));
        return list;
    }();
    return all;
}

}  // namespace dustbench::bench
