// Second pass: Σ w·c and Σ w, w = α·T(z) of a point, depth · mean T of a puff. Source: Munstermann2018, Eq. 2.
flat in vec4 centre;
flat in float logDepth;
#ifdef COLOURED
flat in vec3 puffColour;
#else
uniform vec3 puffColour;
#endif
uniform vec4 rays;
uniform float nearMetres;
layout(binding = 0) uniform sampler2D sceneDepth;
layout(binding = 1) uniform sampler2D firstFour;
layout(binding = 2) uniform sampler2D others;

layout(location = 0) out vec4 weighted;

float transmittance(float whole, float b[MOMENTS + 1], float metres) {
    return exp(-whole * shareBefore(b, warped(max(metres, leastMetres))));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, pixel, 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
    Profile profile = profileOf(puff);

    float b[MOMENTS + 1];
    vec4 low = texelFetch(firstFour, pixel, 0), high = texelFetch(others, pixel, 0);
    b[0] = high.x, b[1] = low.x, b[2] = low.y, b[3] = low.z, b[4] = low.w;
#if MOMENTS == 6
    b[5] = high.y, b[6] = high.z;
#endif
    float whole = b[0], mean = 1.0;
    if (whole > 1e-6) {
        biased(b);
        float middle = puff.foot + profile.mean * puff.metres;
        mean = transmittance(whole, b, middle);
#if SAMPLES == 3
        // Three-point Gaussian quadrature: exact for polynomials of degree five over a whole puff.
        float apart = sqrt(3.0 * profile.variance) * puff.metres;
        mean = (4.0 * mean + transmittance(whole, b, middle - apart) + transmittance(whole, b, middle + apart)) / 6.0;
#endif
    }
#ifdef POINTS
    float weight = opacityOf(profile.depth) * mean;
#else
    float weight = profile.depth * mean;
#endif
    weighted = vec4(weight * puffColour, weight);
}
