// The interface between the test program and a library with an external method that it loads.
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
    /// Registers an array of this many numbers in the ledger, for the lifetime of the result.
    std::shared_ptr<void> (*book)(MemoryLedger& ledger, std::size_t count);
    const std::vector<particles::PartInfo>& (*partTable)();
    const std::type_info& (*typeOfMethods)();
    /// True if the kit's InputError for an unknown part is caught as InputError.
    bool (*catchesUnknownPart)();
};

}  // namespace dustbench::one_kit
