#include "methods/moment_oit/moment_kind.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace dustbench::moment_oit {
namespace {

constexpr double root3 = std::numbers::sqrt3;

/// The matrices, offsets and b* are those of the authors' published shaders. Biases: the supplement, as open ports of
/// these shaders quote it.
struct Figures {
    Kind kind;
    double bias;
    std::array<double, 8> towards;
};
constexpr std::array<Figures, 12> figures{{
    {{Basis::power, Precision::single, 4}, 5e-7, {0, 0.375, 0, 0.375}},
    {{Basis::power, Precision::single, 6}, 5e-6, {0, 0.48, 0, 0.451, 0, 0.45}},
    {{Basis::power, Precision::single, 8}, 5e-5, {0, 0.75, 0, 0.676666667, 0, 0.63, 0, 0.600303030}},
    {{Basis::power, Precision::quantised, 4}, 6e-5, {0, 0.628, 0, 0.628}},
    {{Basis::power, Precision::quantised, 6}, 6e-4, {0, 0.5566, 0, 0.489, 0, 0.47869382}},
    {{Basis::power, Precision::quantised, 8}, 2.5e-3, {0, 0.424749164, 0, 0.224078027, 0, 0.153692308, 0, 0.129004405}},
    {{Basis::trigonometric, Precision::single, 4}, 4e-7, {}},  // towards an even distribution over the circle
    {{Basis::trigonometric, Precision::single, 6}, 8e-7, {}},
    {{Basis::trigonometric, Precision::single, 8}, 1.5e-6, {}},
    {{Basis::trigonometric, Precision::quantised, 4}, 4e-4, {}},
    {{Basis::trigonometric, Precision::quantised, 6}, 6.5e-4, {}},
    {{Basis::trigonometric, Precision::quantised, 8}, 8.5e-4, {}},
}};

const Figures& figuresOf(const Kind& kind) {
    for (const Figures& one : figures)
        if (one.kind == kind) return one;
    throw std::logic_error("no bias is published for this number of moments");
}

constexpr std::array<double, 4> odd4{1.5, -2, root3 / 2, -2 * root3 / 9};
constexpr std::array<double, 4> even4{4, -4, 0.5, 0.5};
constexpr std::array<double, 9> odd6{
    2.5, -10, 8, -1.8749986445, 4.20757543111, -1.83257678661, 1.26583039016, -1.47644882902, 0.71061660238};
constexpr std::array<double, 9> even6{4, -4, 0, 9, -24, 16, -0.57759806484, 4.61936647543, -3.07953906655};
constexpr std::array<double, 16> odd8{3.48044635732474, -27.5760737514826,  55.1267384344761,   -31.5311110403183,  //
                                      1.26797185782836, -0.928755808743913, -2.07520453231032,  1.23598848322588,   //
                                      -2.1671560004294, 6.17950199592966,   -0.276515571579297, -4.23583042392097,  //
                                      0.97433287916576, -0.443426830933027, -0.360491648368785, 0.310149466050223};
constexpr std::array<double, 16> even8{
    0.280504133158527, -0.757633844606942, 0.392179589334688,  -0.887531871812237,  //
    -2.01362265883247, 0.221551373038988,  -1.06107954265125,  2.83887201588367,    //
    -7.31010494985321, 13.9855979699139,   -0.114305766176437, -7.4361899359832,    //
    -15.8954215629556, 79.6186327084103,   -127.457278992502,  63.7349456687829};
constexpr std::array<double, 4> halves{0.5, 0.5, 0.5, 0.5}, noOffset{};
constexpr std::array<double, 3> offset6{0, 0, 0.018888946};
constexpr std::array<double, 4> offset8{0.972481993925964, 1, 0.999179192513328, 0.991778293073131};

std::vector<double> timesVector(std::span<const double> matrix, std::span<const double> vector) {
    const std::size_t size = vector.size();
    std::vector<double> result(size);
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) result[i] += matrix[i * size + j] * vector[j];
    return result;
}

}  // namespace

double biasOf(const Kind& kind) {
    return figuresOf(kind).bias;
}

std::span<const double> towards(const Kind& kind) {
    return std::span(figuresOf(kind).towards).first(static_cast<std::size_t>(kind.count));
}

Transform oddTransform(int count) {
    if (count == 4) return {odd4, std::span(halves).first(2)};
    if (count == 6) return {odd6, std::span(halves).first(3)};
    return {odd8, halves};
}

Transform evenTransform(int count) {
    if (count == 4) return {even4, std::span(noOffset).first(2)};
    if (count == 6) return {even6, offset6};
    return {even8, offset8};
}

std::vector<double> inverseOf(std::span<const double> matrix) {
    const auto size = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(matrix.size()))));
    std::vector<double> left(matrix.begin(), matrix.end()), right(matrix.size());
    for (std::size_t i = 0; i < size; ++i) right[i * size + i] = 1;
    const auto addRow = [&](std::size_t to, std::size_t from, double factor) {
        for (std::size_t j = 0; j < size; ++j) {
            left[to * size + j] += factor * left[from * size + j];
            right[to * size + j] += factor * right[from * size + j];
        }
    };
    for (std::size_t i = 0; i < size; ++i) {  // Gauss-Jordan elimination
        addRow(i, i, 1 / left[i * size + i] - 1);
        for (std::size_t k = 0; k < size; ++k)
            if (k != i) addRow(k, i, -left[k * size + i]);
    }
    return right;
}

std::vector<double> quantised(const Kind& kind, std::span<const double> moments) {
    std::vector<double> stored(moments.size());
    if (kind.basis == Basis::trigonometric) {
        for (std::size_t j = 0; j < stored.size(); ++j) stored[j] = 0.5 * moments[j] + 0.5;
        return stored;
    }
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
        const Transform transform = first == 0 ? oddTransform(kind.count) : evenTransform(kind.count);
        std::vector<double> part;
        for (std::size_t j = first; j < moments.size(); j += 2) part.push_back(moments[j]);
        const std::vector<double> mapped = timesVector(transform.matrix, part);
        for (std::size_t i = 0; i < mapped.size(); ++i) stored[2 * i + first] = mapped[i] + transform.offset[i];
    }
    return stored;
}

std::vector<double> dequantised(const Kind& kind, std::span<const double> stored) {
    std::vector<double> moments(stored.size());
    if (kind.basis == Basis::trigonometric) {
        for (std::size_t j = 0; j < stored.size(); ++j) moments[j] = 2 * stored[j] - 1;
        return moments;
    }
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
        const Transform transform = first == 0 ? oddTransform(kind.count) : evenTransform(kind.count);
        std::vector<double> part;
        for (std::size_t i = 0; 2 * i + first < stored.size(); ++i)
            part.push_back(stored[2 * i + first] - transform.offset[i]);
        const std::vector<double> mapped = timesVector(inverseOf(transform.matrix), part);
        for (std::size_t i = 0; i < mapped.size(); ++i) moments[2 * i + first] = mapped[i];
    }
    return moments;
}

}  // namespace dustbench::moment_oit
