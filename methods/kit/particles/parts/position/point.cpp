// Births at a point.
#include "methods/kit/particles/part_kinds.h"

namespace dustbench::particles::parts::position::point {
namespace {

class PointSource final : public PlacedSource {
 public:
    using PlacedSource::PlacedSource;

    void place(Newborns& newborns, const Step& step) const override;
};

void PointSource::place(Newborns& newborns, const Step&) const {
    for (std::size_t i = 0; i < newborns.chunk.count; ++i) newborns.setPosition(i, newborns.centre(i));
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "a point";
    info.source = "Thesis, 4.2.1";
    PlacedSource::declare(info.parameters);
    info.create = [](const ParameterValues& values) { return std::make_unique<PointSource>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::position::point
