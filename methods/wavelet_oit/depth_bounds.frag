// Before the first pass: the nearest and the farthest place of the puffs of each pixel. Maxima do not depend on order.
// Puffs below `leastDepth` are left out: they would widen the bounds without being visible.
flat in vec4 centre;
flat in float logDepth;
uniform vec4 rays;
uniform float nearMetres;
layout(binding = 0) uniform sampler2D sceneDepth;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, pixel, 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
    Seen seen = seenOf(puff, centre, stretch, scene, nearMetres);
    if (seen.depth > leastDepth) {
        int first = 2 * (pixel.y * pictureWidth + pixel.x);
        atomicMax(bounds[first], floatBitsToUint(1.0 / seen.metres));
        atomicMax(bounds[first + 1], floatBitsToUint(seen.metres));
    }
    discard;
}
