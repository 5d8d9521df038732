// The newborns of a step. They take the places of the dead, in order; the rest follow the last particle.
layout(std430, binding = 9) readonly buffer Holes { uint holes[]; };
layout(std430, binding = 10) readonly buffer Deaths { uint deaths; };

const uint positionStream = 1u, velocityStream = 2u, lifeStream = 3u, colourStream = 5u;

uvec2 serialOf(uint newborn) {
    uint carry, low = uaddCarry(key.z, newborn, carry);
    return uvec2(low, key.w + carry);
}
/// serial / divisor, by long division.
uvec2 quotient(uvec2 serial, uint divisor) {
    if (serial.y == 0u) return uvec2(serial.x / divisor, 0u);
    uint high = serial.y / divisor, rest = serial.y % divisor, low = 0u;
    for (int bit = 31; bit >= 0; --bit) {
        bool over = (rest & 0x80000000u) != 0u;
        rest = rest << 1 | (serial.x >> bit & 1u);
        low <<= 1;
        if (over || rest >= divisor) rest -= divisor, low |= 1u;
    }
    return uvec2(low, high);
}
uint remainder(uvec2 serial, uint divisor) {
    uvec2 whole = quotient(serial, divisor);
    return serial.x - whole.x * divisor;
}

void main() {
    uint newborn = gl_GlobalInvocationID.x;
    if (newborn >= numbers.x) return;
    uvec2 serial = serialOf(newborn);
    uint e = remainder(serial, numbers.y);
    precise double at = births.x + double(newborn) * births.y;
    precise double born = clamp(at, 0.0lf, seconds.x);
    precise double lived = seconds.x - born, part = born / seconds.x;
    float age = float(lived), moment = float(part);

    vec4 u = uniform4(positionStream, serial);
    precise vec3 place = from[e].xyz * (1.0 - moment) + to[e].xyz * moment;
    if (source.x >= 0.0) {
        precise float fromCentre = sqrt(u.x);
        precise float x = source.x * (fromCentre * cosineOfTurns(u.y));
        precise float z = source.x * (fromCentre * sineOfTurns(u.y));
        precise vec3 onDisc = place + x * discFirst[e].xyz + z * discSecond[e].xyz;
        place = onDisc;
    }

    vec4 v = uniform4(velocityStream, serial);
    vec3 local = coneDirection(v.x, v.y);
    precise vec3 direction = local.x * forward[e].xyz + local.y * up[e].xyz + local.z * right[e].xyz;
    precise float speed = (source.y + source.z * forward[e].w) * (1.0 + source.w * centred(v.z));
    precise vec3 carrier = velocityFrom[e].xyz * (1.0 - moment) + velocityTo[e].xyz * moment;
    precise vec3 thrown = speed * direction + cone.w * carrier;
    precise vec3 drifted = place + thrown * age;

    precise float lifetime = life.x + life.y * centred(uniform4(lifeStream, serial).x);
    float share = shareOfLife(age, lifetime), r = radiusAt(share);
    vec3 position = drifted, velocity = thrown;
    touch(r, position, velocity);

    uint i = newborn < deaths ? holes[newborn] : before + (newborn - deaths);
    setVectors(i, position, velocity);
    lives[2u * i] = age;
    lives[2u * i + 1u] = lifetime;
    looks[2u * i] = r;
    looks[2u * i + 1u] = opacityAt(share);
    serials[2u * i] = serial.x;
    serials[2u * i + 1u] = serial.y;
#ifdef COLOURED
    if (life.w == 1.0) {
        for (uint channel = 0u; channel < 3u; ++channel) colours_[3u * i + channel] = colourAt(share, channel);
    } else {
        bool isSecond = uniform4(colourStream, quotient(serial, numbers.z)).x < colours[0].w;
        vec3 colour = isSecond ? colours[1].xyz : colours[0].xyz;
        for (uint channel = 0u; channel < 3u; ++channel) colours_[3u * i + channel] = colour[channel];
    }
#endif
}
