#include "bench/world/dust_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "methods/contract/errors.h"
#include "methods/kit/files/csv.h"
#include "methods/kit/files/input_log.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/matching_files.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/volumes/file_series.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/volume_series.h"
#include "methods/kit/volumes/vtp_file.h"

namespace dustbench::world {

namespace fs = std::filesystem;
namespace {

constexpr const char* endings = ".vtp, .vdb, .nvdb, .vti, .csv, .toml, .pvd or .series";
constexpr std::size_t bytesPerParticle = 2 * sizeof(std::uint64_t) + 13 * sizeof(float);

InputError tooMany(const fs::path& file, double count) {
    return InputError(fmt::format("{}: has {:.0f} particles, allowed: {} (limit of dust)", file.string(), count,
                                  files::limits::dustParticles));
}

/// A table of one moment, or of several if it has a column of times.
void readCsv(const fs::path& file, const DustColumns& columns, std::vector<DustMoment>& moments) {
    const files::CsvTable csv = files::CsvTable::parseFile(file);
    volumes::PointTable whole;
    whole.points = csv.rows();
    for (const std::string& name : csv.header()) {
        volumes::PointColumn& column = whole.columns.emplace_back(volumes::PointColumn{name, 1, {}});
        if (!columns.wants(name)) continue;
        if (std::ranges::count(csv.header(), name) > 1)
            throw InputError(fmt::format("{}:1: the column '{}' appears twice", file.string(), name));
        column.values.reserve(csv.rows());
        for (std::size_t row = 0; row < csv.rows(); ++row) column.values.push_back(csv.number(row, name));
    }
    const auto time = columns.find(whole, "time", file.string());
    for (std::size_t begin = 0, end = 0; begin < whole.points || begin == 0; begin = end) {
        end = begin + 1;
        while (end < whole.points && (!time || time->at(end) == time->at(begin))) ++end;
        end = std::min(end, whole.points);
        if (end - begin > static_cast<std::size_t>(files::limits::dustParticles))
            throw tooMany(file, static_cast<double>(end - begin));
        volumes::PointTable part;
        part.points = end - begin;
        if (time && part.points > 0) part.timeSeconds = time->at(begin);
        for (const volumes::PointColumn& column : whole.columns) {
            volumes::PointColumn& own = part.columns.emplace_back(volumes::PointColumn{column.name, 1, {}});
            if (!column.values.empty())
                own.values.assign(column.values.begin() + static_cast<std::ptrdiff_t>(begin),
                                  column.values.begin() + static_cast<std::ptrdiff_t>(end));
        }
        const std::string name =
            time && part.timeSeconds ? fmt::format("{} at {} s", file.string(), *part.timeSeconds) : file.string();
        moments.push_back(dustMoment(part, columns, name));
        if (time) std::erase(moments.back().unused, files::namedPart("column", time->name));
        if (whole.points == 0) break;
    }
}

/// False for a `.vdb` without points.
bool readOne(const volumes::SeriesEntry& entry, const DustColumns& columns, std::vector<DustMoment>& moments) {
    files::noteInput(entry.file);
    const std::string extension = entry.file.extension();
    const auto wants = [&columns](std::string_view name) { return columns.wants(name); };
    const std::size_t before = moments.size();
    if (extension == ".vtp") {
        moments.push_back(dustMoment(volumes::readVtp(entry.file, wants), columns, entry.file.string()));
    } else if (extension == ".vdb") {
        const auto points = volumes::findVdbPoints(entry.file, wants);
        if (!points) return false;
        moments.push_back(dustMoment(*points, columns, entry.file.string()));
    } else if (extension == ".csv") {
        readCsv(entry.file, columns, moments);
        if (entry.timeSeconds && moments.size() != before + 1)
            throw InputError(entry.file.string() + ": has more than one time, expected one per file of a series");
    } else {
        throw InputError(fmt::format("dust: got '{}', expected a file that ends in {}", entry.file.string(), endings));
    }
    if (entry.timeSeconds) moments.back().timeSeconds = entry.timeSeconds;
    for (std::size_t i = before; i < moments.size(); ++i) files::noteIgnored(entry.file, moments[i].unused);
    return true;
}

/// True for files that are always volumes. A `.vdb` without points is a volume too.
bool isVolume(const fs::path& file) {
    const std::string extension = file.extension();
    return extension == ".nvdb" || extension == ".vti" || extension == ".toml";
}

DustFiles readVolumes(const fs::path& path, bool hasColumns) {
    if (hasColumns)
        throw InputError(
            fmt::format("--dust-columns: not allowed with the volume {}, only with particles; name a "
                        "volume's fields in a .toml",
                        path.string()));
    const volumes::VolumeSetup setup = volumes::readVolumeSetup(path);
    const volumes::VolumeSeries series = volumes::VolumeSeries::read(setup);
    DustFiles dust{dustOfVolume(series, setup), {}, setup.albedo};
    if (volumes::isIndex(setup.files) && !files::isPattern(setup.files)) dust.files.push_back(setup.files);
    if (path.extension() == ".toml") dust.files.push_back(path);
    std::ranges::copy(series.files(), std::back_inserter(dust.files));
    return dust;
}

}  // namespace

void requireDustFits(double particles, const fs::path& path) {
    const double bytes = particles * static_cast<double>(bytesPerParticle);
    if (bytes > static_cast<double>(files::limits::dustBytes))
        throw InputError(
            fmt::format("{}: its moments have {:.0f} particles, which need {:.3g} GB of memory, allowed: {:.3g} GB "
                        "(limit of dust)",
                        path.string(), particles, bytes / 1e9, static_cast<double>(files::limits::dustBytes) / 1e9));
}

DustFiles readDustFiles(const fs::path& path, const DustColumns& columns, bool hasColumns) {
    const bool isIndex = volumes::isIndex(path);
    const std::vector<volumes::SeriesEntry> entries = volumes::seriesEntries(path, "dust");
    DustFiles dust;
    if (isVolume(entries.front().file)) return readVolumes(path, hasColumns);
    if (isIndex && !files::isPattern(path)) dust.files.push_back(path);
    double particles = 0;
    for (const volumes::SeriesEntry& entry : entries) {
        const std::size_t before = dust.moments.size();
        if (!readOne(entry, columns, dust.moments)) {
            if (dust.moments.empty()) return readVolumes(path, hasColumns);
            throw InputError(fmt::format("{}: has no points, expected points as in {}", entry.file.string(),
                                         dust.moments.front().file));
        }
        for (std::size_t i = before; i < dust.moments.size(); ++i)
            particles += static_cast<double>(dust.moments[i].size());
        requireDustFits(particles, path);
        dust.files.push_back(entry.file);
    }
    return dust;
}

namespace {

using volumes::GridPlace;
using volumes::VolumeGrid;

constexpr double maximumPuffOpacity = 0.999;  ///< as for all particles
constexpr double maximumIds = 9e15;           ///< as for all dust files

/// The sum over the cells of a block.
struct Block {
    std::uint64_t id = 0;
    double density = 0;
    glm::dvec3 momentum{0};  ///< velocity times density
};

/// Blocks of cells on the lattice of the whole series, so that a block has one id in all moments.
class Blocks {
 public:
    Blocks(const GridPlace& whole, int edgeCells)
        : whole_(whole), edge_(edgeCells), counts_((whole.cells + edgeCells - 1) / edgeCells) {}

