// The trees of a sparse volume in one buffer, for PNanoVDB.h, which is included next.
#define PNANOVDB_GLSL
#define PNANOVDB_ADDRESS_32
layout(std430, binding = 0) readonly buffer Trees {
    uint pnanovdb_buf_data[];
};
