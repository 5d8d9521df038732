// Fraction of the sun's light that reaches a point through the dust; see shadow_map.h.
#ifdef DUST
layout(binding = 5) uniform sampler2D dustColumns;

float dustShare(vec3 fromEye) {
    vec3 place = (eyeToDust * vec4(fromEye, 1.0)).xyz;
    vec3 column = texture(dustColumns, place.xy).xyz;
    if (column.x < 1e-4) return 1.0;
    float middle = column.y / column.x;
    float spread = max(column.z / column.x - middle * middle, 1e-6);
    float towardsSun = 0.5 - 0.5 * errorFunction((place.z - middle) * inversesqrt(2.0 * spread));
    return exp(-column.x * towardsSun);
}
#endif
