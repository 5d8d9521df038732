// The number of particles after this step's deaths and births, and the work groups that follow from it.
layout(std430, binding = 9) readonly buffer Deaths { uint deaths; };

uvec3 groupsOf(uint elements) {
    return uvec3((elements + 255u) / 256u, 1u, 1u);
}

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    uint born = numbers.x;
    before = count;
    count = before + born - deaths;
    burials = max(deaths, born) - born;
    uvec3 all = groupsOf(count), dead = groupsOf(burials);
    groups = uint[3](all.x, all.y, all.z);
    burialGroups = uint[3](dead.x, dead.y, dead.z);
}
