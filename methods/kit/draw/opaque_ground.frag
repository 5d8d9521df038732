// Textured ground lit by sun, sky and lamps. RELIEF: a height field. TRACK: two worn ruts along the world's x axis.
// SHADED: samples shadows; without it all ground is in the sun.
layout(location = 0) in vec3 fromEye;
layout(location = 1) in vec2 place;
#ifdef RELIEF
layout(location = 2) in vec3 groundNormal;
#endif
#ifdef TRACK
layout(location = 3) in float acrossTrack;
#endif

layout(binding = 0) uniform sampler2D detail;
layout(binding = 1) uniform sampler2D patches;

layout(location = 0) out vec4 colour;

#ifdef TRACK
// A Gaussian groove of width s seen through a pixel of width w: the widths add in quadrature, the area is constant.
float groove(float distance, float width, float pixel) {
    float seen2 = width * width + pixel * pixel;
    return width * inversesqrt(seen2) * exp2(-0.7213475 * distance * distance / seen2);
}

vec3 trackFactor() {
    float pixel = 0.5 * fwidth(acrossTrack);
    float off = abs(acrossTrack);
    float ruts = groove(off - 0.78, 0.16, pixel);
    float bed = groove(off, 0.95, pixel);
    return vec3(1.0) + bed * vec3(0.20, 0.18, 0.15) - ruts * vec3(0.42);
}
#endif

void main() {
    vec3 albedo = texture(detail, place * DETAIL_TILES).rgb * texture(patches, place).rgb * PATCH_SCALE;
#ifdef TRACK
    albedo *= trackFactor();
#endif
#ifdef RELIEF
    vec3 normal = normalize(groundNormal);
#else
    vec3 normal = vec3(0.0, 1.0, 0.0);
#endif
    float facing = max(dot(normal, toSun.xyz), 0.0);
    vec3 sky = ambient.rgb;
#ifdef SHADED
    facing *= sunShare(fromEye, normal, 0.0);
    sky *= skyShare(fromEye);
#endif
#ifdef DUST
    facing *= dustShare(fromEye);
#endif
#ifdef LAMPS
    sky += lampLight(fromEye, normal);
#endif
    colour = vec4(throughAir(albedo * (sun.rgb * facing + sky), fromEye), 1.0);
}
