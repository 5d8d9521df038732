#include "methods/kit/memory/memory_ledger.h"

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>

#include "methods/kit/memory/available_memory.h"

namespace dustbench {
namespace {

/// Offsets in cache lines within a 4 KiB block, and in blocks: both select cache sets. Consecutive arrays get distant
/// offsets.
constexpr std::size_t line = 64, linesOfBlock = 64, blocks = 8;
std::size_t nextOffset() {
    static std::atomic<std::size_t> made{0};
    const std::size_t number = made.fetch_add(1, std::memory_order_relaxed);
    return line * (39 * number % linesOfBlock + linesOfBlock * (number % blocks));
}

}  // namespace

void* allocateLarge(const MemoryAccount& account, std::size_t bytes) {
    requireAvailable(account.structure(), bytes);
    const std::size_t offset = nextOffset();
    auto* const pages = static_cast<std::byte*>(::operator new (offset + bytes, std::align_val_t{largePage}));
    madvise(pages, offset + bytes, MADV_HUGEPAGE);  // only a hint
    return pages + offset;
}

void freeLarge(void* memory) {
    // Offsets are smaller than a page.
    auto* const bytes = static_cast<std::byte*>(memory);
    ::operator delete (bytes - reinterpret_cast<std::uintptr_t>(memory) % largePage, std::align_val_t{largePage});
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
