#include "methods/grid_fluid/precision/staggered_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::grid_fluid::precision {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr int maximumCells = 1024;

/// Calls `take(index, record, lane)` for the density of all cells and the speeds of all faces.
template <typename Flow, typename Record, typename Take>
void forEachNumber(Flow& flow, const Record& recordAt, const Take& take) {
    for (int axis = -1; axis < 3; ++axis) {
        const glm::ivec3 count = flow.faces(axis);
        const std::size_t lane = axis < 0 ? std::size_t{flow::density} : static_cast<std::size_t>(axis);
        auto& values = axis < 0 ? flow.density : flow.speeds[static_cast<std::size_t>(axis)];
        auto value = values.begin();
        for (int k = 0; k < count.z; ++k)
            for (int j = 0; j < count.y; ++j)
                for (int i = 0; i < count.x; ++i) take(*value++, recordAt(i, j, k)[lane]);
    }
}

void writeNumbers(std::ostream& to, std::span<const float> values) {
    to.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size_bytes()));
}

/// The density of all cells and the speeds of all faces.
std::uintmax_t bytesOf(const glm::ivec3& cells) {
    const auto count = [](int x, int y, int z) {
        return static_cast<std::uintmax_t>(x) * static_cast<std::uintmax_t>(y) * static_cast<std::uintmax_t>(z);
    };
    const auto [x, y, z] = std::array{cells.x, cells.y, cells.z};
    return sizeof(float) * (count(x, y, z) + count(x + 1, y, z) + count(x, y + 1, z) + count(x, y, z + 1));
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& got, const std::string& allowed) {
    throw InputError(fmt::format("{}: got {}, allowed: {}", file.string(), got, allowed));
}

template <typename Write>
void writeFile(const std::filesystem::path& file, const Write& write) {
    std::ofstream to(file, std::ios::binary);
    write(to);
    if (!to.flush()) throw InputError(file.string() + ": cannot be written; check the folder and its free space");
}

}  // namespace

StaggeredFlow::StaggeredFlow(glm::ivec3 count) : cells(count) {
    const auto sizeOf = [](const glm::ivec3& n) { return index(n, 0, 0, n.z); };
    density.resize(sizeOf(cells));
    for (int axis = 0; axis < 3; ++axis) speeds[static_cast<std::size_t>(axis)].resize(sizeOf(faces(axis)));
}

StaggeredFlow storedBy(const flow::FluidSolver& solver) {
    StaggeredFlow flow(solver.box().cells);
    const auto recordAt = [&](int i, int j, int k) { return solver.cells().cell(solver.layout().at(i, j, k)); };
    forEachNumber(flow, recordAt, [](float& value, float stored) { value = stored; });
    return flow;
}

void giveTo(flow::FluidSolver& solver, const StaggeredFlow& flow) {
    flow::CellField& cells = solver.changeCells();
    const auto recordAt = [&](int i, int j, int k) { return cells.cell(solver.layout().at(i, j, k)); };
    forEachNumber(flow, recordAt, [](float value, float& stored) { stored = value; });
}

void writeFlow(const std::filesystem::path& file, const StaggeredFlow& flow) {
    writeFile(file, [&](std::ostream& to) {
        to << fmt::format("dustbench-flow 1 {} {} {}\n", flow.cells.x, flow.cells.y, flow.cells.z);
        writeNumbers(to, flow.density);
        for (const std::vector<float>& speeds : flow.speeds) writeNumbers(to, speeds);
    });
}

void writeFloats(const std::filesystem::path& file, std::span<const float> values) {
    writeFile(file, [&](std::ostream& to) { writeNumbers(to, values); });
}

StaggeredFlow readFlow(const std::filesystem::path& file) {
    if (const std::string why = files::refusalOf(file, files::limits::geometryBytes); !why.empty())
        throw InputError(fmt::format("{}: {}, expected a flow", file.string(), why));
    std::ifstream from(file, std::ios::binary);
    std::array<char, 100> line{};
    from.getline(line.data(), line.size());
    std::istringstream words(line.data());
    std::string word;
    int version = 0;
    glm::ivec3 cells(0);
    words >> word >> version >> cells.x >> cells.y >> cells.z;
    const auto isAllowed = [](int count) { return count >= 1 && count <= maximumCells; };
    if (!from || !words || word != "dustbench-flow" || version != 1 || !isAllowed(cells.x) || !isAllowed(cells.y) ||
        !isAllowed(cells.z))
        fail(file, "another first line", "'dustbench-flow 1 NX NY NZ', up to 1024 cells along each axis");
    if (std::filesystem::file_size(file) != static_cast<std::uintmax_t>(from.gcount()) + bytesOf(cells))
        fail(file, "another number of values", "one for each cell and face");
    StaggeredFlow flow(cells);
    const auto read = [&](std::vector<float>& values) {
        from.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
        if (!from) throw InputError(file.string() + ": cannot be read to its end");
        if (!std::ranges::all_of(values, [](float value) { return std::isfinite(value); }))
            fail(file, "a value that is not finite", "finite numbers");
    };
    read(flow.density);
    for (std::vector<float>& speeds : flow.speeds) read(speeds);
    return flow;
}

}  // namespace dustbench::grid_fluid::precision
