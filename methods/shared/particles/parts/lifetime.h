// Death of age. The lifetime is drawn at birth, average + R·variation with R in [−1, 1).
//
// Source: Thesis, 4.7.2.
#pragma once

#include "methods/shared/particles/life_part.h"

namespace dustbench::particles {

class Lifetime : public LifePart {
 public:
    static PartInfo describe();
    /// Throws InputError where a lifetime could be 0.
    explicit Lifetime(const ParameterValues& values);

    void judge(Chunk& chunk, const Step& step) const override;
    [[nodiscard]] std::optional<double> meanLifetimeSeconds() const override { return averageSeconds_; }
    void giveLifetimes(Newborns& newborns, const Step& step) const override;

 private:
    double averageSeconds_, variationSeconds_;
};

}  // namespace dustbench::particles
