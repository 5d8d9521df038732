// Mean extinction of each texel's cells, expressed as an equivalent density of smoke. See light_volume.h.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(binding = 0, r32f) restrict writeonly uniform image3D averages;
layout(binding = 1) uniform sampler3D density;
#ifdef FIRE
layout(binding = 3) uniform sampler3D reaction;
layout(binding = 4) uniform sampler2D fire;  // extinction factor by reaction, in alpha
#endif
uniform int texelCells;

float effective(ivec3 cell) {
    float found = texelFetch(density, cell, 0).r;
#ifdef FIRE
    float fresh = clamp(texelFetch(reaction, cell, 0).r, 0.0, 1.0);
    found *= texelFetch(fire, ivec2(fresh * (FIRE_TEXELS - 1.0) + 0.5, 0), 0).a;
#endif
    return found;
}

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, imageSize(averages)))) return;
    ivec3 from = texel * texelCells, to = min(from + texelCells, textureSize(density, 0));
    float sum = 0.0;
    for (int z = from.z; z < to.z; ++z)
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x; ++x) sum += effective(ivec3(x, y, z));
    ivec3 size = to - from;
    imageStore(averages, texel, vec4(sum / float(size.x * size.y * size.z)));
}
