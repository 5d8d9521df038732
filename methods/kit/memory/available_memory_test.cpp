#include "methods/kit/memory/available_memory.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "methods/contract/errors.h"
#include "methods/kit/memory/memory_ledger.h"

namespace dustbench {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(AvailableMemory, IsNoMoreThanTheProcesssOwnLimitLeaves) {
    const std::int64_t machine = availableBytes();
    EXPECT_GT(machine, 1 << 20);
    rlimit before{};
    getrlimit(RLIMIT_AS, &before);
    const rlimit tight{rlim_t{1} << 20, before.rlim_max};  // less than the process already uses
    setrlimit(RLIMIT_AS, &tight);
    const std::int64_t left = availableBytes();
    setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(left, 0);
}

TEST(AvailableMemory, StructuresThatAreLargerAreRefusedWithTheirNameAndBytes) {
    MemoryLedger ledger;
    LedgerVector<char> vast(ledger.account("octree bricks"));
    const std::size_t bytes = std::size_t{1} << 46;
    try {
        vast.resize(bytes);
        FAIL() << "64 TiB were granted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("octree bricks"), HasSubstr(std::to_string(bytes))));
    }
    EXPECT_EQ(ledger.totalBytes(), 0u);
    vast.resize(10 << 20);
    EXPECT_EQ(ledger.totalBytes(), 10u << 20);
}

}  // namespace
}  // namespace dustbench
