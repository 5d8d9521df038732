// The wanted fields of a `.vti`, at its cells or at its points, and their grid.
//
// Points are the centres of cells. All fields must be at cells or at points, like the first one. Cells that VTK marks
// as hidden, duplicate or refined (`vtkGhostType`) are zero, and so are points whose cells are all marked, and cells
// with a hidden point.
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
    /// The values of a chosen field, cell by cell. Throws InputError.
    [[nodiscard]] std::vector<float> numbersOf(const Chosen& field) const;
    /// The same, piece by piece. Also throws what `take` throws.
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
    std::vector<char> isHidden_;  ///< per cell; empty: none is hidden
};

}  // namespace dustbench::volumes
