// Confinement, buoyancy in proportion to 1/T0 - 1/T, and the burning of the reaction. Source: Crane2007, 30.2;
// Fedkiw2001, Eq. 11; Senger2009, Eq. 7.
layout(binding = 0) uniform sampler3D velocity;
layout(binding = 1) uniform sampler3D curl;
layout(binding = 2) uniform sampler3D density;
layout(binding = 3) uniform sampler3D temperature;
layout(binding = 0, rgba16f) restrict writeonly uniform image3D result;
uniform float confinement, lift, weight, airKelvin, lost;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    vec4 u = texelFetch(velocity, c, 0);
    if (!isSolid(c)) {
        vec3 g;
        for (int axis = 0; axis < 3; ++axis) g[axis] = at(curl, c + unit(axis)).w - at(curl, c - unit(axis)).w;
        u.xyz += confinement / sqrt(dot(g, g) + 1e-12) * cross(g, texelFetch(curl, c, 0).xyz);
        float warmer = texelFetch(temperature, c, 0).r;
        u.y += lift * airKelvin * warmer / (airKelvin + warmer) - weight * texelFetch(density, c, 0).r;
        u.w = max(u.w - lost, 0.0);
    }
    imageStore(result, c, u);
}
