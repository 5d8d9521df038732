// Moves all quantities by whole cells; new cells start with the wind.
layout(std430, binding = 1) restrict readonly buffer Moving { vec4 moving[]; };
layout(std430, binding = 2) restrict readonly buffer Carried { vec2 carried[]; };
layout(std430, binding = 3) restrict writeonly buffer MovingThen { vec4 movingThen[]; };
layout(std430, binding = 4) restrict writeonly buffer CarriedThen { vec2 carriedThen[]; };
uniform ivec3 by;
uniform vec3 wind;

void main() {
    ivec3 c = ivec3(gl_GlobalInvocationID);
    if (!inside(c)) return;
    bool had = inside(c + by);
    movingThen[at(c)] = had ? moving[at(c + by)] : vec4(wind, 0);
    carriedThen[at(c)] = had ? carried[at(c + by)] : vec2(0);
}
