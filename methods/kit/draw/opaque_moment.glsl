// The uniforms of opaque_moment.h, and functions that depend on them only: sky and air.
layout(std140, binding = 0) uniform Moment {
    mat4 eyeToClip;
    mat4 clipToEye;
    mat4 eyeToVehicleShadow;
    mat4 eyeToSolidShadow;
    mat4 eyeToVehicle;
    mat4 eyeToDust;
    vec4 toSun;
    vec4 sun;
    vec4 ambient;
    vec4 groundLight;
    vec4 skyZenith;
    vec4 skyHorizon;  // w: extinction per metre
    vec4 shadowTexels;
    vec4 underside;
};

// Light scattered forwards by the air: a halo around the sun, half as bright 9° away from it.
vec3 sunHalo(vec3 direction) {
    return sun.rgb * (0.35 / (1.0 + 80.0 * (1.0 - dot(direction, toSun.xyz))));
}

// Directions below the horizon get the horizon's colour.
vec3 skyColour(vec3 direction) {
    float clear = 1.0 - max(direction.y, 0.0);
    float thickness = clear * clear * clear;
    return mix(skyZenith.rgb, skyHorizon.rgb, thickness * thickness) + sunHalo(direction);
}

// Beer–Lambert: T = exp(−k d); in-scattered light of the air replaces the absorbed light.
vec3 throughAir(vec3 colour, vec3 fromEye) {
    float inverseDistance = inversesqrt(dot(fromEye, fromEye));
    float transmittance = exp2(-1.442695 * skyHorizon.w / inverseDistance);
    return mix(skyHorizon.rgb + sunHalo(fromEye * inverseDistance), colour, transmittance);
}
