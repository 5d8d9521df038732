// Light from lamps at a point of the opaque scene. LAMPS: the scene has any; the uniforms are those of opaque_moment.h.
#ifdef LAMPS
struct Lamp {
    vec4 place;  // relative to the eye; w: its radius, squared
    vec4 intensity;
};
layout(std140, binding = 1) uniform Lamps {
    ivec4 lampCount;
    Lamp lamps[MAXIMUM_LAMPS];
};

// E = Σ I·cos θ/d²; a lamp's radius limits it at close range.
vec3 lampLight(vec3 fromEye, vec3 normal) {
    vec3 light = vec3(0.0);
    for (int i = 0; i < lampCount.x; ++i) {
        vec3 towards = lamps[i].place.xyz - fromEye;
        float distance2 = max(dot(towards, towards), lamps[i].place.w);
        light += lamps[i].intensity.rgb * (max(dot(towards, normal), 0.0) * inversesqrt(distance2) / distance2);
    }
    return light;
}
#endif
