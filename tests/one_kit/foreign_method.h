// What the test program asks of a library that it loads, which holds a method from outside.
#pragma once

#include <cstddef>
#include <memory>
#include <typeinfo>
#include <vector>

#include "methods/contract/method.h"
#include "methods/kit/memory/memory_ledger.h"
#include "methods/kit/particles/part.h"

namespace dustbench::one_kit {

struct ForeignMethod {
    MethodInfo (*describe)();
    /// A listener that is a method as well, or null.
    const Method* (*methodBehind)(const StageListener& listener);
    /// Books an array of so many numbers; it lives as long as the result.
    std::shared_ptr<void> (*book)(MemoryLedger& ledger, std::size_t count);
    const std::vector<particles::PartInfo>& (*partTable)();
    const std::type_info& (*typeOfMethods)();
    /// Whether the kit's InputError for an unknown part is caught as such.
    bool (*catchesUnknownPart)();
};

}  // namespace dustbench::one_kit
