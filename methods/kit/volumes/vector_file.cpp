#include "methods/kit/volumes/vector_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/vti_fields.h"

namespace dustbench::volumes {
namespace {

InputError refusedVectors(const std::filesystem::path& file, const std::string& reason) {
    return InputError(fmt::format("{}: {}", file.string(), files::printable(reason)));
}

VectorGrid readVtiVectors(const std::filesystem::path& file, const std::string& field) {
    const VtiFile vti(file);
    const std::array<WantedField, 1> wanted{{{"velocity", 3, {field}, true, false}}};
    const VtiFields fields(vti, wanted, file);
    VectorGrid grid;
    static_cast<GridPlace&>(grid) = fields.place();
    const std::vector<float> numbers = fields.numbersOf(fields.chosen().front());
    grid.values.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i < numbers.size(); i += 3)
        grid.values.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return grid;
}

VectorGrid readSparseVectors(const std::filesystem::path& file, const std::string& field) {
    if (const std::string why = files::refusalOf(file, files::limits::geometryBytes); !why.empty())
        throw refusedVectors(file, why);
    VectorGrid grid;
    if (const std::string why = readVdb(file, field, grid); !why.empty()) throw refusedVectors(file, why);
    return grid;
}

void requireFinite(const VectorGrid& grid, const std::filesystem::path& file) {
    for (const double number :
         {grid.spacing, grid.origin.x, grid.origin.y, grid.origin.z, grid.timeSeconds.value_or(0)})
        if (!std::isfinite(number)) throw refusedVectors(file, "its position, spacing or time is not a number");
    for (const glm::vec3& v : grid.values)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            throw refusedVectors(file, "it has a vector that is not a number");
}

}  // namespace

VectorGrid readVectors(const std::filesystem::path& file, const std::string& field) {
    if (file.extension() != ".vti" && file.extension() != ".vdb")
        throw refusedVectors(file, "expected a file that ends in .vti or .vdb");
    VectorGrid grid = file.extension() == ".vti" ? readVtiVectors(file, field) : readSparseVectors(file, field);
    requireFinite(grid, file);
    return grid;
}

}  // namespace dustbench::volumes
