// First pass: the moments of all puffs in front of the scene. Source: Munstermann2018, 3.1.
// Departs: without SURFACE and POINTS, a puff's own moments along the ray instead of those of a point.
flat in vec4 centre;
flat in float logDepth;
uniform vec4 rays;
uniform float nearMetres;
layout(binding = 0) uniform sampler2D sceneDepth;

layout(location = 0) out vec4 firstFour;  // b₁..b₄
layout(location = 1) out vec4 others;     // b₀ b₅ b₆ b₇
#if MOMENTS == 8
layout(location = 2) out float last;  // b₈
#endif

void main() {
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
    float b[MOMENTS + 1];
#ifdef SURFACE
    Profile profile = surfaceOf(puff, centre, nearMetres, scene / stretch);
    momentsOf(puff, profile, b);
#else
    momentsOf(puff, profileOf(puff), b);
#endif
    firstFour = vec4(b[1], b[2], b[3], b[4]);
#if MOMENTS == 4
    others = vec4(b[0], 0, 0, 0);
#elif MOMENTS == 6
    others = vec4(b[0], b[5], b[6], 0);
#else
    others = vec4(b[0], b[5], b[6], b[7]);
    last = b[8];
#endif
}
