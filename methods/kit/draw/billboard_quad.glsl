// A billboard's quad, and the values of its picture that do not depend on the pixel.
const float log2e = 1.44269504;
/// 1.5 r = 3s: |offset|² = 9/2·log2(e) in the middle of an edge.
const float edgeOffset = 1.5 * sqrt(2.0 * log2e);

/// Eye space.
struct Quad {
    vec3 centre;
    vec3 right, up;  // of length 1
    vec3 normal;     // away from the eye, of length 1
    float radius;    // r; its half-side is 1.5 r. 0 if it is not drawn
    float nearness;  // (offset length 1 / distance)²
};

Quad quadOf(vec3 centre, float wantedRadius) {
    float distance = length(centre);
    bool drawn = distance > 1e-4;
    Quad quad;
    quad.centre = centre;
    quad.radius = drawn ? wantedRadius : 0.0;
#ifdef VIEWPLANE
    quad.right = vec3(1, 0, 0);
    quad.up = vec3(0, 1, 0);
    quad.normal = vec3(0, 0, -1);
    quad.nearness = 0.0;
#else
    // Perpendicular to the ray to the centre; `right` stays horizontal in the image.
    vec3 sight = drawn ? centre / distance : vec3(0, 0, -1);
    quad.right = vec3(-sight.z, 0, sight.x) * inversesqrt(max(sight.x * sight.x + sight.z * sight.z, 1e-12));
    quad.up = cross(quad.right, sight);
    quad.normal = sight;
    float share = quad.radius / max(distance, 1e-4);
    quad.nearness = share * share / (2.0 * log2e);
#endif
    return quad;
}

/// `corner`: from −1 to 1 along both axes.
vec3 cornerOf(Quad quad, vec2 corner) {
    return quad.centre + 1.5 * quad.radius * (corner.x * quad.right + corner.y * quad.up);
}

/// −log2(1 − α) = τ·log2(e); a series for small α, where 1 − α would lose digits.
float opticalDepth(float opacity) {
    if (opacity > 0.05) return -log2(1.0 - opacity);
    return log2e * opacity * (1.0 + opacity * (1.0 / 2 + opacity * (1.0 / 3 + opacity * (1.0 / 4 + opacity / 5))));
}
