#include "methods/kit/volumes/volume_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/field_request.h"
#include "methods/kit/volumes/vdb_process.h"
#include "methods/kit/volumes/vti_fields.h"

namespace dustbench::volumes {
namespace {

/// Fraction of the maximum: densities this far below zero count as zero, because simulation schemes overshoot.
constexpr float belowZero = 1e-3f;
constexpr double farthest = 1e9;

InputError refused(const std::filesystem::path& file, const std::string& reason) {
    return InputError(fmt::format("{}: {}", file.string(), files::printable(reason)));
}

VolumeGrid readVti(const std::filesystem::path& file, const VolumeFields& fields) {
    const VtiFile vti(file);
    const VtiFields chosen(vti, wantedFields(fields), file);
    VolumeGrid grid;
    static_cast<GridPlace&>(grid) = chosen.place();
    for (const VtiFields::Chosen& field : chosen.chosen()) {
        std::vector<float> numbers = chosen.numbersOf(field);
        if (field.what != "velocity") {
            (field.what == "density" ? grid.density : grid.temperature) = std::move(numbers);
            continue;
        }
        grid.velocity.reserve(numbers.size() / 3);
        for (std::size_t i = 0; i < numbers.size(); i += 3)
            grid.velocity.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
    return grid;
}

void streamVti(const std::filesystem::path& file, const VolumeFields& fields, VolumeSink& sink) {
    const VtiFile vti(file);
    const VtiFields chosen(vti, wantedFields(fields), file);
    sink.begin(chosen.place());
    for (const VtiFields::Chosen& field : chosen.chosen())
        if (sink.beginField(field.what))
            chosen.streamNumbers(field, [&](std::span<const float> numbers) { sink.take(numbers); });
}

void requireFile(const std::filesystem::path& file) {
    if (const std::string why = files::refusalOf(file, files::limits::geometryBytes); !why.empty())
        throw refused(file, why);
}

VolumeGrid readSparse(const std::filesystem::path& file, const VolumeFields& fields) {
    requireFile(file);
    VolumeGrid grid;
    if (const std::string why = readVdbVolume(file, fields, grid); !why.empty()) throw refused(file, why);
    return grid;
}

void requirePlace(const GridPlace& place, const std::filesystem::path& file) {
    for (const double number :
         {place.spacing, place.origin.x, place.origin.y, place.origin.z, place.timeSeconds.value_or(0)})
        if (!std::isfinite(number) || std::abs(number) > farthest)
            throw refused(file, "its position, spacing or time is not a number up to 1e9");
}

void requireSound(VolumeGrid& grid, const std::filesystem::path& file, bool clampsDensity) {
    requirePlace(grid, file);
    float maximum = 0;
    for (const float density : grid.density) {
        if (!std::isfinite(density)) throw refused(file, "it has a density that is not a number");
        maximum = std::max(maximum, density);
    }
    for (float& density : grid.density) {
        if (density >= 0) continue;
        requireDensity(density, maximum, file, clampsDensity);
        density = 0;
    }
    if (std::ranges::any_of(grid.temperature, [](float number) { return !std::isfinite(number); }))
        throw refused(file, "it has a temperature that is not a number");
    for (const glm::vec3& v : grid.velocity)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            throw refused(file, "it has a velocity that is not a number");
}

/// True for a `.vti`.
bool isVti(const std::filesystem::path& file) {
    const std::string extension = file.extension();
    if (extension != ".vti" && extension != ".vdb" && extension != ".nvdb")
        throw refused(file, "expected a file that ends in .vdb, .nvdb or .vti");
    return extension == ".vti";
}

/// Passes on only valid positions.
class SoundPlaces final : public VolumeSink {
 public:
    SoundPlaces(VolumeSink& sink, const std::filesystem::path& file) : sink_(sink), file_(file) {}

    void begin(const GridPlace& place) override {
        requirePlace(place, file_);
        sink_.begin(place);
    }
    bool beginField(std::string_view field) override { return sink_.beginField(field); }
    void take(std::span<const float> numbers) override { sink_.take(numbers); }

 private:
    VolumeSink& sink_;
    const std::filesystem::path& file_;
};

// --- Vectors

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
    requireFile(file);
    VectorGrid grid;
    if (const std::string why = readVdb(file, field, grid); !why.empty()) throw refused(file, why);
    return grid;
}

void requireFinite(const VectorGrid& grid, const std::filesystem::path& file) {
    for (const double number :
         {grid.spacing, grid.origin.x, grid.origin.y, grid.origin.z, grid.timeSeconds.value_or(0)})
        if (!std::isfinite(number)) throw refused(file, "its position, spacing or time is not a number");
    for (const glm::vec3& v : grid.values)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
            throw refused(file, "it has a vector that is not a number");
}

}  // namespace

void requireDensity(float density, float maximum, const std::filesystem::path& file, bool clampsDensity) {
    if (!std::isfinite(density)) throw refused(file, "it has a density that is not a number");
    if (density < -belowZero * maximum && !clampsDensity)
        throw refused(file,
                      fmt::format("it has a density of {}, allowed: 0 or more, or clamp_density in a .toml", density));
}

void streamVolume(const std::filesystem::path& file, const VolumeFields& fields, VolumeSink& sink) {
    SoundPlaces sound(sink, file);
    if (isVti(file)) return streamVti(file, fields, sound);
    requireFile(file);
    if (const std::string why = streamVdbVolume(file, fields, sound); !why.empty()) throw refused(file, why);
}

VolumeGrid readVolume(const std::filesystem::path& file, const VolumeFields& fields) {
    VolumeGrid grid = isVti(file) ? readVti(file, fields) : readSparse(file, fields);
    requireSound(grid, file, fields.clampsDensity);
    return grid;
}

VectorGrid readVectors(const std::filesystem::path& file, const std::string& field) {
    if (file.extension() != ".vti" && file.extension() != ".vdb")
        throw refused(file, "expected a file that ends in .vti or .vdb");
    VectorGrid grid = file.extension() == ".vti" ? readVtiVectors(file, field) : readSparseVectors(file, field);
    requireFinite(grid, file);
    return grid;
}

}  // namespace dustbench::volumes
