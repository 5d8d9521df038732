/// The quad that covers all rays which pass a puff's centre at less than `reach` metres; eye space.
struct PuffQuad {
    vec3 centre;
    vec3 right, up;  // of length 1
    float side;      // half of it; 0: nothing is seen; −1: it covers the picture, because the puff is around the eye
};

PuffQuad puffQuadOf(vec3 centre, float reach) {
    float distance = length(centre);
    PuffQuad quad = PuffQuad(centre, vec3(1, 0, 0), vec3(0, 1, 0), 0.0);
    if (distance < 2.0 * reach) {
        quad.side = -1.0;
    } else if (reach > 0.0 && centre.z <= reach) {
        // Perpendicular to the ray to the centre, and as wide there as the cone around the ball of radius `reach`.
        vec3 sight = centre / distance;
        quad.right = vec3(-sight.z, 0, sight.x) * inversesqrt(max(sight.x * sight.x + sight.z * sight.z, 1e-12));
        quad.up = cross(quad.right, sight);
        quad.side = reach * distance * inversesqrt(distance * distance - reach * reach);
    }
    return quad;
}
