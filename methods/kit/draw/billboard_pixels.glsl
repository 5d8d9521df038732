// The billboards of instances, and their pixels (quad_pixels.glsl).
layout(std430, binding = 0) restrict readonly buffer Instances {
    float values[];  // x y z radius opacity [red green blue]
};
uniform int floats;  // of an instance
uniform vec3 eye;
uniform mat4 worldToEye;

/// Without a radius if it cannot be seen.
Quad quadOfShape(uint shape) {
    uint base = shape * uint(floats);
    vec3 place = vec3(values[base], values[base + 1u], values[base + 2u]) - eye;
    return quadOf(mat3(worldToEye) * place, values[base + 4u] > 0.0 ? values[base + 3u] : 0.0);
}

Corners cornersOf(Quad quad) {
    return Corners(cornerOf(quad, vec2(-1, -1)), cornerOf(quad, vec2(1, -1)), cornerOf(quad, vec2(1, 1)),
                   cornerOf(quad, vec2(-1, 1)));
}

/// For tile_pairs.comp.
ivec4 pixelsOf(uint shape) {
    Quad quad = quadOfShape(shape);
    return quad.radius > 0.0 ? pixelsOfQuad(cornersOf(quad)) : noPixels;
}
