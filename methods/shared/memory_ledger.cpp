#include "methods/shared/memory_ledger.h"

#include <sys/mman.h>

#include "methods/shared/available_memory.h"

namespace dustbench {

void* allocateLarge(const MemoryAccount& account, std::size_t bytes, std::align_val_t alignment) {
    requireAvailable(account.structure(), bytes);
    void* memory = ::operator new(bytes, alignment);
    madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: where it is not granted, all works as well
    return memory;
}

MemoryAccount& MemoryLedger::account(std::string_view structure) {
    const std::lock_guard lock(mutex_);
    for (MemoryAccount& account : accounts_)
        if (account.structure() == structure) return account;
    return accounts_.emplace_back(std::string(structure));
}

std::vector<std::pair<std::string, std::size_t>> MemoryLedger::entries() const {
    const std::lock_guard lock(mutex_);
    std::vector<std::pair<std::string, std::size_t>> list;
    for (const MemoryAccount& account : accounts_) list.emplace_back(account.structure(), account.bytes());
    return list;
}

std::size_t MemoryLedger::totalBytes() const {
    const std::lock_guard lock(mutex_);
    std::size_t total = 0;
    for (const MemoryAccount& account : accounts_) total += account.bytes();
    return total;
}

}  // namespace dustbench
