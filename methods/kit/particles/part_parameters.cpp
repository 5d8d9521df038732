#include "methods/kit/particles/part_parameters.h"

#include <algorithm>

#include "methods/contract/errors.h"
#include "methods/kit/files/data_folder.h"
#include "methods/kit/meshes/mesh_file.h"

namespace dustbench::particles {
namespace {

constexpr double maximumOpacity = 0.999;
constexpr const char* gaussian = "gaussian";
constexpr const char* folder = "shapes/meshes";
constexpr const char* extension = ".ply";

void linearOpacity(std::size_t count, const float* __restrict share, float* __restrict opacity, float start,
                   float end) {
    const float change = end - start;
    for (std::size_t i = 0; i < count; ++i) opacity[i] = start + change * share[i];
}

void bezierOpacity(std::size_t count, const float* __restrict share, float* __restrict opacity,
                   const maths::CubicPolynomial<float> curve) {
    // Rounding may make a curve that ends at 0 slightly negative.
    for (std::size_t i = 0; i < count; ++i) {
        const float value = curve(share[i]);
        opacity[i] = value > 0.0f ? value : 0.0f;
    }
}

void limitOpacity(std::size_t count, float* __restrict opacity, float maximum) {
    for (std::size_t i = 0; i < count; ++i) opacity[i] = opacity[i] < maximum ? opacity[i] : maximum;
}

float valueOf(const ParameterValues& values, const char* name) {
    return static_cast<float>(values.real(name));
}

}  // namespace

void OpacityCurve::declare(ParameterSet& set) {
    set.choice("opacity_curve", Form::linear, forms,
               "opacity over life: linear from start to end, or a cubic curve with two values in between")
        .real("opacity_start", 0.25, 0, maximumOpacity, "", "peak opacity at birth")
        .real("opacity_early", 0.17, 0, maximumOpacity, "", "second control value of the curve")
        .real("opacity_late", 0.08, 0, maximumOpacity, "", "third control value of the curve")
        .real("opacity_end", 0, 0, maximumOpacity, "", "peak opacity at death");
}

OpacityCurve::OpacityCurve(const ParameterValues& values, maths::SamplingMode mode)
    : form_(values.choice("opacity_curve", forms)),
      printed_(mode == maths::SamplingMode::paper),
      start_(valueOf(values, "opacity_start")),
      end_(valueOf(values, "opacity_end")) {
    const float early = valueOf(values, "opacity_early"), late = valueOf(values, "opacity_late");
    curve_ = printed_ ? maths::printedBezierPolynomial(start_, early, late, end_)
                      : maths::bezierPolynomial(start_, early, late, end_);
}

void OpacityCurve::write(const float* share, float* opacity, std::size_t count) const {
    if (form_ == Form::linear)
        linearOpacity(count, share, opacity, start_, end_);
    else
        bezierOpacity(count, share, opacity, curve_);
    if (printed_) limitOpacity(count, opacity, static_cast<float>(maximumOpacity));
}

void declarePicture(ParameterSet& set) {
    std::vector<std::string> names = files::listData("textures", ".png");
    names.insert(names.begin(), gaussian);
    set.dataFile("picture", gaussian, "textures", ".png", names, "picture of a sprite; a strip contains several");
}

std::string pictureOf(const ParameterValues& values) {
    const std::string& name = values.choice("picture");
    return name == gaussian ? std::string() : name;
}

void declareMesh(ParameterSet& set) {
    set.dataFile("mesh", "hare", folder, extension, files::listData(folder, extension),
                 "a mesh of data/shapes/meshes, or the path of an OBJ, PLY or STL file")
        .real("scale", 1, 1e-6, 1e6, "", "factor on the mesh's size")
        .boolean("open", false, "also accepts a surface with holes");
}

std::vector<std::array<glm::vec3, 3>> trianglesOf(const ParameterValues& values) {
    const std::string& name = values.choice("mesh");
    const scene::Mesh mesh = meshes::readMesh(files::findData("mesh", folder, name, extension), glm::vec3(1));
    const auto scale = static_cast<float>(values.real("scale"));
    std::vector<std::array<glm::vec3, 3>> triangles;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::vec3, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) triangle[k] = scale * mesh.positions[mesh.indices[i + k]];
        if (areaOf(triangle) > 0) triangles.push_back(triangle);
    }
    if (triangles.empty())
        throw InputError("parameter mesh: '" + name + "' has no triangle with an area, allowed: a surface");
    if (const std::size_t open = meshes::openEdges(mesh); open > 0 && !values.boolean("open"))
        throw InputError("parameter mesh: '" + name + "' has a hole (" + std::to_string(open) +
                         " open edges), allowed: a closed surface, or open = true");
    return triangles;
}

}  // namespace dustbench::particles
