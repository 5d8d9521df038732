// The four digits of a key, 8 bits each; a thread of a work group for each value of a digit.
uniform int place;  // of the current digit, 0 to 3

const uint values = 256u, places = 4u;
const uint tileKeys = threads * KEYS_PER_THREAD;

uint digitAt(uint key, uint at) {
    return key >> (8u * at) & (values - 1u);
}
uint digitOf(uint key) {
    return digitAt(key, uint(place));
}
