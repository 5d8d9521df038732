#include "methods/kit/volumes/vector_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/vti_file.h"

namespace dustbench::volumes {
namespace {

constexpr double vectorsWithin = 1e-5;

InputError refusedVectors(const std::filesystem::path& file, const std::string& reason) {
    return InputError(fmt::format("{}: {}", file.string(), files::printable(reason)));
}

const VtiArray& vectorsIn(const VtiFile& vti, const std::filesystem::path& file, const std::string& field) {
    std::string others;
    for (const VtiArray& array : vti.cellArrays()) {
        if (array.components != 3) continue;
        if (array.name == field) return array;
        others += (others.empty() ? "; it has: " : ", ") + array.name;
    }
    throw refusedVectors(file, "it has no field of vectors '" + field + "'" + others);
}

VectorGrid readVtiVectors(const std::filesystem::path& file, const std::string& field) {
    const VtiFile vti(file);
    const VtiArray& vectors = vectorsIn(vti, file, field);
    VectorGrid grid;
    grid.cells = vti.cells();
    grid.origin = vti.origin();
    grid.spacing = vti.spacing().x;
    for (int axis = 0; axis < 3; ++axis)
        if (!(vti.spacing()[axis] > 0) || std::abs(vti.spacing()[axis] / grid.spacing - 1) > vectorsWithin)
            throw refusedVectors(file, "its cells are no cubes");
    grid.timeSeconds = vti.fieldNumber("TimeValue");
    const std::vector<float> numbers = vti.numbersOf(vectors);
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
        if (!std::isfinite(number)) throw refusedVectors(file, "its place or its time is no number");
    for (const glm::vec3& v : grid.values)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            throw refusedVectors(file, "it has a vector that is no number");
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
