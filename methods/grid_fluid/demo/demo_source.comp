// Adds a source to the cells that it reaches: a ball with a soft edge. Source: Senger2009, 4.3.
layout(binding = 0, rgba16f) restrict uniform image3D velocity;
layout(binding = 1, r16f) restrict uniform image3D density;
layout(binding = 2, r16f) restrict uniform image3D temperature;
uniform ivec3 first, last;
uniform vec3 centre, speed;
uniform float perRadius, addedDensity, addedKelvin, reaction, taken;

void main() {
    ivec3 c = first + ivec3(gl_GlobalInvocationID);
    if (any(greaterThan(c, last)) || isSolid(c)) return;
    vec3 d = (vec3(c) - centre) * perRadius;
    float strength = exp(-0.5 * dot(d, d));
    vec4 u = imageLoad(velocity, c);
    imageStore(velocity, c, vec4(u.xyz + strength * taken * (speed - u.xyz), max(u.w, strength * reaction)));
    imageStore(density, c, imageLoad(density, c) + strength * addedDensity);
    imageStore(temperature, c, imageLoad(temperature, c) + strength * addedKelvin);
}
