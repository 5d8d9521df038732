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

template <typename Kind>
void replace(std::unique_ptr<Kind>& place, std::unique_ptr<Part> part) {
    if (place) part->takeOver(*place);
    place = as<Kind>(std::move(part));
}

template <typename Kind>
void replaceOrRemove(PartList::List<Kind>& list, std::size_t index, std::unique_ptr<Part> part) {
    if (part)
        replace(list.at(index), std::move(part));
    else
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace

void PartList::set(std::unique_ptr<Part> part) {
    switch (part->kind()) {
        case PartKind::emission:
            replace(emission_, std::move(part));
            return;
        case PartKind::position:
            replace(position_, std::move(part));
            return;
        case PartKind::velocity:
            replace(velocity_, std::move(part));
            return;
        case PartKind::colour:
            replace(colour_, std::move(part));
            return;
        case PartKind::size:
            replace(size_, std::move(part));
            return;
        case PartKind::render:
            replace(render_, std::move(part));
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
        case PartKind::event:
            events_.push_back(as<EventPart>(std::move(part)));
            return;
    }
}

void PartList::setInList(PartKind kind, std::size_t index, std::unique_ptr<Part> part) {
    if (kind == PartKind::life) return replaceOrRemove(lives_, index, std::move(part));
    if (kind == PartKind::shading) return replaceOrRemove(shadings_, index, std::move(part));
    if (kind == PartKind::force) return replaceOrRemove(forces_, index, std::move(part));
    if (kind == PartKind::event) return replaceOrRemove(events_, index, std::move(part));
    throw std::logic_error("a part of kind '" + std::string(kindName(kind)) + "' is not in a list");
}

void PartList::takeOver(const PartList& before) {
    const std::vector<Part*> own = mutableParts();
    const std::vector<const Part*> old = before.all();
    for (std::size_t i = 0, k = 0; i < own.size(); ++i) {
        while (k < old.size() && old[k]->kind() < own[i]->kind()) ++k;
        if (k < old.size() && old[k]->kind() == own[i]->kind()) own[i]->takeOver(*old[k++]);
    }
}

const LifePart& PartList::lifetime() const {
    const auto found = std::ranges::find_if(lives_, givesLifetimes);
    if (found == lives_.end()) throw std::logic_error("no part sets lifetimes");
    return **found;
}

std::vector<Part*> PartList::mutableParts() const {
    std::vector<Part*> parts;
    for (Part* part : std::initializer_list<Part*>{emission_.get(), position_.get(), velocity_.get(), colour_.get(),
                                                   size_.get(), render_.get()})
        if (part) parts.push_back(part);
    for (const auto& part : lives_) parts.push_back(part.get());
    for (const auto& part : shadings_) parts.push_back(part.get());
    for (const auto& part : forces_) parts.push_back(part.get());
    for (const auto& part : events_) parts.push_back(part.get());
    return parts;
}

std::vector<const Part*> PartList::all() const {
    const std::vector<Part*> parts = mutableParts();
    return {parts.begin(), parts.end()};
}

std::string PartList::missing() const {
    const auto none = [](PartKind kind) { return "no part of kind '" + std::string(kindName(kind)) + "'"; };
    if (!emission_) return none(PartKind::emission);
    if (!position_) return none(PartKind::position);
    if (!velocity_) return none(PartKind::velocity);
    if (!colour_) return none(PartKind::colour);
    if (!size_) return none(PartKind::size);
    const auto lifetimes = std::ranges::count_if(lives_, givesLifetimes);
    if (lifetimes == 0) return "no part of kind 'life' that sets lifetimes ('lifetime')";
    if (lifetimes > 1) return "more than one part of kind 'life' that sets lifetimes";
    const auto settling = std::ranges::count_if(forces_, [](const auto& force) { return force->settles(); });
    if (settling > 1) return "more than one part of kind 'force' that sets positions, such as 'springs'";
    for (const Part* part : all())
        if (part->needsLattice() && !position_->lattice())
            return std::string(kindName(part->kind())) + " '" + part->name() + "': got the position '" +
                   position_->name() + "', allowed: 'lattice'";
    return {};
}

}  // namespace dustbench::particles
