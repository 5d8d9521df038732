// Unsigned keys in the order of floats that are not NaN; both zeros have one key. Equals sortableKey of radix_sort.h.
uint sortableKey(float value) {
    uint bits = floatBitsToUint(value);
    if (bits == 0x80000000u) bits = 0u;
    return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}
