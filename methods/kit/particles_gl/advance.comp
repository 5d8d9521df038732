// One step of every living particle: age, death, look, forces, motion, contact. Source: Thesis, 3.3.2 and 5.1.
layout(std430, binding = 9) writeonly buffer Dead { uint dead[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    float seconds = radius.z;
    precise float age = lives[2u * i] + seconds;
    float lifetime = lives[2u * i + 1u], share = shareOfLife(age, lifetime);
    lives[2u * i] = age;
    dead[i] = age > lifetime ? 1u : 0u;
    float r = kinds.z == randomSize ? looks[2u * i] : radiusAt(share);
    looks[2u * i] = r;
    looks[2u * i + 1u] = opacityAt(share);
#ifdef COLOURED
    if (life.w == 1.0)
        for (uint channel = 0u; channel < 3u; ++channel) colours_[3u * i + channel] = colourAt(share, channel);
#endif

    vec3 position = vectorAt(i, false), velocity = vectorAt(i, true);
    vec3 acceleration = accelerationAt(position, velocity);
    precise vec3 faster = velocity + acceleration * seconds;
    precise vec3 moved = position + faster * seconds;
    position = moved, velocity = faster;
    touch(r, position, velocity);
    setVectors(i, position, velocity);
}
