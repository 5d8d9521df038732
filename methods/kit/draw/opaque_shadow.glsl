// Fraction of the sun's light that reaches a point. VEHICLE and SOLIDS mark the casters of the scene.
#ifdef VEHICLE
layout(binding = 2) uniform sampler2DShadow vehicleShadow;
#endif
#ifdef SOLIDS
layout(binding = 3) uniform sampler2DShadow solidShadow;
#endif

// Points beyond the map's far end are behind all casters: depths below 0 count as 0.
// The vehicle's texels are as fine as the pixels, so one bilinear comparison suffices.
float sharpShare(sampler2DShadow map, vec3 place) {
    return texture(map, vec3(place.xy, max(place.z, 0.0)));
}

// The solids' texels are coarser: two comparisons, offset diagonally, hide the steps.
float softShare(sampler2DShadow map, vec3 place) {
    vec2 aside = vec2(0.7, 0.3) / vec2(textureSize(map, 0));
    float depth = max(place.z, 0.0);
    float share = 0.5 * (texture(map, vec3(place.xy + aside, depth)) + texture(map, vec3(place.xy - aside, depth)));
    vec2 off = abs(place.xy - 0.5);  // outside the map shadows are unknown, and everything is lit
    return max(share, smoothstep(0.44, 0.49, max(off.x, off.y)));
}

// `lift`: offset along the normal, in shadow texels, that prevents self-shadowing.
float sunShare(vec3 fromEye, vec3 normal, float lift) {
    float share = 1.0;
#ifdef VEHICLE
    vec3 offVehicle = fromEye + normal * (lift * shadowTexels.x);
    share = min(share, sharpShare(vehicleShadow, (eyeToVehicleShadow * vec4(offVehicle, 1.0)).xyz));
#endif
#ifdef SOLIDS
    vec3 offSolid = fromEye + normal * (lift * shadowTexels.y);
    share = min(share, softShare(solidShadow, (eyeToSolidShadow * vec4(offSolid, 1.0)).xyz));
#endif
    return share;
}

// Fraction of the sky that is visible from the ground next to and below the vehicle.
float skyShare(vec3 fromEye) {
#ifdef VEHICLE
    vec3 own = (eyeToVehicle * vec4(fromEye, 1.0)).xyz;
    vec2 beyond = max(abs(own.xz - underside.xy) - underside.zw, 0.0);
    float near = clamp(1.0 - length(beyond) / 0.7, 0.0, 1.0);
    return 1.0 - 0.8 * near * near * clamp(1.0 - abs(own.y), 0.0, 1.0);
#else
    return 1.0;
#endif
}