    [[nodiscard]] double edgeMetres() const { return edge_ * whole_.spacing; }
    [[nodiscard]] glm::dvec3 middleOf(std::uint64_t id) const {
        const auto x = static_cast<std::uint64_t>(counts_.x), y = static_cast<std::uint64_t>(counts_.y);
        return whole_.origin + edgeMetres() * (glm::dvec3(id % x, id / x % y, id / (x * y)) + 0.5);
    }

    /// The blocks with density, in ascending order of their ids.
    [[nodiscard]] std::vector<Block> sums(const VolumeGrid& grid) const {
        std::vector<Block> filled;
        const glm::ivec3 first = volumes::firstCell(whole_, grid), low = first / edge_,
                         high = (first + grid.cells - 1) / edge_, size = high - low + 1;
        std::vector<Block> layer;
        for (int block = low.z; block <= high.z; ++block) {
            layer.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), {});
            const int begin = std::max(block * edge_ - first.z, 0),
                      end = std::min((block + 1) * edge_ - first.z, grid.cells.z);
            for (int z = begin; z < end; ++z) addLayer(grid, z, first, low, size.x, layer);
            std::size_t at = 0;
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x, ++at)
                    if (layer[at].density > 0) {
                        layer[at].id = idOf({low.x + x, low.y + y, block});
                        filled.push_back(layer[at]);
                    }
        }
        return filled;
    }

 private:
    [[nodiscard]] std::uint64_t idOf(const glm::ivec3& block) const {
        return (static_cast<std::uint64_t>(block.z) * static_cast<std::uint64_t>(counts_.y) +
                static_cast<std::uint64_t>(block.y)) *
                   static_cast<std::uint64_t>(counts_.x) +
               static_cast<std::uint64_t>(block.x);
    }

    void addLayer(const VolumeGrid& grid, int z, const glm::ivec3& first, const glm::ivec3& low, int width,
                  std::vector<Block>& layer) const {
        for (int y = 0; y < grid.cells.y; ++y) {
            std::size_t i = grid.indexOf({0, y, z});
            const int row = ((first.y + y) / edge_ - low.y) * width;
            for (int x = 0; x < grid.cells.x; ++x, ++i) {
                if (!(grid.density[i] > 0)) continue;
                Block& block = layer[static_cast<std::size_t>(row + (first.x + x) / edge_ - low.x)];
                const auto density = static_cast<double>(grid.density[i]);
                block.density += density;
                if (!grid.velocity.empty()) block.momentum += density * glm::dvec3(grid.velocity[i]);
            }
        }
    }

    GridPlace whole_;
    int edge_;
    glm::ivec3 counts_;
};

