// A plane perpendicular to the view; its thickness is the distance to the next plane along the pixel's ray.
//
//     α = 1 − e^(−σ·Δ)
//
// A slab cut by the scene contributes its part in front of the scene. Source: Senger2009, ch. 2.
layout(binding = 0) uniform sampler2D sceneDepth;
uniform vec3 eye;
uniform vec3 rayCorner, rayRight, rayUp;  // the ray through the image's corner, and its change per pixel
uniform float nearDistance, stepLength;

flat in float distance;
layout(location = 0) out vec4 colour;

void main() {
    vec3 ray = rayCorner + gl_FragCoord.x * rayRight + gl_FragCoord.y * rayUp;
    vec3 at = eye + distance * ray;
    float scene = nearDistance / max(texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, 1e-9);
    float reach = min(scene - (distance - 0.5 * stepLength), stepLength) * length(ray);
    if (reach <= 0.0 || any(lessThan(at, vec3(0))) || any(greaterThan(at, cells))) discard;
    float phase = 1.0;
#ifdef SHADOW
    phase = phaseOf(normalize(ray));
#endif
    vec3 source;
    float alpha = 1.0 - exp(-extinctionAt(at, phase, source) * reach);
    colour = vec4(source * alpha, alpha);
}
