#include "methods/contract/facts.h"

#include <algorithm>
#include <stdexcept>

namespace dustbench {

Facts::Facts(const std::vector<FactInfo>& declared, FactOver over) : over_(over) {
    for (const FactInfo& info : declared) entries_.push_back({&info, std::nullopt});
}

std::size_t Facts::indexOf(std::string_view name) const {
    const auto found = std::ranges::find(entries_, name, [](const Entry& entry) { return entry.info->name; });
    if (found == entries_.end()) throw std::logic_error("the method declares no fact '" + std::string(name) + "'");
    return static_cast<std::size_t>(found - entries_.begin());
}

bool Facts::wants(std::string_view name) const {
    return entries_[indexOf(name)].info->over == over_;
}

void Facts::set(std::string_view name, FactValue value) {
    Entry& entry = entries_[indexOf(name)];
    if (entry.info->over == over_) entry.value = value;
}

void Facts::clear() {
    for (Entry& entry : entries_) entry.value.reset();
}

std::optional<FactValue> Facts::value(std::string_view name) const {
    return entries_[indexOf(name)].value;
}

}  // namespace dustbench
