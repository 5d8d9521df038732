// The puffs of instances, and the pixels of the quads that PuffQuads draws for them (quad_pixels.glsl).
layout(std430, binding = 0) restrict readonly buffer Instances {
    float values[];  // x y z radius opacity [red green blue]
};
uniform int floats;  // of an instance
uniform vec3 eye;
uniform mat4 worldToEye;
uniform float reach;  // standard deviations

PuffQuad quadOfShape(uint shape) {
    uint base = shape * uint(floats);
    vec3 place = vec3(values[base], values[base + 1u], values[base + 2u]) - eye;
    float radius = values[base + 4u] > 0.0 ? values[base + 3u] : 0.0;
    return puffQuadOf(mat3(worldToEye) * place, 0.5 * radius * reach);
}

Corners cornersOf(PuffQuad quad) {
    vec3 right = quad.side * quad.right, up = quad.side * quad.up;
    return Corners(quad.centre - right - up, quad.centre + right - up, quad.centre + right + up,
                   quad.centre - right + up);
}

/// For tile_pairs.comp.
ivec4 pixelsOf(uint shape) {
    PuffQuad quad = quadOfShape(shape);
    if (quad.side < 0.0) return ivec4(0, 0, picture.xy - 1);
    return quad.side > 0.0 ? pixelsOfQuad(cornersOf(quad)) : noPixels;
}

/// Whether a ray meets an irregular quad beyond the near plane.
bool meets(PuffQuad quad, vec3 ray) {
    vec3 normal = cross(quad.up, quad.right);
    float along = dot(quad.centre, normal) / dot(ray, normal);
    vec3 offset = along * ray - quad.centre;
    return along >= projection.z && max(abs(dot(offset, quad.right)), abs(dot(offset, quad.up))) <= quad.side;
}
