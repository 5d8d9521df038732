// The visibility of a pixel, vis(z): the transmittance of the fragments in front of the depth z. A step function of at
// most NODES nodes, from near to far:
//
//     vis(z) = tᵢ for dᵢ < z ≤ dᵢ₊₁,   vis(z) = 1 for z ≤ d₀
//
// Source: SalviEtAl2011.
struct Node {
    float depth;          // dᵢ
    float transmittance;  // tᵢ, behind the node
};
/// An unused node lies behind all fragments and has the transmittance of all of them. `insert` uses one node more.
/// No loop has more than 32 turns: drivers unroll those, and keep the nodes in registers.
Node nodes[NODES + 1];
const float unused = 1e30;

void clearVisibility() {
    for (int i = 0; i < NODES; ++i) nodes[i] = Node(unused, 1.0);
}

/// Removes the node whose removal changes the area under the function least. Its step then is at the node before it, so
/// that the function falls by the area
///
///     (dᵢ − dᵢ₋₁)·(tᵢ₋₁ − tᵢ)
///
/// and no visibility rises. The nearest and the farthest node stay.
void removeNode() {
    int least = 1;
    float leastArea = unused;
    for (int i = 1; i < NODES; ++i) {
        float area = (nodes[i].depth - nodes[i - 1].depth) * (nodes[i - 1].transmittance - nodes[i].transmittance);
        if (area < leastArea) {
            leastArea = area;
            least = i;
        }
    }
    for (int i = 0; i < NODES; ++i) {
        if (i >= least - 1) nodes[i].transmittance = nodes[i + 1].transmittance;
        if (i >= least) nodes[i].depth = nodes[i + 1].depth;
    }
}

/// Multiplies the function behind `depth` by the fragment's transmittance.
void insert(float depth, float transmittance) {
    Node carried = Node(depth, transmittance);  // the fragment's node, then the nodes behind it, to their new places
    for (int i = 0; i < NODES; ++i) {
        Node node = nodes[i];
        if (node.depth < depth) {
            carried.transmittance = node.transmittance * transmittance;
        } else {
            nodes[i] = carried;
            carried = Node(node.depth, node.transmittance * transmittance);
        }
    }
    nodes[NODES] = carried;
    if (carried.depth < unused) removeNode();
}

float visibilityAt(float depth) {
    float visibility = 1.0;
    for (int i = 0; i < NODES; ++i)
        if (nodes[i].depth < depth) visibility = nodes[i].transmittance;
    return visibility;
}

float totalTransmittance() {
    return nodes[NODES - 1].transmittance;
}
