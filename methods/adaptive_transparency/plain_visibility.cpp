#include "methods/adaptive_transparency/plain_visibility.h"

#include <algorithm>

namespace dustbench::adaptive_transparency {
namespace {

using Nodes = std::vector<PlainVisibility::Node>;

/// From the nearest to the farthest node.
double areaUnder(const Nodes& nodes) {
    double area = 0;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
        area += nodes[i].transmittance * (nodes[i + 1].depth - nodes[i].depth);
    return area;
}

/// The function with the step of node `i` moved to the node before it.
Nodes without(const Nodes& nodes, std::size_t i) {
    Nodes fewer = nodes;
    fewer[i - 1].transmittance = nodes[i].transmittance;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    return fewer;
}

}  // namespace

void PlainVisibility::insert(double depth, double transmittance) {
    const auto place = std::ranges::lower_bound(nodes_, depth, {}, &Node::depth);
    const auto inserted = nodes_.insert(place, {depth, at(depth)});
    for (auto node = inserted; node != nodes_.end(); ++node) node->transmittance *= transmittance;
    if (nodes_.size() <= most_) return;

    Nodes best = without(nodes_, 1);
    for (std::size_t i = 2; i + 1 < nodes_.size(); ++i) {
        Nodes other = without(nodes_, i);
        if (areaUnder(other) > areaUnder(best)) best = std::move(other);
    }
    nodes_ = std::move(best);
}

double PlainVisibility::at(double depth) const {
    double visibility = 1;
    for (const Node& node : nodes_)
        if (node.depth < depth) visibility = node.transmittance;
    return visibility;
}

}  // namespace dustbench::adaptive_transparency
