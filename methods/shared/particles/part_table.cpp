#include "methods/shared/particles/part_table.h"

#include <algorithm>

#include "methods/shared/errors.h"
#include "methods/shared/particles/parts/bezier_colour.h"
#include "methods/shared/particles/parts/cone_velocity.h"
#include "methods/shared/particles/parts/constant_colour.h"
#include "methods/shared/particles/parts/constant_size.h"
#include "methods/shared/particles/parts/disc_source.h"
#include "methods/shared/particles/parts/drag.h"
#include "methods/shared/particles/parts/gravity.h"
#include "methods/shared/particles/parts/ground.h"
#include "methods/shared/particles/parts/lifetime.h"
#include "methods/shared/particles/parts/linear_colour.h"
#include "methods/shared/particles/parts/linear_size.h"
#include "methods/shared/particles/parts/point_source.h"
#include "methods/shared/particles/parts/puff.h"
#include "methods/shared/particles/parts/random_size.h"
#include "methods/shared/particles/parts/stream.h"
#include "methods/shared/particles/parts/wind.h"

namespace dustbench::particles {
namespace {

/// The entry of a part's class, which says what it is by `describe` and is made from values.
template <typename Class>
PartInfo entry() {
    PartInfo info = Class::describe();
    info.create = [](const ParameterValues& values) { return std::make_unique<Class>(values); };
    return info;
}

}  // namespace

const std::vector<PartInfo>& partTable() {
    static const std::vector<PartInfo> table{
        entry<Stream>(),                                                                         // emission
        entry<PointSource>(),    entry<DiscSource>(),                                            // position
        entry<ConeVelocity>(),                                                                   // velocity
        entry<ConstantColour>(), entry<LinearColour>(), entry<BezierColour>(),                   // colour
        entry<ConstantSize>(),   entry<RandomSize>(),   entry<LinearSize>(),                     // size
        entry<Puff>(),                                                                           // render
        entry<Lifetime>(),                                                                       // life
        entry<Gravity>(),        entry<Drag>(),         entry<Wind>(),         entry<Ground>(),  // force
    };
    return table;
}

const PartInfo& findPart(PartKind kind, std::string_view name) {
    std::vector<std::string> known;
    for (const PartInfo& info : partTable()) {
        if (info.kind != kind) continue;
        if (info.name == name) return info;
        known.push_back(info.name);
    }
    throw unknownName(std::string(kindName(kind)) + " part", name, known);
}

std::unique_ptr<Part> makePart(PartKind kind, std::string_view name, const NamedValues& values) {
    const PartInfo& info = findPart(kind, name);
    ParameterValues resolved(info.parameters);
    for (const auto& [key, text] : values) resolved.set(key, text);
    return info.create(resolved);
}

}  // namespace dustbench::particles
