#include "tests/one_kit/foreign_method.h"

#include "methods/contract/errors.h"
#include "methods/kit/particles/part.h"

namespace dustbench::one_kit {
namespace {

class Nothing final : public Method, public StageListener {
 public:
    void prepare(const scene::Scene&, const RunSetup&, gpu::Device&) override {}
    void update(const Frame&) override {}
    void draw(const Frame&, gpu::Layer&) override {}
    [[nodiscard]] std::int64_t primitives() const override { throw SimulationError("foreign: nothing was drawn"); }

    void begin(Stage) override {}
    void end(Stage) override {}
    void beginDetail(std::string_view) override {}
    void endDetail(std::string_view) override {}
};

MethodInfo describe() {
    MethodInfo info;
    info.title = "Foreign";
    info.parameters.integer("count", 1, 0, 9, "", "how many");
    info.create = [](const ParameterValues& values) -> std::unique_ptr<Method> {
        if (values.integer("count") == 0) throw InputError("count: got 0, allowed: 1..9");
        return std::make_unique<Nothing>();
    };
    return info;
}

const Method* methodBehind(const StageListener& listener) {
    return dynamic_cast<const Method*>(&listener);
}

std::shared_ptr<void> book(MemoryLedger& ledger, std::size_t count) {
    const auto numbers = std::make_shared<LedgerVector<float>>(ledger.account("numbers"));
    numbers->resize(count);
    return numbers;
}

const std::type_info& typeOfMethods() {
    return typeid(Method);
}

bool catchesUnknownPart() {
    try {
        static_cast<void>(particles::findPart(particles::PartKind::size, "immense"));
        return false;
    } catch (const InputError&) {
        return true;
    }
}

}  // namespace
}  // namespace dustbench::one_kit

extern "C" DUSTBENCH_API const dustbench::one_kit::ForeignMethod foreignMethod;
const dustbench::one_kit::ForeignMethod foreignMethod{
    dustbench::one_kit::describe,    dustbench::one_kit::methodBehind,  dustbench::one_kit::book,
    dustbench::particles::partTable, dustbench::one_kit::typeOfMethods, dustbench::one_kit::catchesUnknownPart};
