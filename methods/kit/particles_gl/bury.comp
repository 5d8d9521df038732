// Moves the last living particles, in order, to the places of the dead that no newborn has taken.
layout(std430, binding = 9) readonly buffer Survivors { uint survivors[]; };
layout(std430, binding = 10) readonly buffer Holes { uint holes[]; };
layout(std430, binding = 11) readonly buffer Moved { uint moved; };

void main() {
    uint k = gl_GlobalInvocationID.x;
    if (k >= moved) return;
    uint from = survivors[k], to = holes[numbers.x + k];
    setVectors(to, vectorAt(from, false), vectorAt(from, true));
    for (uint word = 0u; word < 2u; ++word) {
        lives[2u * to + word] = lives[2u * from + word];
        looks[2u * to + word] = looks[2u * from + word];
        serials[2u * to + word] = serials[2u * from + word];
    }
#ifdef COLOURED
    for (uint channel = 0u; channel < 3u; ++channel) colours_[3u * to + channel] = colours_[3u * from + channel];
#endif
}
