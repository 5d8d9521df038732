#include "methods/kit/raycast/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/toml_reader.h"

namespace dustbench::raycast {
namespace {

constexpr double maximumEmission = 1000, maximumExtinction = 1000;

std::string place(const std::string& where, std::size_t row) {
    return where + "row " + std::to_string(row + 1) + ": ";
}

/// Throws if the row is out of range or does not follow the previous one.
void checkRow(const std::vector<TransferFunction::Row>& rows, std::size_t i, const std::string& where) {
    const TransferFunction::Row& row = rows[i];
    if (!(row.reaction >= 0 && row.reaction <= 1))
        throw InputError(place(where, i) + "got a reaction of " + std::to_string(row.reaction) + ", allowed: 0..1");
    if (i > 0 && !(row.reaction > rows[i - 1].reaction))
        throw InputError(place(where, i) + "got a reaction of " + std::to_string(row.reaction) +
                         ", allowed: more than in the previous row (" + std::to_string(rows[i - 1].reaction) + ")");
    for (int channel = 0; channel < 3; ++channel)
        if (!(row.emission[channel] >= 0 && static_cast<double>(row.emission[channel]) <= maximumEmission))
            throw InputError(place(where, i) + "got an emission of " + std::to_string(row.emission[channel]) +
                             ", allowed: 0..1000");
    if (!(row.extinctionFactor >= 0 && static_cast<double>(row.extinctionFactor) <= maximumExtinction))
        throw InputError(place(where, i) + "got an extinction of " + std::to_string(row.extinctionFactor) +
                         ", allowed: 0..1000");
}

void checkCount(std::size_t rows, const std::string& where) {
    if (rows < 2)
        throw InputError(where + "got " + std::to_string(rows) + (rows == 1 ? " row" : " rows") +
                         ", allowed: 2 or more");
}

TransferFunction readPlanck(files::TomlReader table) {
    PlanckFire fire;
    fire.coldKelvin = table.number("cold_kelvin", 100, 20'000, fire.coldKelvin);
    fire.hotKelvin = table.number("hot_kelvin", 500, 20'000, fire.hotKelvin);
    if (!(fire.hotKelvin > fire.coldKelvin))
        throw InputError(table.where("hot_kelvin") + "key 'hot_kelvin': got " + std::to_string(fire.hotKelvin) +
                         ", allowed: more than cold_kelvin (" + std::to_string(fire.coldKelvin) + ")");
    fire.luminance = table.number("luminance", 0, 100, fire.luminance);
    const auto extinction = [&](const char* key, float initial) {
        return static_cast<float>(table.number(key, 0, maximumExtinction, static_cast<double>(initial)));
    };
    fire.burntExtinction = extinction("burnt_extinction", fire.burntExtinction);
    fire.freshExtinction = extinction("fresh_extinction", fire.freshExtinction);
    table.finish();
    return transferFunctionOf(fire);
}

/// A Gaussian whose width differs on both sides; nanometres.
double lobe(double wavelength, double middle, double below, double above) {
    const double t = (wavelength - middle) / (wavelength < middle ? below : above);
    return std::exp(-0.5 * t * t);
}

/// The colour matching functions of Wyman2013, Eq. 4.
glm::dvec3 eyeResponse(double nm) {
    return {
        1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) - 0.065 * lobe(nm, 501.1, 20.4, 26.2),
        0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1),
        1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8)};
}

/// B(λ, T) ∝ λ⁻⁵ / (exp(c₂/λT) − 1), relative to λ = 560 nm.
double spectralRadiance(double nm, double kelvin) {
    constexpr double c2 = 1.4387769e7;  // nm·K
    return std::pow(560 / nm, 5) / std::expm1(c2 / (nm * kelvin));
}

glm::dvec3 linearRgb(const glm::dvec3& xyz) {
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

}  // namespace

TransferFunction::TransferFunction()
    : TransferFunction({{0.00, {0.00f, 0.00f, 0.00f}, 1.0f},
                        {0.15, {0.12f, 0.01f, 0.00f}, 1.0f},
                        {0.35, {1.30f, 0.22f, 0.02f}, 0.9f},
                        {0.60, {2.80f, 1.00f, 0.12f}, 0.7f},
                        {0.85, {3.60f, 2.20f, 0.60f}, 0.5f},
                        {1.00, {3.00f, 2.40f, 1.20f}, 0.4f}}) {}

TransferFunction::TransferFunction(std::vector<Row> rows) : rows_(std::move(rows)) {
    const std::string where = "transfer function: ";
    checkCount(rows_.size(), where);
    for (std::size_t i = 0; i < rows_.size(); ++i) checkRow(rows_, i, where);
}

glm::vec4 TransferFunction::at(double reaction) const {
    const auto value = [](const Row& row) { return glm::vec4(row.emission, row.extinctionFactor); };
    const auto above = std::ranges::find_if(rows_, [reaction](const Row& row) { return row.reaction >= reaction; });
    if (above == rows_.begin()) return value(rows_.front());
    if (above == rows_.end()) return value(rows_.back());
    const Row& below = *std::prev(above);
    const double share = (reaction - below.reaction) / (above->reaction - below.reaction);
    return glm::mix(value(below), value(*above), static_cast<float>(share));
}

std::vector<glm::vec4> TransferFunction::table() const {
    std::vector<glm::vec4> values;
    values.reserve(texels);
    for (int i = 0; i < texels; ++i) values.push_back(at(static_cast<double>(i) / (texels - 1)));
    return values;
}

glm::dvec3 blackBody(double kelvin) {
    glm::dvec3 sum(0);
    for (int nm = 360; nm <= 830; nm += 5) sum += spectralRadiance(nm, kelvin) * eyeResponse(nm);
    return sum;
}

TransferFunction transferFunctionOf(const PlanckFire& fire) {
    const double scale = fire.luminance / blackBody(fire.hotKelvin).y;
    std::vector<TransferFunction::Row> rows;
    for (int i = 0; i < TransferFunction::texels; ++i) {
        const double reaction = static_cast<double>(i) / (TransferFunction::texels - 1);
        const glm::dvec3 light = scale * linearRgb(blackBody(glm::mix(fire.coldKelvin, fire.hotKelvin, reaction)));
        rows.push_back({reaction, glm::vec3(glm::max(light, glm::dvec3(0))),
                        glm::mix(fire.burntExtinction, fire.freshExtinction, static_cast<float>(reaction))});
    }
    return TransferFunction(std::move(rows));
}

TransferFunction loadTransferFunction(const std::filesystem::path& file) {
    files::TomlReader reader = files::TomlReader::parseFile(file);
    if (reader.has("planck")) {
        if (reader.has("row"))
            throw InputError(reader.where("row") +
                             "got both [planck] and [[row]], allowed: either [planck] or [[row]]");
        files::TomlReader table = reader.table("planck");
        reader.finish();
        return readPlanck(std::move(table));
    }
    std::vector<files::TomlReader> tables = reader.tables("row");
    reader.finish();
    checkCount(tables.size(), reader.where());
    std::vector<TransferFunction::Row> rows;
    for (files::TomlReader& table : tables) {
        const double reaction = table.number("reaction", 0, 1);
        const glm::dvec3 emission = table.vector3("emission");
        const double extinction = table.number("extinction", 0, maximumExtinction, 1);
        table.finish();
        rows.push_back({reaction, glm::vec3(emission), static_cast<float>(extinction)});
        checkRow(rows, rows.size() - 1, table.where());
    }
    return TransferFunction(std::move(rows));
}

}  // namespace dustbench::raycast
