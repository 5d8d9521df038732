// The parts of a particle system that every particle passes through in each step: colour, size and forces.
//
// Each function repeats the operations of its part in kit/particles/parts, in their order and without contraction.

layout(std430, binding = 8) readonly buffer Heights { float heights[]; };

const uint pointSource = 0u, discSource = 1u, rectangleSource = 2u, lineSource = 3u, ballSource = 4u;
const uint coneVelocity = 0u, randomVelocity = 1u, fixedVelocity = 2u;
const uint sizeByAge = 0u, randomSize = 1u;
const uint windForce = 1u, gravityForce = 2u, constantForce = 3u, dragForce = 4u, groundForce = 5u;

uint kindOf(uint force) {
    return uint(forces[4u * force].x);
}

float shareOfLife(float age, float lifetime) {
    precise float lived = age / lifetime;
    return lived < 1.0 ? lived : 1.0;
}
float opacityAt(float share) {
    precise float value = opacity.x + share * (opacity.y + share * (opacity.z + share * opacity.w));
    return life.z == 1.0 && !(value > 0.0) ? 0.0 : value;
}
float colourAt(float share, uint channel) {
    vec4 curve = colourCurves[channel];
    precise float value = curve.x + share * (curve.y + share * (curve.z + share * curve.w));
    return value > 0.0 ? value : 0.0;
}
float radiusAt(float share) {
    precise float value = radius.x + radius.y * share;
    return value;
}

float wave(uint force, int j, float along) {
    precise float turns = forces[4u * force + 1u][j] * along + forces[4u * force + 2u][j];
    precise float r = turns - roundToInteger(turns);
    precise float value = forces[4u * force + 3u][j] * (16.0 * (r * (0.5 - abs(r))));
    return value;
}
/// The scene's wind with gusts (kit/maths/turbulence.h).
vec3 windAt(uint force, vec3 p) {
    precise float sum = p.y + p.z, difference = p.y - p.z;
    precise float a0 = p.x + sum, a1 = p.x - sum, a2 = p.x - difference, a3 = p.x + difference;
    precise float w0 = wave(force, 0, a0), w1 = wave(force, 1, a1), w2 = wave(force, 2, a2), w3 = wave(force, 3, a3);
    precise vec3 gust = vec3((w0 + w2) + w3, w1 + w2, (w3 - w0) - w1);
    precise vec3 wind = forces[4u * force].yzw + gust;
    return wind;
}

vec3 accelerationAt(vec3 position, vec3 velocity) {
    precise vec3 air = vec3(0), acceleration = vec3(0);
    for (uint force = 0u; force < numbers.w; ++force)
        if (kindOf(force) == windForce) air += windAt(force, position);
    for (uint force = 0u; force < numbers.w; ++force) {
        vec4 values = forces[4u * force];
        if (kindOf(force) == gravityForce) acceleration.y -= values.y;
        if (kindOf(force) == constantForce) acceleration += values.yzw;
        if (kindOf(force) == dragForce) acceleration += values.y * (air - velocity);
    }
    return acceleration;
}

/// Height and slopes of the bilinear ground below.
vec3 groundBelow(float x, float z) {
    vec2 last = vec2(samples.xy - 1);
    precise vec2 grid = (vec2(x, z) - ground.xy) / ground.z;
    vec2 held = min(max(grid, vec2(0)), last);
    ivec2 cell = ivec2(min(held, last - 1.0));
    precise vec2 uv = held - vec2(cell);
    int at = cell.y * samples.x + cell.x;
    float h00 = heights[at], h10 = heights[at + 1];
    float h01 = heights[at + samples.x], h11 = heights[at + samples.x + 1];
    precise float near = h00 + uv.x * (h10 - h00), far = h01 + uv.x * (h11 - h01);
    precise float alongX = (h10 - h00) * (1.0 - uv.y) + (h11 - h01) * uv.y;
    precise float height = near + uv.y * (far - near), perSpacing = 1.0 / ground.z;
    precise float slopeX = alongX * (held.x == grid.x ? perSpacing : 0.0);
    precise float slopeZ = (far - near) * (held.y == grid.y ? perSpacing : 0.0);
    return vec3(height, slopeX, slopeZ);
}

void touchGround(uint force, float r, inout vec3 position, inout vec3 velocity) {
    float lift = forces[4u * force].y, kept = forces[4u * force].z;
    vec3 below = samples.x > 0 ? groundBelow(position.x, position.z) : vec3(0);
    precise float floorY = below.x + lift * r;
    if (!(position.y < floorY)) return;
    position.y = floorY;
    precise float into = velocity.y - below.y * velocity.x - below.z * velocity.z;
    precise float taken = min(into, 0.0) / (1.0 + below.y * below.y + below.z * below.z);
    precise vec3 left =
        kept * vec3(velocity.x + taken * below.y, velocity.y - taken, velocity.z + taken * below.z);
    velocity = left;
}
void touch(float r, inout vec3 position, inout vec3 velocity) {
    for (uint force = 0u; force < numbers.w; ++force)
        if (kindOf(force) == groundForce) touchGround(force, r, position, velocity);
}
