#include "methods/kit/particles/part_list.h"

#include <algorithm>
#include <stdexcept>

namespace dustbench::particles {
namespace {

template <typename Kind>
std::unique_ptr<Kind> as(std::unique_ptr<Part> part) {
    return std::unique_ptr<Kind>(&dynamic_cast<Kind&>(*part.release()));
}

bool givesLifetimes(const std::unique_ptr<LifePart>& part) {
    return part->meanLifetimeSeconds().has_value();
}

}  // namespace

void PartList::set(std::unique_ptr<Part> part) {
    switch (part->kind()) {
        case PartKind::emission:
            emission_ = as<EmissionPart>(std::move(part));
            return;
        case PartKind::position:
            position_ = as<PositionPart>(std::move(part));
            return;
        case PartKind::velocity:
            velocity_ = as<VelocityPart>(std::move(part));
            return;
        case PartKind::colour:
            colour_ = as<ColourPart>(std::move(part));
            return;
        case PartKind::size:
            size_ = as<SizePart>(std::move(part));
            return;
        case PartKind::render:
            render_ = as<RenderPart>(std::move(part));
            return;
        case PartKind::life:
            lives_.push_back(as<LifePart>(std::move(part)));
            return;
        case PartKind::shading:
            shadings_.push_back(as<ShadingPart>(std::move(part)));
            return;
        case PartKind::force:
            forces_.push_back(as<ForcePart>(std::move(part)));
            return;
    }
}

const LifePart& PartList::lifetime() const {
    const auto found = std::ranges::find_if(lives_, givesLifetimes);
    if (found == lives_.end()) throw std::logic_error("no part gives lifetimes");
    return **found;
}

std::vector<const Part*> PartList::all() const {
    std::vector<const Part*> parts;
    for (const Part* part : std::initializer_list<const Part*>{emission_.get(), position_.get(), velocity_.get(),
                                                               colour_.get(), size_.get(), render_.get()})
        if (part) parts.push_back(part);
    for (const auto& part : lives_) parts.push_back(part.get());
    for (const auto& part : shadings_) parts.push_back(part.get());
    for (const auto& part : forces_) parts.push_back(part.get());
    return parts;
}

std::string PartList::missing() const {
    const auto none = [](PartKind kind) { return "no part of kind '" + std::string(kindName(kind)) + "'"; };
    if (!emission_) return none(PartKind::emission);
    if (!position_) return none(PartKind::position);
    if (!velocity_) return none(PartKind::velocity);
    if (!colour_) return none(PartKind::colour);
    if (!size_) return none(PartKind::size);
    const auto lifetimes = std::ranges::count_if(lives_, givesLifetimes);
    if (lifetimes == 0) return "no part of kind 'life' that gives lifetimes ('lifetime')";
    if (lifetimes > 1) return "more than one part of kind 'life' that gives lifetimes";
    return {};
}

}  // namespace dustbench::particles
