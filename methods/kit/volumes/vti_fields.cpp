#include "methods/kit/volumes/vti_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "methods/contract/errors.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/printable.h"

namespace dustbench::volumes {
namespace {

constexpr double cubeWithin = 1e-5;

enum CellMark : unsigned { duplicateCell = 1, refinedCell = 8, hiddenCell = 32 };
enum PointMark : unsigned { duplicatePoint = 1, hiddenPoint = 2 };

InputError refusedField(const std::filesystem::path& file, const std::string& reason) {
    return InputError(fmt::format("{}: {}", file.string(), files::printable(reason)));
}

struct Clause {
    std::string reason;
};

/// The arrays at cells or at points; `where` says which.
std::vector<PresentField> presentAt(const std::vector<VtiArray>& arrays, const char* where) {
    std::vector<PresentField> present;
    present.reserve(arrays.size());
    for (const VtiArray& array : arrays) present.push_back({array.name, array.components, where});
    return present;
}

/// Calls take(cell, corner) for the eight points of each cell, as indices.
template <typename Take>
void forEachCorner(const glm::ivec3& cells, const Take& take) {
    GridPlace inner, outer;
    inner.cells = cells;
    outer.cells = cells + 1;
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x)
                for (int corner = 0; corner < 8; ++corner)
                    take(inner.indexOf({x, y, z}),
                         outer.indexOf({x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)}));
}

}  // namespace

VtiFields::VtiFields(const VtiFile& vti, std::span<const WantedField> wanted, const std::filesystem::path& file)
    : vti_(vti) {
    place_.cells = vti.cells();
    place_.origin = vti.origin();
    place_.spacing = vti.spacing().x;
    for (int axis = 0; axis < 3; ++axis)
        if (!(vti.spacing()[axis] > 0) || std::abs(vti.spacing()[axis] / place_.spacing - 1) > cubeWithin)
            throw refusedField(file, fmt::format("its cells are not cubes: {} x {} x {}", vti.spacing().x,
                                                 vti.spacing().y, vti.spacing().z));
    choose(wanted, file);
    if (atPoints_) {
        place_.cells += 1;
        place_.origin -= place_.spacing / 2;
    }
    place_.timeSeconds = vti.fieldNumber("TimeValue");
    hide();
    noteRest(file);
}

/// Notes all arrays but the chosen ones, the time, and VTK's marks of cells as ignored.
void VtiFields::noteRest(const std::filesystem::path& file) const {
    std::vector<std::string> rest;
    const auto note = [&](const std::vector<VtiArray>& arrays, const char* where) {
        for (const VtiArray& array : arrays)
            if (!isBookkeeping(array.name) && std::ranges::find(chosen_, &array, &Chosen::array) == chosen_.end())
                rest.push_back(files::namedPart("array", array.name) + where);
    };
    note(vti_.cellArrays(), " at cells");
    note(vti_.pointArrays(), " at points");
    for (const VtiArray& array : vti_.fieldArrays())
        if (array.name != "TimeValue") rest.push_back(files::namedPart("field data", array.name));
    std::ranges::copy(vti_.unreadArrays(), std::back_inserter(rest));
    files::noteIgnored(file, rest);
}

void VtiFields::choose(std::span<const WantedField> wanted, const std::filesystem::path& file) {
    const std::size_t atCells = vti_.cellArrays().size();
    std::vector<PresentField> all = presentAt(vti_.cellArrays(), "at cells");
    std::ranges::move(presentAt(vti_.pointArrays(), "at points"), std::back_inserter(all));
    const auto arrayAt = [&](std::size_t i) {
        return i < atCells ? &vti_.cellArrays()[i] : &vti_.pointArrays()[i - atCells];
    };
    try {
        for (const WantedField& each : wanted) {
            std::vector<PresentField> present = all;
            if (!chosen_.empty() && !each.isRequired)  // a field elsewhere counts as missing
                for (std::size_t i = 0; i < present.size(); ++i)
                    if ((i >= atCells) != atPoints_) present[i].components = 0;
            const int found = chosenField<Clause>(each, present);
            if (found < 0) continue;
            const auto at = static_cast<std::size_t>(found);
            if (chosen_.empty()) atPoints_ = at >= atCells;
            if ((at >= atCells) != atPoints_)
                throw Clause{fmt::format("its field '{}' is {}, but its {} is {}", present[at].name, present[at].kind,
                                         chosen_.front().what, atPoints_ ? "at points" : "at cells")};
            chosen_.push_back({each.what, arrayAt(at)});
        }
    } catch (const Clause& clause) {
        throw refusedField(file, clause.reason);
    }
}

/// True where `vtkGhostType` has one of the marks, or the older `vtkGhostLevels` is not 0; empty if neither is present.
std::vector<char> VtiFields::markedIn(const std::vector<VtiArray>& arrays, unsigned marks) const {
    std::vector<char> marked;
    for (const VtiArray& array : arrays) {
        const bool isType = array.name == "vtkGhostType";
        if ((!isType && array.name != "vtkGhostLevels") || array.components != 1) continue;
        const std::vector<float> numbers = vti_.numbersOf(array);
        marked.resize(numbers.size());
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (numbers[i] > 0 && numbers[i] < 256 && (!isType || (static_cast<unsigned>(numbers[i]) & marks) != 0))
                marked[i] = 1;
    }
    return marked;
}

void VtiFields::hide() {
    const std::vector<char> cells = markedIn(vti_.cellArrays(), duplicateCell | refinedCell | hiddenCell);
    const std::vector<char> points =
        markedIn(vti_.pointArrays(), atPoints_ ? duplicatePoint | hiddenPoint : hiddenPoint);
    isHidden_ = atPoints_ ? points : cells;
    const std::vector<char>& others = atPoints_ ? cells : points;
    if (others.empty()) return;
    isHidden_.resize(place_.cellCount());
    if (!atPoints_)
        return forEachCorner(vti_.cells(), [&](std::size_t cell, std::size_t corner) {
            if (others[corner] != 0) isHidden_[cell] = 1;
        });
    std::vector<char> isSeen(isHidden_.size());
    forEachCorner(vti_.cells(), [&](std::size_t cell, std::size_t corner) {
        if (others[cell] == 0) isSeen[corner] = 1;
    });
    for (std::size_t point = 0; point < isSeen.size(); ++point)
        if (isSeen[point] == 0) isHidden_[point] = 1;
}

std::vector<float> VtiFields::numbersOf(const Chosen& field) const {
    std::vector<float> numbers = vti_.numbersOf(*field.array);
    const auto components = static_cast<std::size_t>(field.array->components);
    for (std::size_t cell = 0; cell < isHidden_.size(); ++cell)
        if (isHidden_[cell] != 0) std::fill_n(&numbers[cell * components], components, 0.0f);
    return numbers;
}

void VtiFields::streamNumbers(const Chosen& field, const std::function<void(std::span<const float>)>& take) const {
    if (isHidden_.empty()) return vti_.streamNumbers(*field.array, take);
    const auto components = static_cast<std::size_t>(field.array->components);
    std::size_t at = 0;
    std::vector<float> seen;
    vti_.streamNumbers(*field.array, [&](std::span<const float> numbers) {
        seen.assign(numbers.begin(), numbers.end());
        for (float& number : seen)
            if (isHidden_[at++ / components] != 0) number = 0;
        take(seen);
    });
}

}  // namespace dustbench::volumes
