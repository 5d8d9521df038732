// Visits every node of an octree.
#pragma once

#include "methods/kit/octree/octree.h"

namespace dustbench::octree_pair {

/// Calls `visit(cursor)` for every node below `node` in pre-order: a node before its children, these by octant.
template <typename Visit>
void visitBelow(const octree::Octree::Cursor& node, const Visit& visit) {
    for (unsigned octant = 0; octant < 8; ++octant) {
        if (!node.hasChild(octant)) continue;
        const octree::Octree::Cursor child = node.child(octant);
        visit(child);
        if (child.hasChildren()) visitBelow(child, visit);
    }
}

/// Number of nodes, without the root.
inline std::size_t countNodes(const octree::Octree& tree) {
    std::size_t nodes = 0;
    visitBelow(tree.root(), [&](const octree::Octree::Cursor&) { ++nodes; });
    return nodes;
}

}  // namespace dustbench::octree_pair
