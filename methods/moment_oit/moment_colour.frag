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
#ifdef QUANTISED
layout(std430, binding = 1) readonly buffer Stored {
    uint stored[];  // pairs of 16-bit moments, MOMENTS/2 per pixel
};
uniform int pictureWidth;
layout(binding = 1) uniform sampler2D total;
#else
layout(binding = 1) uniform sampler2D firstFour;
layout(binding = 2) uniform sampler2D others;
#if MOMENTS == 8
layout(binding = 3) uniform sampler2D last;
#endif
#endif

layout(location = 0) out vec4 weighted;

float transmittance(float whole, float b[MOMENTS + 1], float metres) {
    return exp(-whole * shareBefore(b, warped(max(metres, leastMetres))));
}

/// The total depth; b₁ … of a measure of total b₀.
float readMoments(ivec2 pixel, out float b[MOMENTS + 1]) {
#ifdef QUANTISED
    int first = (pixel.y * pictureWidth + pixel.x) * (MOMENTS / 2);
    float q[MOMENTS];
    for (int k = 0; k < MOMENTS / 2; ++k) {
        vec2 pair = unpackUnorm2x16(stored[first + k]);
        q[2 * k] = pair.x;
        q[2 * k + 1] = pair.y;
    }
    dequantise(q, b);
    return texelFetch(total, pixel, 0).r;
#else
    vec4 low = texelFetch(firstFour, pixel, 0), high = texelFetch(others, pixel, 0);
    b[0] = high.x, b[1] = low.x, b[2] = low.y, b[3] = low.z, b[4] = low.w;
#if MOMENTS >= 6
    b[5] = high.y, b[6] = high.z;
#endif
#if MOMENTS == 8
    b[7] = high.w, b[8] = texelFetch(last, pixel, 0).r;
#endif
    return b[0];
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = rayThrough(gl_FragCoord.xy, rays);
    float stretch = length(ray);
    float scene = sceneMetresOf(texelFetch(sceneDepth, pixel, 0).r, nearMetres, stretch);
    PuffOnRay puff = puffOnRay(centre, logDepth, ray / stretch, scene);
#ifdef SURFACE
    Profile profile = surfaceOf(puff, centre, nearMetres, scene / stretch);
#else
    Profile profile = profileOf(puff);
#endif

    float b[MOMENTS + 1];
    float whole = readMoments(pixel, b), mean = 1.0;
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