/// The blocks of both; those only in `others` without density.
std::vector<Block> withEmpty(const std::vector<Block>& blocks, const std::vector<Block>& others) {
    std::vector<Block> all;
    std::ranges::set_union(blocks, others, std::back_inserter(all), {}, &Block::id, &Block::id);
    std::size_t own = 0;
    for (Block& block : all) {
        while (own < blocks.size() && blocks[own].id < block.id) ++own;
        if (own == blocks.size() || blocks[own].id != block.id) block = {block.id, 0, {}};
    }
    return all;
}

void requireFew(std::size_t particles, const std::string& file, int blockCells) {
    if (particles > static_cast<std::size_t>(files::limits::dustParticles))
        throw InputError(
            fmt::format("{}: {} of its cells have density, allowed: {} (limit of dust); set block_cells to "
                        "more than {} in a .toml",
                        file, particles, files::limits::dustParticles, blockCells));
}

void add(DustMoment& moment, const Block& block, const Blocks& blocks, const volumes::VolumeSetup& setup) {
    const double edge = blocks.edgeMetres(), s = puffDeviationCells * edge;
    const double mass = block.density * setup.extinctionPerMetre * std::pow(edge / setup.blockCells, 3);
    const double opacity = -std::expm1(-mass / (2 * std::numbers::pi * s * s));
    if (opacity > maximumPuffOpacity)
        throw InputError(fmt::format(
            "{}: a cell has an optical depth of {:.3g} along its edge, allowed for particles: {:.3g}; set a lower "
            "extinction_per_metre in a .toml, or use finer cells",
            moment.file, mass / (edge * edge),
            -std::log1p(-maximumPuffOpacity) * 2 * std::numbers::pi * puffDeviationCells * puffDeviationCells));
    const glm::dvec3 middle = blocks.middleOf(block.id);
    moment.id.push_back(block.id);
    moment.x.push_back(static_cast<float>(middle.x));
    moment.y.push_back(static_cast<float>(middle.y));
    moment.z.push_back(static_cast<float>(middle.z));
    moment.radius.push_back(static_cast<float>(2 * s));
    moment.opacity.push_back(static_cast<float>(opacity));
    if (!moment.hasVelocity) return;
    const glm::dvec3 velocity = block.density > 0 ? block.momentum / block.density : glm::dvec3(0);
    moment.velocityX.push_back(static_cast<float>(velocity.x));
    moment.velocityY.push_back(static_cast<float>(velocity.y));
    moment.velocityZ.push_back(static_cast<float>(velocity.z));
}

}  // namespace

std::vector<DustMoment> dustOfVolume(const volumes::VolumeSeries& series, const volumes::VolumeSetup& setup) {
    const std::span<const VolumeGrid> grids = series.moments();
    GridPlace whole = grids.front();
    for (const VolumeGrid& grid : grids) whole = enclosing(whole, grid);
    if (cellsOf(whole) > maximumIds)
        throw InputError(series.files().front().string() +
                         ": the moments of the series are too far apart for particles");
    const Blocks blocks(whole, setup.blockCells);
    const bool hasVelocity = std::ranges::none_of(grids, [](const VolumeGrid& grid) { return grid.velocity.empty(); });

    std::vector<std::vector<Block>> sums;
    for (const VolumeGrid& grid : grids) sums.push_back(blocks.sums(grid));
    std::vector<DustMoment> moments;
    double particles = 0;
    for (std::size_t m = 0; m < grids.size(); ++m) {
        std::vector<Block> shown = sums[m];
        if (m > 0) shown = withEmpty(shown, sums[m - 1]);
        if (m + 1 < grids.size()) shown = withEmpty(shown, sums[m + 1]);
        DustMoment& moment = moments.emplace_back();
        moment.file = series.files()[m].string();
        moment.timeSeconds = grids[m].timeSeconds;
        moment.hasIds = true;
        moment.hasVelocity = hasVelocity;
        moment.depthsChange = true;
        requireFew(shown.size(), moment.file, setup.blockCells);
        particles += static_cast<double>(shown.size());
        requireDustFits(particles, moment.file);
        for (const Block& block : shown) add(moment, block, blocks, setup);
    }
    return moments;
}

}  // namespace dustbench::world
