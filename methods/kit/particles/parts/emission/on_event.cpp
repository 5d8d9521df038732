// No births of its own: particles are born only where events of a system start them.
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::emission::on_event {
namespace {

class OnEvent final : public EmissionPart {
 public:
    using EmissionPart::EmissionPart;
    [[nodiscard]] Births births(const Step&) override { return {}; }
};

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "only where events start particles (parts of kind event)";
    info.source = "Thesis, 7.3";
    info.create = [](const ParameterValues& values) { return std::make_unique<OnEvent>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::emission::on_event
