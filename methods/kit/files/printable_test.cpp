#include "methods/kit/files/printable.h"

#include <gtest/gtest.h>

#include <random>

namespace dustbench::files {
namespace {

TEST(Printable, LeavesWordsAsTheyAre) {
    for (const char* text : {"", "run 'a': got 5", "größer, 日本語, 𝄞, −1 …"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalWouldObey) {
    EXPECT_EQ(printable("a\x1b[2Jb\x07"), "a\\x1b[2Jb\\x07");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("two\nlines\tand\rmore"), "two lines and more");
    EXPECT_EQ(printable("\x7f"), "\\x7f");
    EXPECT_EQ(printable("\xc2\x9b"
                        "31m"),
              "\\xc2\\x9b"
              "31m");  // CSI as one letter
    EXPECT_EQ(printable("\xe2\x80\xae"
                        "gnp"),
              "\\xe2\\x80\\xaegnp");  // writes from right to left
    EXPECT_EQ(printable("\xff\xc0\xaf\xed\xa0\x80\xf5"), "\\xff\\xc0\\xaf\\xed\\xa0\\x80\\xf5");
    EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");  // cut within a letter
}

TEST(Printable, NeverIsLongerThanAllowed) {
    const std::string exact(maximumMessageBytes, 'x');
    EXPECT_EQ(printable(exact), exact);
    EXPECT_EQ(printable(std::string(5'000'000, 'x')), std::string(maximumMessageBytes - 6, 'x') + " […]");
    std::mt19937 random(28);
    for (int n = 0; n < 5000; ++n) {
        std::string text;
        for (auto k = random() % 80; k > 0; --k) text += static_cast<char>(random() % 256);
        const std::size_t maximum = 10 + random() % 100;
        const std::string line = printable(text, maximum);
        EXPECT_LE(line.size(), maximum);
        EXPECT_EQ(printable(line, maximum), line);  // nothing left to escape, no letter cut
    }
}

}  // namespace
}  // namespace dustbench::files
