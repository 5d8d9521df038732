// Random numbers and sampling with the same bits as on the CPU: kit/gpu/philox.glsl, kit/maths/fast_functions.h and
// sampling.h.
//
// Source: Salmon2011, sections 3.3 and 5.

vec4 uniform4(uint stream, uvec2 serial, uint draw) {
    return vec4(philox(key.xy, uvec4(serial, stream, draw)) >> 8) * (1.0 / 16777216.0);
}
vec4 uniform4(uint stream, uvec2 serial) { return uniform4(stream, serial, 0u); }
float centred(float u) {
    precise float value = 2.0 * u - 1.0;
    return value;
}

float roundToInteger(float v) {
    precise float shifted = v + 12582912.0;
    precise float whole = shifted - 12582912.0;
    return whole;
}
float sineOfQuarter(float f) {
    precise float f2 = f * f;
    precise float sine =
        f * (6.28318501 + f2 * (-41.34165573 + f2 * (81.60100555 + f2 * (-76.54977417 + f2 * 39.53666306))));
    return sine;
}
float sineOfTurns(float turns) {
    precise float r = turns - roundToInteger(turns);
    precise float rising = abs(r), falling = 0.5 - rising;
    float folded = rising < falling ? rising : falling;
    return sineOfQuarter(r < 0.0 ? -folded : folded);
}
float cosineOfTurns(float turns) {
    precise float rest = turns - roundToInteger(turns);
    precise float folded = 0.25 - abs(rest);
    return sineOfQuarter(folded);
}

/// Any direction.
vec3 sphereDirection(float u, float v) {
    precise float z = 1.0 - 2.0 * u;
    precise float r = sqrt(max(0.0, 1.0 - z * z));
    precise vec3 direction = vec3(r * cosineOfTurns(v), r * sineOfTurns(v), z);
    return direction;
}

/// A direction within the cone of the velocity part, in the emitter's frame.
vec3 coneDirection(float u, float v) {
    precise float cosine, sine;
    if (cone.z == 1.0) {
        precise float angle = sqrt(u) * cone.y;
        cosine = cosineOfTurns(angle);
        sine = sineOfTurns(angle);
    } else {
        precise float depth = u * cone.x;
        cosine = 1.0 - depth;
        sine = sqrt(max(0.0, depth * (2.0 - depth)));
    }
    precise float first = sine * cosineOfTurns(v), second = sine * sineOfTurns(v);
    precise vec3 direction = first * coneFrame[0].xyz + second * coneFrame[1].xyz + cosine * coneFrame[2].xyz;
    return direction;
}
