// philox: kit/gpu/philox.glsl.

/// Samples that a surface covers, a bit each.
/// Source: EndertonEtAl2010, section 3.1 (stratified: ⌊α·S + ξ⌋ of S samples; else each with probability α).
uvec2 randomMask(uvec2 key, uvec2 serial, float alpha) {
    uvec2 mask = uvec2(0);
    uvec4 words = philox(key, uvec4(serial, STREAM, 0));
#if STRATIFIED == 1
    int wanted = int(floor(alpha * float(SAMPLES) + float(words.x >> 8) / 16777216.0));
    if (wanted == 0) return mask;
#endif
    for (int s = 0; s < SAMPLES; ++s) {
        if (s % 4 == 0) words = philox(key, uvec4(serial, STREAM, 1 + s / 4));
        float uniform01 = float(words[s % 4] >> 8) / 16777216.0;
#if STRATIFIED == 1
        // Every set of `wanted` samples is equally likely.
        bool covered = uniform01 * float(SAMPLES - s) < float(wanted);
        if (covered) --wanted;
#else
        bool covered = uniform01 < alpha;
#endif
        if (covered) mask[s / 32] |= 1u << (s % 32);
    }
    return mask;
}
