// The range of distances that wavelets span: depthRange of wavelet_oit.cpp for dust in GPU buffers.
vec2 extentOf(float axisMetres, float metres, float deviationMetres, float nearMetres) {
#ifdef VOLUME
    float reach = 3.0 * deviationMetres;
    return axisMetres < -reach ? vec2(0, -1) : vec2(sqrt(max(metres * metres - reach * reach, 0.0)), metres);
#else
    return axisMetres < nearMetres ? vec2(0, -1) : vec2(axisMetres);
#endif
}

vec2 mappingOf(float nearestMetres, float farthestMetres, float nearMetres) {
    float from = max(nearestMetres < farthestMetres ? nearestMetres : farthestMetres, nearMetres);
    float to = max(farthestMetres, 1.001 * from);
#ifdef WARP_LOG
    from = log(from), to = log(to);
#endif
    return vec2(from, (1.0 - 1.0 / float(2 << RANK)) / (to - from));
}
