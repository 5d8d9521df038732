#include "bench/view/window_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <random>

#include "methods/contract/errors.h"
#include "methods/kit/testing/test_folder.h"

namespace dustbench::view {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Gives an environment variable another value for a test.
class Variable {
 public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        set(value);
    }
    ~Variable() { set(before_ ? before_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

 private:
    void set(const char* value) { value ? setenv(name_, value, 1) : unsetenv(name_); }
    const char* name_;
    std::optional<std::string> before_;
};

class Settings : public testing::Test {
 protected:
    [[nodiscard]] std::filesystem::path file() const { return folder_.path() / "config" / "dustbench" / "view.toml"; }
    void write(const std::string& text) const {
        std::filesystem::create_directories(file().parent_path());
        std::ofstream(file(), std::ios::binary) << text;
    }
    [[nodiscard]] std::string content() const {
        std::ifstream stream(file(), std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    TestFolder folder_;
};

TEST_F(Settings, LieInTheUsersConfigurationFolder) {
    const Variable home("HOME", "/home/somebody");
    {
        const Variable config("XDG_CONFIG_HOME", "/settings");
        EXPECT_EQ(windowSettingsFile(), "/settings/dustbench/view.toml");
    }
    for (const char* none : {"", "relative/folder"}) {
        const Variable config("XDG_CONFIG_HOME", none);
        EXPECT_EQ(windowSettingsFile(), "/home/somebody/.config/dustbench/view.toml");
    }
    const Variable config("XDG_CONFIG_HOME", nullptr), homeless("HOME", nullptr);
    EXPECT_EQ(windowSettingsFile(), "");
}

TEST_F(Settings, AreReadBackAsTheyWereKept) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> upTo(0, 1);
    for (int trial = 0; trial < 20; ++trial) {
        WindowSettings settings;
        settings.textScale = minimumTextScale + upTo(random) * (maximumTextScale - minimumTextScale);
        settings.size = {320 + trial, 200 + static_cast<int>(random() % 2000)};
        settings.shown = shownChoices.all()[random() % shownChoices.all().size()].value;
        settings.divider = static_cast<float>(upTo(random));
        settings.showsPanels = random() % 2 == 0;
        settings.keepsPace = random() % 2 == 0;
        SettingsKeeper keeper(file());
        EXPECT_EQ(keeper.problem(), "");
        keeper.keep(settings);
        keeper.finish();
        EXPECT_EQ(SettingsKeeper(file()).read(), settings);
    }
}

TEST_F(Settings, AreWrittenWhenTheyHaveSettledOrAtTheEnd) {
    SettingsKeeper keeper(file());
    WindowSettings now;
    keeper.keep(now);
    keeper.finish();
    EXPECT_FALSE(std::filesystem::exists(file()));  // nothing has changed
    for (int n = 0; n < 500; ++n) {                 // a drag
        now.divider = static_cast<float>(n) / 1000;
        keeper.keep(now);
    }
    EXPECT_FALSE(std::filesystem::exists(file()));
    for (int n = 0; n < SettingsKeeper::callsToSettle; ++n) keeper.keep(now);
    EXPECT_EQ(SettingsKeeper(file()).read(), now);
    std::filesystem::remove(file());
    for (int n = 0; n < 1000; ++n) keeper.keep(now);
    EXPECT_FALSE(std::filesystem::exists(file()));  // not again
    now.showsPanels = false;
    keeper.keep(now);
    keeper.finish();
    EXPECT_EQ(SettingsKeeper(file()).read(), now);
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(file().parent_path())) files.push_back(entry.path());
    EXPECT_EQ(files, std::vector{file()});  // no incomplete file next to it
}

TEST_F(Settings, ABrokenFileIsOneLineAndStays) {
    for (const char* text : {"text_scale = ", "text_scale = 99", "divider = \"half\"", "size = \"big\"",
                             "shown = \"wip\"", "panels = 1", "keep_pace = \"no\"", "size = \"0x5\"", "\xff\xfe"}) {
        write(text);
        SettingsKeeper keeper(file());
        EXPECT_EQ(keeper.read(), WindowSettings()) << text;
        EXPECT_THAT(keeper.problem(), StartsWith(file().string() + ":1: ")) << text;
        EXPECT_THAT(keeper.problem(), HasSubstr("the window uses its defaults"));
        EXPECT_EQ(keeper.problem().find('\n'), std::string::npos);
        WindowSettings changed;
        changed.divider = 0.25f;
        keeper.keep(changed);
        keeper.finish();
        EXPECT_EQ(content(), text);
    }
    std::filesystem::remove_all(file());
    std::filesystem::create_directories(file());
    EXPECT_THAT(SettingsKeeper(file()).problem(), HasSubstr("is a folder"));
}

TEST_F(Settings, AnUnknownKeyIsAWarning) {
    write("divider = 0.25\ntext_scales = 2\n");
    const SettingsKeeper keeper(file());
    EXPECT_EQ(keeper.read().divider, 0.25f);
    EXPECT_EQ(keeper.read().textScale, 1);
    EXPECT_THAT(keeper.problem(), StartsWith(file().string() + ":2: unknown key 'text_scales'"));
    EXPECT_THAT(keeper.problem(), HasSubstr("did you mean 'text_scale'?"));
    EXPECT_THAT(keeper.problem(), HasSubstr("it is ignored"));
}

TEST_F(Settings, AFolderThatCannotBeMadeIsOneErrorForEachChange) {
    folder_.write("config", "a file");
    SettingsKeeper keeper(file());
    WindowSettings now;
    now.divider = 0.1f;
    keeper.keep(now);
    EXPECT_THROW(keeper.finish(), InputError);
    EXPECT_NO_THROW(keeper.finish());
    now.divider = 0.2f;
    keeper.keep(now);
    EXPECT_THROW(keeper.finish(), InputError);
    SettingsKeeper nowhere{""};
    nowhere.keep(now);
    EXPECT_NO_THROW(nowhere.finish());
}

}  // namespace
}  // namespace dustbench::view
