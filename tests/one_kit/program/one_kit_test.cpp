// A program and a library that it loads, both linked to libdustbench_kit.so, share one kit.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/particles/part.h"
#include "tests/one_kit/foreign_method.h"

namespace dustbench::one_kit {
namespace {

const ForeignMethod& foreign() {
    static const ForeignMethod& method = []() -> const ForeignMethod& {
        void* library = dlopen(FOREIGN_METHOD, RTLD_NOW | RTLD_LOCAL);
        const void* found = library == nullptr ? nullptr : dlsym(library, "foreignMethod");
        if (found == nullptr) throw std::runtime_error(dlerror());
        return *static_cast<const ForeignMethod*>(found);
    }();
    return method;
}

std::unique_ptr<Method> makeForeign(const std::string& count) {
    const MethodInfo info = foreign().describe();
    ParameterValues values(info.parameters);
    values.set("count", count);
    return info.create(values);
}

/// A listener of the program, for the library to inspect.
class Both final : public StageListener, public Method {
 public:
    void begin(Stage) override {}
    void end(Stage) override {}
    void beginDetail(std::string_view) override {}
    void endDetail(std::string_view) override {}

    void prepare(const scene::Scene&, const RunSetup&, gpu::Device&) override {}
    void update(const Frame&) override {}
    void draw(const Frame&, gpu::Layer&) override {}
};

}  // namespace

TEST(OneKit, IsTheSameTableOnBothSides) {
    EXPECT_EQ(&foreign().partTable(), &particles::partTable());
}

TEST(OneKit, HasOneTypeOfAMethod) {
    EXPECT_EQ(&foreign().typeOfMethods(), &typeid(Method));
}

TEST(OneKit, BooksForeignArraysOnTheProgramsLedger) {
    MemoryLedger ledger;
    {
        const auto array = foreign().book(ledger, 1'000'000);
        EXPECT_EQ(ledger.account("numbers").bytes(), 4'000'000u);
    }
    EXPECT_EQ(ledger.totalBytes(), 0u);
}

TEST(OneKit, CatchesErrorsAcrossTheBorder) {
    EXPECT_THROW(makeForeign("0"), InputError);
    EXPECT_THROW(static_cast<void>(makeForeign("1")->primitives()), SimulationError);
    EXPECT_TRUE(foreign().catchesUnknownPart());
}

TEST(OneKit, CastsMethodsAcrossTheBorder) {
    const auto method = makeForeign("1");
    auto* const listener = dynamic_cast<StageListener*>(method.get());
    ASSERT_NE(listener, nullptr);
    EXPECT_EQ(foreign().methodBehind(*listener), method.get());
    const Both own;
    EXPECT_EQ(foreign().methodBehind(own), &own);
}

}  // namespace dustbench::one_kit
