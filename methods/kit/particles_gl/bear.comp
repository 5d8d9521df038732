// The newborns of a step. They take the places of the dead, in order; the rest follow the last particle.
layout(std430, binding = 9) readonly buffer Holes { uint holes[]; };
layout(std430, binding = 10) readonly buffer Deaths { uint deaths; };

const uint positionStream = 1u, velocityStream = 2u, lifeStream = 3u, sizeStream = 4u, colourStream = 5u;

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

vec3 placeOf(uint e, uvec2 serial, vec3 place) {
    vec4 u = uniform4(positionStream, serial);
    precise float first = 0.0, second = 0.0;
    if (kinds.x == discSource) {
        precise float fromCentre = sqrt(u.x);
        first = source.x * (fromCentre * cosineOfTurns(u.y));
        second = source.x * (fromCentre * sineOfTurns(u.y));
    } else if (kinds.x == rectangleSource) {
        first = (u.x - 0.5) * source.x;
        second = (u.y - 0.5) * source.y;
    } else if (kinds.x == lineSource) {
        first = (source.y + u.x) * source.x;
        precise vec3 onLine = place + first * sourceFirst[e].xyz;
        return onLine;
    } else if (kinds.x == ballSource) {
        precise vec3 local =
            source.x * (max(max(u.z, u.w), uniform4(positionStream, serial, 1u).x) * sphereDirection(u.x, u.y));
        precise vec3 world = local.x * forward[e].xyz + local.y * up[e].xyz + local.z * right[e].xyz;
        precise vec3 inBall = place + world;
        return inBall;
    } else {
        return place;
    }
    precise vec3 onSource = place + first * sourceFirst[e].xyz + second * sourceSecond[e].xyz;
    return onSource;
}

vec3 velocityOf(uint e, uvec2 serial, vec3 carrier) {
    vec4 v = uniform4(velocityStream, serial);
    if (kinds.y == coneVelocity) {
        vec3 local = coneDirection(v.x, v.y);
        precise vec3 direction = local.x * forward[e].xyz + local.y * up[e].xyz + local.z * right[e].xyz;
        precise float speed = (launch.x + launch.y * forward[e].w) * (1.0 + launch.z * centred(v.z));
        precise vec3 thrown = speed * direction + cone.w * carrier;
        return thrown;
    }
    precise float speed = launch.x + centred(v.w) * launch.z;
    vec3 local = coneFrame[0].xyz;
    precise vec3 along = local.x * forward[e].xyz + local.y * up[e].xyz + local.z * right[e].xyz;
    precise vec3 thrown = speed * (kinds.y == randomVelocity ? sphereDirection(v.x, v.y) : along);
    return thrown;
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

    precise vec3 centre = from[e].xyz * (1.0 - moment) + to[e].xyz * moment;
    vec3 place = placeOf(e, serial, centre);
    precise vec3 carrier = velocityFrom[e].xyz * (1.0 - moment) + velocityTo[e].xyz * moment;
    vec3 thrown = velocityOf(e, serial, carrier);
    precise vec3 drifted = place + thrown * age;

    precise float lifetime = life.x + life.y * centred(uniform4(lifeStream, serial).x);
    float share = shareOfLife(age, lifetime);
    precise float random = radius.x + radius.y * centred(uniform4(sizeStream, serial).x);
    float r = kinds.z == randomSize ? random : radiusAt(share);
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
