// The visibility of a pixel in double precision, to test visibility.glsl. A node is chosen for removal by building the
// function without it and measuring the area under all of it.
//
// Source: SalviEtAl2011.
#pragma once

#include <cstddef>
#include <vector>

namespace dustbench::adaptive_transparency {

class PlainVisibility {
 public:
    struct Node {
        double depth, transmittance;  ///< the transmittance behind the node

        bool operator==(const Node&) const = default;
    };

    explicit PlainVisibility(std::size_t most) : most_(most) {}

    void insert(double depth, double transmittance);
    /// Transmittance of the fragments in front of `depth`.
    [[nodiscard]] double at(double depth) const;
    [[nodiscard]] double total() const { return nodes_.empty() ? 1 : nodes_.back().transmittance; }
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

 private:
    std::size_t most_;
    std::vector<Node> nodes_;  ///< from near to far
};

}  // namespace dustbench::adaptive_transparency
