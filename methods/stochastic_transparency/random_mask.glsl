/// Four random words of a counter, Philox4x32-10. Source: Salmon2011, section 3.3.
uvec4 randomWords(uvec2 key, uvec4 counter) {
    for (int round = 0; round < 10; ++round) {
        uint high0, low0, high1, low1;
        umulExtended(0xD2511F53u, counter.x, high0, low0);
        umulExtended(0xCD9E8D57u, counter.z, high1, low1);
        counter = uvec4(high1 ^ counter.y ^ key.x, low1, high0 ^ counter.w ^ key.y, low0);
        key += uvec2(0x9E3779B9u, 0xBB67AE85u);
    }
    return counter;
}

/// Samples that a surface covers, a bit each.
/// Source: EndertonEtAl2010, section 3.1 (stratified: ⌊α·S + ξ⌋ of S samples; else each with probability α).
uvec2 randomMask(uvec2 key, uvec2 serial, float alpha) {
    uvec2 mask = uvec2(0);
    uvec4 words = randomWords(key, uvec4(serial, STREAM, 0));
#if STRATIFIED == 1
    int wanted = int(floor(alpha * float(SAMPLES) + float(words.x >> 8) / 16777216.0));
    if (wanted == 0) return mask;
#endif
    for (int s = 0; s < SAMPLES; ++s) {
        if (s % 4 == 0) words = randomWords(key, uvec4(serial, STREAM, 1 + s / 4));
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
