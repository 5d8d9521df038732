// Shared by both shaders: the lists of the tiles, and a puff along a pixel's ray (puff_tiles.h).
struct Puff {
    vec4 pixel;   // centre's pixel, its fraction; around the eye: the centre
    vec4 place;   // slopes of the centre, its axis distance, nearest distance of its extinction
    vec4 optics;  // log2 of its depth, falloff, 1/(√2·s), farthest distance of its extinction
    vec4 colour;
};
layout(std430, binding = 0) readonly buffer Puffs {
    Puff puffs[];
};
layout(std430, binding = 1) readonly buffer Lists {
    uvec2 lists[];  // begin, and where the puffs ahead of the eye begin
};
layout(std430, binding = 2) readonly buffer Entries {
    uint entries[];
};
layout(binding = 0) uniform sampler2D sceneDepth;
uniform vec3 projection;  // slope per pixel, across and up; near distance

/// A pixel's ray: along (X, Y, 1), of length √D.
struct Ray {
    vec2 slopes;
    float inverseSquare;  // 1/D
    float stretch;        // √D
    float axisMetres;     // of the opaque scene
};

Ray rayOf(ivec2 pixel, ivec2 size) {
    Ray ray;
    ray.slopes = (vec2(2 * pixel + 1 - size) * 0.5) * projection.xy;
    float square = 1.0 + dot(ray.slopes, ray.slopes);
    ray.inverseSquare = 1.0 / square;
    ray.stretch = sqrt(square);
    float depth = texelFetch(sceneDepth, pixel, 0).r;
    ray.axisMetres = depth > 0.0 ? projection.z / depth : 1e30;
    return ray;
}

/// Distances from the eye and to the scene of the ray's point nearest to a puff's centre, divided by √2·s.
struct Foot {
    float fromEye, toScene;
};

/// Ahead of the eye: with the offset w of the slopes from the centre's p, b² = z²·(|w|² + (p × w)²)/D.
float depthAhead(Puff puff, Ray ray, vec2 offset) {
    float turn = puff.place.x * offset.y - puff.place.y * offset.x;
    return exp2(puff.optics.x - puff.optics.y * ((dot(offset, offset) + turn * turn) * ray.inverseSquare));
}

/// tc = √D·z·(1 − w·(X, Y)/D), without the difference of large distances that t1 − tc would be.
Foot footAhead(Puff puff, Ray ray, vec2 offset) {
    float z = puff.place.z, scale = ray.stretch * puff.optics.z;
    float shift = z * dot(offset * projection.xy, ray.slopes) * ray.inverseSquare;
    return Foot((z - shift) * scale, (ray.axisMetres - z + shift) * scale);
}

/// In pixels, without cancellation.
vec2 offsetOf(Puff puff, ivec2 pixel) {
    return vec2(pixel - ivec2(puff.pixel.xy)) + (0.5 - puff.pixel.zw);
}

Foot footAroundEye(Puff puff, Ray ray) {
    float foot = dot(puff.pixel.xyz, vec3(ray.slopes, 1.0)) / ray.stretch;
    return Foot(foot * puff.optics.z, (ray.axisMetres * ray.stretch - foot) * puff.optics.z);
}

float depthAroundEye(Puff puff, Ray ray) {
    vec3 direction = vec3(ray.slopes, 1.0) / ray.stretch, centre = puff.pixel.xyz;
    vec3 perpendicular = centre - dot(centre, direction) * direction;
    return exp2(puff.optics.x - puff.optics.y * dot(perpendicular, perpendicular));
}
