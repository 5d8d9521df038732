// The parts of one system, six single parts and four lists, and how it stores its particles. All may be replaced
// between updates, also by name.
//
// Owns: the parts. Source: Thesis, 3.1.1 and 3.1.3 (every parameter and every part can be changed at any time).
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "methods/kit/particles/events.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/particle_store.h"
#include "methods/kit/particles/render_part.h"
#include "methods/kit/particles/shading_part.h"

namespace dustbench::particles {

class DUSTBENCH_API PartList {
 public:
    template <typename Kind>
    using List = std::vector<std::unique_ptr<Kind>>;

    /// Adds a part by its kind: replaces the single part, or appends to the list.
    void set(std::unique_ptr<Part> part);
    /// Replaces part `index` of its list by one that continues from it (Part::takeOver); null removes it.
    void setInList(PartKind kind, std::size_t index, std::unique_ptr<Part> part);
    /// Continues from the parts of a running system that this list replaces (Part::takeOver).
    void takeOver(const PartList& before);

    /// Null while the system is being assembled.
    [[nodiscard]] EmissionPart* emission() const { return emission_.get(); }
    [[nodiscard]] PositionPart* position() const { return position_.get(); }
    [[nodiscard]] VelocityPart* velocity() const { return velocity_.get(); }
    [[nodiscard]] ColourPart* colour() const { return colour_.get(); }
    [[nodiscard]] SizePart* size() const { return size_.get(); }
    /// Null if the file does not specify it.
    [[nodiscard]] RenderPart* render() const { return render_.get(); }
    [[nodiscard]] List<LifePart>& lives() { return lives_; }
    [[nodiscard]] List<ShadingPart>& shadings() { return shadings_; }
    [[nodiscard]] List<ForcePart>& forces() { return forces_; }
    [[nodiscard]] List<EventPart>& events() { return events_; }
    [[nodiscard]] const List<LifePart>& lives() const { return lives_; }
    [[nodiscard]] const List<ShadingPart>& shadings() const { return shadings_; }
    [[nodiscard]] const List<ForcePart>& forces() const { return forces_; }
    [[nodiscard]] const List<EventPart>& events() const { return events_; }

    [[nodiscard]] Storage storage() const { return storage_; }
    void setStorage(Storage storage) { storage_ = storage; }

    /// The part that sets lifetimes.
    [[nodiscard]] const LifePart& lifetime() const;
    /// Every part, by kind in the order of PartKind.
    [[nodiscard]] DUSTBENCH_API std::vector<const Part*> all() const;
    /// Why the list is not a complete system (`no part of kind 'size'`); empty if it is.
    [[nodiscard]] std::string missing() const;

 private:
    [[nodiscard]] std::vector<Part*> mutableParts() const;

    std::unique_ptr<EmissionPart> emission_;
    std::unique_ptr<PositionPart> position_;
    std::unique_ptr<VelocityPart> velocity_;
    std::unique_ptr<ColourPart> colour_;
    std::unique_ptr<SizePart> size_;
    std::unique_ptr<RenderPart> render_;
    List<LifePart> lives_;
    List<ShadingPart> shadings_;
    List<ForcePart> forces_;
    List<EventPart> events_;
    Storage storage_ = Storage::array;
};

/// Changes the parts of a running system by name: sets a parameter, or replaces, adds or removes a part.
///
///     velocity.speed = 8             a parameter of the single part of a kind
///     velocity.direction.x = 0.5     a component of a vector
///     velocity.part = random         another part of the kind, with default parameters
///     force.gravity.acceleration = 2 a parameter of a part in a list, by the part's name
///     force.2.acceleration = 2       or by its number in the list, from 1
///     force.gravity.part = wind      replaces the part; none: removes it
///     force.part = wind              adds a part
///
/// Throws InputError for an unknown name (with the nearest one), a value that is not allowed, or a change that would
/// make the system invalid; the list is then unchanged.
DUSTBENCH_API void changePart(PartList& parts, std::string_view name, std::string_view value);

/// Scales every length of the part that sets sizes. Throws InputError if a length leaves its range.
DUSTBENCH_API void scaleSizes(PartList& parts, double factor);

}  // namespace dustbench::particles
