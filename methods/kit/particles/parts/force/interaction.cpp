// Particles attract or repel each other: all pairs, or with a tree.
//
// pairs: every particle attracts every other one, O(N²). tree: far cells attract as one body at their centre of mass,
// or not at all (the thesis's two ways). The attraction uses the positions at the start of the step; newborns take
// part from the next step on.
#include <algorithm>

#include "methods/kit/parallel/for_each_block.h"
#include "methods/kit/particles/attraction.h"
#include "methods/kit/particles/part_kinds.h"
#include "methods/kit/particles/particle_store.h"

namespace dustbench::particles::parts::force::interaction {
namespace {

enum class Method { pairs, tree };
constexpr Choices<Method> methods{{"pairs", Method::pairs}, {"tree", Method::tree}};
constexpr Choices<FarBodies> farWords{{"together", FarBodies::centreOfMass}, {"ignored", FarBodies::ignored}};

void add(std::size_t count, const float* __restrict pull, float* __restrict acceleration) {
    for (std::size_t i = 0; i < count; ++i) acceleration[i] += pull[i];
}

class Interaction final : public ForcePart {
 public:
    explicit Interaction(const ParameterValues& values);

    void begin(const Step& step, const ParticleStore& store) override;
    void push(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::size_t bytes() const override;

 private:
    void sumPairs(const ParticleStore& store);

    Attraction attraction_;
    Method method_;
    float openingAngle_;
    FarBodies farBodies_;
    AttractionTree tree_;
    std::vector<float> masses_, x_, y_, z_;  ///< accelerations of this step, in the store's order
};

Interaction::Interaction(const ParameterValues& values)
    : ForcePart(values),
      attraction_{values.choice("law", attractionLaws), static_cast<float>(values.real("strength")),
                  static_cast<float>(values.real("softening_metres"))},
      method_(values.choice("method", methods)),
      openingAngle_(static_cast<float>(values.real("opening_angle"))),
      farBodies_(values.choice("far", farWords)) {}

void Interaction::sumPairs(const ParticleStore& store) {
    masses_.assign(store.size(), 1);
    const Bodies bodies{store.x, store.y, store.z, masses_};
    constexpr std::size_t block = 256;
    parallel::forEachBlock(store.size(), block, [&](std::size_t first, std::size_t count) {
        for (auto* column : {&x_, &y_, &z_})
            std::fill_n(column->begin() + static_cast<std::ptrdiff_t>(first), count, 0.0f);
        addPull(attraction_, bodies,
                {count, &store.x[first], &store.y[first], &store.z[first], &x_[first], &y_[first], &z_[first]});
    });
}

void Interaction::begin(const Step&, const ParticleStore& store) {
    for (auto* column : {&x_, &y_, &z_}) column->resize(store.size());
    if (method_ == Method::pairs) {
        sumPairs(store);
        return;
    }
    tree_.build(store.x, store.y, store.z);
    tree_.pull(attraction_, openingAngle_, farBodies_, x_, y_, z_);
}

void Interaction::push(Chunk& chunk, const Step&) const {
    add(chunk.count, &x_[chunk.first], chunk.accelerationX);
    add(chunk.count, &y_[chunk.first], chunk.accelerationY);
    add(chunk.count, &z_[chunk.first], chunk.accelerationZ);
}

std::size_t Interaction::bytes() const {
    return tree_.bytes() + (masses_.capacity() + x_.capacity() + y_.capacity() + z_.capacity()) * sizeof(float);
}

}  // namespace

PartInfo describe() {
    PartInfo info;
    info.help = "particles attract or repel each other";
    info.source = "Thesis, 5.4; BarnesHut1986; Plummer1911";
    info.parameters.choice("law", AttractionLaw::inverseSquare, attractionLaws, attractionLawHelp)
        .real("strength", 0.01, -1e6, 1e6, "",
              "k of each particle: the acceleration in m/s² where f is 1; negative: repulsion")
        .real("softening_metres", 0.1, 1e-3, 1e4, "m",
              "ε: limits the attraction at small distances, since f is infinite at d = 0")
        .choice("method", Method::tree, methods, "pairs: every pair, exact; tree: far cells as one")
        .real("opening_angle", 0.6, 0, 10, "", "a cell is far if edge < angle·distance; 0: none")
        .choice("far", FarBodies::centreOfMass, farWords, "far cells pull from their centre of mass, or not at all");
    info.create = [](const ParameterValues& values) { return std::make_unique<Interaction>(values); };
    return info;
}

}  // namespace dustbench::particles::parts::force::interaction
