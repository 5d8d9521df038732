#include "methods/grid_fluid/precision/staggered_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
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

double squareOf(double value) {
    return value * value;
}

double squareOfDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += squareOf(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    return sum;
}

double squareOf(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) sum += squareOf(static_cast<double>(value));
    return sum;
}

template <typename Take>
void forEach(const glm::ivec3& first, const glm::ivec3& end, const Take& take) {
    for (glm::ivec3 at(first); at.z < end.z; ++at.z)
        for (at.y = first.y; at.y < end.y; ++at.y)
            for (at.x = first.x; at.x < end.x; ++at.x) take(at);
}

/// ω of an edge is the circulation of the four faces around it. Edges on the box's sides are omitted.
double enstrophyOf(const StaggeredFlow& flow) {
    double sum = 0;
    const auto speed = [&](int axis, const glm::ivec3& at) {
        return static_cast<double>(flow.speeds[static_cast<std::size_t>(axis)][flow.face(axis, at.x, at.y, at.z)]);
    };
    for (int along = 0; along < 3; ++along) {
        const int a = (along + 1) % 3, b = (along + 2) % 3;
        glm::ivec3 first(0), nextA(0), nextB(0);
        first[a] = first[b] = nextA[a] = nextB[b] = 1;
        forEach(first, flow.cells, [&](const glm::ivec3& at) {
            sum += squareOf(speed(b, at) - speed(b, at - nextA) - speed(a, at) + speed(a, at - nextB));
        });
    }
    return sum;
}

/// Coefficients of the cosine series of the speeds at the centres along an axis.
std::vector<double> seriesOf(const StaggeredFlow& flow, int axis) {
    glm::ivec3 next(0);
    next[axis] = 1;
    std::vector<double> values;
    const std::vector<float>& speeds = flow.speeds[static_cast<std::size_t>(axis)];
    forEach(glm::ivec3(0), flow.cells, [&](const glm::ivec3& at) {
        const glm::ivec3 behind = at + next;
        values.push_back(0.5 * (static_cast<double>(speeds[flow.face(axis, at.x, at.y, at.z)]) +
                                static_cast<double>(speeds[flow.face(axis, behind.x, behind.y, behind.z)])));
    });
    for (int along = 0; along < 3; ++along) {
        const int n = flow.cells[along];
        std::vector<double> line(static_cast<std::size_t>(n)), cosines;
        for (int k = 0; k < n; ++k)
            for (int i = 0; i < n; ++i)
                cosines.push_back(std::sqrt((k == 0 ? 1.0 : 2.0) / n) * std::cos(std::numbers::pi * k * (i + 0.5) / n));
        glm::ivec3 end = flow.cells;
        end[along] = 1;
        forEach(glm::ivec3(0), end, [&](glm::ivec3 at) {
            const auto valueAt = [&](int i) -> double& {
                at[along] = i;
                return values[flow.cell(at.x, at.y, at.z)];
            };
            for (int i = 0; i < n; ++i) line[static_cast<std::size_t>(i)] = valueAt(i);
            for (int k = 0; k < n; ++k) {
                double sum = 0;
                for (int i = 0; i < n; ++i)
                    sum += cosines[static_cast<std::size_t>(k * n + i)] * line[static_cast<std::size_t>(i)];
                valueAt(k) = sum;
            }
        });
    }
    return values;
}

/// Energy by wave number, in half waves per width along z.
std::vector<double> spectrumOf(const StaggeredFlow& flow) {
    const int width = flow.cells.z;
    std::vector<double> energy(static_cast<std::size_t>(width));
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double> series = seriesOf(flow, axis);
        forEach(glm::ivec3(0), flow.cells, [&](const glm::ivec3& at) {
            const glm::dvec3 waves = glm::dvec3(at) * static_cast<double>(width) / glm::dvec3(flow.cells);
            const auto number = static_cast<std::size_t>(std::lround(glm::length(waves)));
            if (number < energy.size()) energy[number] += squareOf(series[flow.cell(at.x, at.y, at.z)]);
        });
    }
    return energy;
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

StaggeredFlow averaged(const StaggeredFlow& flow, int refinement) {
    StaggeredFlow coarse(flow.cells / refinement);
    for (int axis = -1; axis < 3; ++axis) {
        glm::ivec3 block(refinement);
        if (axis >= 0) block[axis] = 1;
        const bool isDensity = axis < 0;
        const auto& fine = isDensity ? flow.density : flow.speeds[static_cast<std::size_t>(axis)];
        auto& mean = isDensity ? coarse.density : coarse.speeds[static_cast<std::size_t>(axis)];
        forEach(glm::ivec3(0), coarse.faces(axis), [&](const glm::ivec3& at) {
            double sum = 0;
            const glm::ivec3 first = at * refinement;
            forEach(first, first + block, [&](const glm::ivec3& of) {
                sum += static_cast<double>(
                    fine[isDensity ? flow.cell(of.x, of.y, of.z) : flow.face(axis, of.x, of.y, of.z)]);
            });
            mean[isDensity ? coarse.cell(at.x, at.y, at.z) : coarse.face(axis, at.x, at.y, at.z)] =
                static_cast<float>(sum / (block.x * block.y * block.z));
        });
    }
    return coarse;
}

FlowDistance distanceOf(const StaggeredFlow& flow, const StaggeredFlow& reference) {
    FlowDistance distance;
    distance.density = std::sqrt(squareOfDifference(flow.density, reference.density) / squareOf(reference.density));
    double apart = 0, whole = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        apart += squareOfDifference(flow.speeds[axis], reference.speeds[axis]);
        whole += squareOf(reference.speeds[axis]);
    }
    distance.velocity = std::sqrt(apart / whole);
    distance.enstrophy = std::abs(std::log(enstrophyOf(flow) / enstrophyOf(reference)));
    const std::vector<double> energy = spectrumOf(flow), expected = spectrumOf(reference);
    double sum = 0;
    for (std::size_t number = 1; number < energy.size(); ++number)
        sum += squareOf(std::log(energy[number] / expected[number]));
    distance.spectrum = std::sqrt(sum / static_cast<double>(energy.size() - 1));
    return distance;
}

FlowSums sumsOf(const StaggeredFlow& flow, std::span<const std::uint8_t> solids, double spacingMetres,
                double stepSeconds) {
    FlowSums sums;
    const double volume = spacingMetres * spacingMetres * spacingMetres;
    for (const float density : flow.density) sums.massM3 += static_cast<double>(density) * volume;
    for (const std::vector<float>& speeds : flow.speeds) sums.energyM5PerS2 += squareOf(speeds) / 2 * volume;
    forEach(glm::ivec3(0), flow.cells, [&](const glm::ivec3& at) {
        if (!solids.empty() && solids[flow.cell(at.x, at.y, at.z)] != 0) return;
        double out = 0;
        for (int axis = 0; axis < 3; ++axis) {
            glm::ivec3 behind = at;
            ++behind[axis];
            const std::vector<float>& speeds = flow.speeds[static_cast<std::size_t>(axis)];
            out += static_cast<double>(speeds[flow.face(axis, behind.x, behind.y, behind.z)]) -
                   static_cast<double>(speeds[flow.face(axis, at.x, at.y, at.z)]);
        }
        sums.divergencePerStep = std::max(sums.divergencePerStep, std::abs(out) * stepSeconds / spacingMetres);
    });
    return sums;
}

}  // namespace dustbench::grid_fluid::precision
