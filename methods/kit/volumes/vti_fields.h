// The wanted fields of a `.vti`, at its cells or at its points, and the grid that they lie on.
//
// Points are the middles of cells. All fields lie where the first one lies. What VTK marks as hidden, duplicate or
// refined (`vtkGhostType`) is zero: such cells, points whose cells are all marked, and cells with a hidden point.
// Source: Kitware2021, "XML file formats"; the marks are those of vtkDataSetAttributes.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "methods/kit/volumes/field_request.h"
#include "methods/kit/volumes/grid_place.h"
#include "methods/kit/volumes/vti_file.h"

namespace dustbench::volumes {

class VtiFields {
 public:
    struct Chosen {
        std::string_view what;  ///< of the WantedField
        const VtiArray* array;
    };

    /// Both must outlive it. Throws InputError with the file.
    VtiFields(const VtiFile& vti, std::span<const WantedField> wanted, const std::filesystem::path& file);

    [[nodiscard]] const GridPlace& place() const { return place_; }
    [[nodiscard]] const std::vector<Chosen>& chosen() const { return chosen_; }
    /// Of one of the chosen, cell by cell. Throws InputError.
    [[nodiscard]] std::vector<float> numbersOf(const Chosen& field) const;
    /// The same, a piece after the other. Also throws what `take` throws.
    void streamNumbers(const Chosen& field, const std::function<void(std::span<const float>)>& take) const;

 private:
    void choose(std::span<const WantedField> wanted, const std::filesystem::path& file);
    void hide();
    void noteRest(const std::filesystem::path& file) const;
    [[nodiscard]] std::vector<char> markedIn(const std::vector<VtiArray>& arrays, unsigned marks) const;

    const VtiFile& vti_;
    GridPlace place_;
    bool atPoints_ = false;
    std::vector<Chosen> chosen_;
    std::vector<char> isHidden_;  ///< cell by cell; empty: none is
};

}  // namespace dustbench::volumes
