// Sources: balls with a soft edge, as in flow::SourceReach.
struct Source {
    ivec4 first, last;            // cells that it reaches
    ivec4 middle;                 // a cell near the centre; w: 1 if `amount` is the total
    vec4 offset;                  // from there to the centre; w: one over the radius
    vec4 velocity;                // w: share that the air adopts
    float density, kelvin, reaction, amount;  // at the centre; `amount`: sum over all cells
};
layout(std430, binding = 3) restrict readonly buffer Sources { Source sources[]; };

// `place` in cells; centres are at whole numbers.
float strengthAt(vec3 place, int s) {
    vec3 d = (place - vec3(sources[s].middle.xyz) - sources[s].offset.xyz) * sources[s].offset.w;
    return exp(-0.5 * dot(d, d));
}
