// Exact bytes by structure: allocators and GPU objects book them on accounts.
#pragma once

#include <atomic>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/memory_report.h"

namespace dustbench {

/// The bytes held under one name. Threads: any thread may book.
class DUSTBENCH_API MemoryAccount {
 public:
    explicit MemoryAccount(std::string structure) : structure_(std::move(structure)) {}

    void book(std::size_t bytes) { bytes_.fetch_add(bytes, std::memory_order_relaxed); }
    void release(std::size_t bytes) { bytes_.fetch_sub(bytes, std::memory_order_relaxed); }
    [[nodiscard]] std::size_t bytes() const { return bytes_.load(std::memory_order_relaxed); }
    [[nodiscard]] const std::string& structure() const { return structure_; }

 private:
    std::string structure_;
    std::atomic<std::size_t> bytes_{0};
};

/// A set of accounts, created on first use. Owns the accounts; must outlive everything booked on them.
class DUSTBENCH_API MemoryLedger {
 public:
    [[nodiscard]] MemoryAccount& account(std::string_view structure);
    /// Bytes by structure, in the order of first use.
    [[nodiscard]] std::vector<std::pair<std::string, std::size_t>> entries() const;
    [[nodiscard]] std::size_t totalBytes() const;

 private:
    mutable std::mutex mutex_;
    std::list<MemoryAccount> accounts_;
};

/// Arrays of at least this many bytes are large.
inline constexpr std::size_t largePage = std::size_t{2} << 20;

/// Allocates a large array in huge pages if the system grants them, which saves address translations. Arrays start at
/// different offsets in their first page; otherwise the columns of a store would compete for the same cache lines.
/// Throws InputError if the machine has too little memory left.
[[nodiscard]] DUSTBENCH_API void* allocateLarge(const MemoryAccount& account, std::size_t bytes);
DUSTBENCH_API void freeLarge(void* memory);

/// Standard allocator that books on an account. Throws InputError if the machine has too little memory. Memory is
/// aligned to a cache line (64 bytes) for the vector units.
template <typename T>
class LedgerAllocator {
 public:
    using value_type = T;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;

    explicit LedgerAllocator(MemoryAccount& account) : account_(&account) {}
    template <typename U>
    LedgerAllocator(const LedgerAllocator<U>& other) : account_(other.account()) {}  // NOLINT: standard conversion

    [[nodiscard]] T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        void* memory = bytes >= largePage ? allocateLarge(*account_, bytes) : ::operator new(bytes, cacheLine);
        account_->book(bytes);
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        account_->release(bytes);
        if (bytes >= largePage)
            freeLarge(memory);
        else
            ::operator delete(memory, cacheLine);
    }
    [[nodiscard]] MemoryAccount* account() const { return account_; }

    template <typename U>
    bool operator==(const LedgerAllocator<U>& other) const {
        return account_ == other.account();
    }

 private:
    static constexpr std::align_val_t cacheLine{64};

    MemoryAccount* account_;
};

/// A vector whose bytes are booked on a ledger: `LedgerVector<float> x{ledger.account("positions")};`
template <typename T>
class LedgerVector : public std::vector<T, LedgerAllocator<T>> {
 public:
    explicit LedgerVector(MemoryAccount& account) : std::vector<T, LedgerAllocator<T>>(LedgerAllocator<T>(account)) {}
};

}  // namespace dustbench
