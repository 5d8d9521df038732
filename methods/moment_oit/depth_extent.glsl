// The range of distances that moments are taken in: depthRange of moment_oit.cpp for dust in GPU buffers.
vec2 extentOf(float axisMetres, float metres, float deviationMetres, float nearMetres) {
#ifdef SURFACE
    return axisMetres < nearMetres ? vec2(0, -1) : vec2(axisMetres);
#else
    float reach = 3.0 * deviationMetres;
    return axisMetres < -reach ? vec2(0, -1) : vec2(metres - reach, metres + reach);
#endif
}

vec2 mappingOf(float nearestMetres, float farthestMetres, float nearMetres) {
    float from = max(nearestMetres <= farthestMetres ? nearestMetres : 0.0, nearMetres);
    float to = max(farthestMetres, 1.01 * from);
#ifdef WARP_LOG
    from = log(from), to = log(to);
#endif
    return vec2(from, 2.0 / (to - from));
}
