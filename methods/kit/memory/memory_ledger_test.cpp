#include "methods/kit/memory/memory_ledger.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace dustbench {
namespace {

TEST(MemoryLedger, BooksExactBytesOfSmallAndLargeArrays) {
    MemoryLedger ledger;
    {
        LedgerVector<float> few(ledger.account("few")), many(ledger.account("many"));
        few.resize(1000);
        many.resize(largePage);
        EXPECT_EQ(ledger.account("few").bytes(), 4000u);
        EXPECT_EQ(ledger.account("many").bytes(), 4 * largePage);
        EXPECT_EQ(ledger.totalBytes(), 4000 + 4 * largePage);
        many.resize(2 * largePage);  // relocates
        EXPECT_EQ(ledger.account("many").bytes(), 4 * many.capacity());
    }
    EXPECT_EQ(ledger.totalBytes(), 0u);
}

TEST(MemoryLedger, AlignsToCacheLinesAndLetsLargeArraysBeginApart) {
    MemoryLedger ledger;
    std::vector<std::unique_ptr<LedgerVector<float>>> columns;
    std::vector<std::uintptr_t> lines;
    for (std::size_t i = 0; i < 16; ++i) {
        columns.push_back(std::make_unique<LedgerVector<float>>(ledger.account("columns")));
        columns.back()->resize(largePage / sizeof(float) + i);
        columns.back()->back() = 1;
        const auto place = reinterpret_cast<std::uintptr_t>(columns.back()->data());
        EXPECT_EQ(place % 64, 0u);
        EXPECT_LT(place % largePage, largePage / 8);
        for (const std::uintptr_t other : lines) EXPECT_NE(place / 64 % 64, other);
        lines.push_back(place / 64 % 64);
    }
}

}  // namespace
}  // namespace dustbench
