// One step of each particle of a relief: motion, collision along the path, age. The reference implementation is
// particles/relief_particles.cpp; `precise` and double keep the results the same.
layout(local_size_x = 64) in;

layout(binding = 0) uniform sampler2D places;      // x, y, z, age in steps
layout(binding = 1) uniform sampler2D velocities;  // x, y, z, fate
layout(rgba32f, binding = 0) writeonly uniform image2D nextPlaces;
layout(rgba32f, binding = 1) writeonly uniform image2D nextVelocities;
layout(std430, binding = 1) readonly buffer Plate { dvec4 halfSize, scale, offset; };
layout(std430, binding = 2) readonly buffer Depths { uint depths[]; };
layout(std430, binding = 3) readonly buffer Sources { int sources[]; };  // a texel, or −1 − k: newborn k
layout(std430, binding = 4) readonly buffer Newborns { vec4 newborns[]; };  // place and velocity of each
uniform vec2 texels;
uniform int particles, paperLaw;
uniform vec3 gravity;
uniform float stepSeconds, maximumAge;

const float lives = 0.0, hit = 1.0, gone = 2.0;
const double never = 2.0LF;
const double bottom = 1073741824.0LF;  // DepthMap::bottom

ivec2 texelOf(int n) { return ivec2(n % STATE_COLUMNS, n / STATE_COLUMNS); }

double depthOf(ivec2 texel) {
    ivec2 size = ivec2(texels);
    ivec2 inside = clamp(texel, ivec2(0), size - 1);
    return double(depths[inside.y * size.x + inside.x]) / bottom;
}

// The share of the path at which it leaves the plate, through a rim or the face.
double exitShare(dvec3 from, dvec3 way) {
    double share = 1e30LF;
    for (int axis = 0; axis < 2; ++axis)
        if (way[axis] != 0.0LF)
            share = min(share, ((way[axis] > 0.0LF ? halfSize[axis] : -halfSize[axis]) - from[axis]) / way[axis]);
    if (way.z > 0.0LF) share = min(share, -from.z / way.z);
    return max(share, 0.0LF);
}

double valueAt(dvec3 quadratic, double t) { return (quadratic.x * t + quadratic.y) * t + quadratic.z; }

// The first t in [begin, end] with a·t² + b·t + c ≥ 0.
double firstNotNegative(dvec3 quadratic, double begin, double end) {
    if (valueAt(quadratic, begin) >= 0.0LF) return begin;
    double a = quadratic.x, b = quadratic.y, c = quadratic.z;
    double first = never, discriminant = b * b - 4.0LF * a * c;
    if (a == 0.0LF) {
        double root = b != 0.0LF ? -c / b : never;
        if (root >= begin && root <= end) first = root;
    } else if (discriminant >= 0.0LF) {
        double q = -0.5LF * (b + (b < 0.0LF ? -1.0LF : 1.0LF) * sqrt(discriminant));
        double one = q / a, other = q != 0.0LF ? c / q : never;
        if (one >= begin && one <= end) first = one;
        if (other >= begin && other <= end) first = min(first, other);
    }
    if (first == never && valueAt(quadratic, end) >= 0.0LF) first = end;  // a root lost to rounding
    return first;
}

// Coefficients of d(t) − D(t) within the patch whose lower left texel is `corner`.
dvec3 gap(ivec2 corner, dvec3 from, dvec3 way) {
    dvec3 start = from - dvec3(corner, 0);
    double base = depthOf(corner), right = depthOf(corner + ivec2(1, 0)), upper = depthOf(corner + ivec2(0, 1));
    double alongU = right - base, alongV = upper - base;
    double twist = depthOf(corner + ivec2(1, 1)) - right - upper + base;
    return dvec3(-twist * way.x * way.y,
                 way.z - alongU * way.x - alongV * way.y - twist * (start.x * way.y + start.y * way.x),
                 start.z - base - alongU * start.x - alongV * start.y - twist * start.x * start.y);
}

// The first share of the path at which it meets the surface, patch by patch; `never` if it does not.
double firstHit(dvec3 from, dvec3 to) {
    dvec3 way = to - from;
    ivec2 cell = ivec2(floor(from.xy)), stepTo;
    dvec2 next, spacing;
    for (int axis = 0; axis < 2; ++axis) {
        bool ahead = way[axis] > 0.0LF, rests = way[axis] == 0.0LF;
        stepTo[axis] = ahead ? 1 : -1;
        next[axis] = rests ? 1e30LF : (double(ahead ? cell[axis] + 1 : cell[axis]) - from[axis]) / way[axis];
        spacing[axis] = rests ? 1e30LF : 1.0LF / abs(way[axis]);
    }
    double begin = 0.0LF;
    int most = int(abs(way.x)) + int(abs(way.y)) + 4;
    for (int n = 0; n < most; ++n) {
        double end = min(min(next.x, next.y), 1.0LF);
        double found = firstNotNegative(gap(cell, from, way), begin, max(begin, end));
        if (found != never) return found;
        if (end >= 1.0LF) return never;
        begin = max(begin, end);
        int axis = next.x < next.y ? 0 : 1;
        cell[axis] += stepTo[axis];
        next[axis] += spacing[axis];
    }
    return never;
}

void moved(inout vec3 place, inout vec3 velocity, float age) {
    float dt = stepSeconds, t = age * dt;
    precise vec3 newPlace, newVelocity;
    if (paperLaw == 1) {
        newPlace = place + velocity * t + gravity * (0.5 * t * t);
        newVelocity = (velocity + gravity * dt) * age;
    } else {
        newPlace = place + velocity * dt + gravity * (0.5 * dt * dt);
        newVelocity = velocity + gravity * dt;
    }
    place = newPlace;
    velocity = newVelocity;
}

void main() {
    int n = int(gl_GlobalInvocationID.x);
    if (n >= particles) return;
    int source = sources[n], newborn = -1 - source;
    vec4 oldPlace = source < 0 ? newborns[2 * newborn] : texelFetch(places, texelOf(source), 0);
    vec3 velocity = (source < 0 ? newborns[2 * newborn + 1] : texelFetch(velocities, texelOf(source), 0)).xyz;
    vec3 place = oldPlace.xyz;
    float age = oldPlace.w + 1.0, fate = lives;
    moved(place, velocity, age);

    dvec3 from = dvec3(oldPlace.xyz), way = dvec3(place) - from;
    float reach = abs(place.x) + abs(place.y) + abs(place.z);
    if (isnan(reach) || isinf(reach)) {
        place = oldPlace.xyz;
        fate = gone;
    } else {
        double exit = exitShare(from, way), within = min(exit, 1.0LF);
        double share = firstHit(from * scale.xyz + offset.xyz, (from + within * way) * scale.xyz + offset.xyz);
        if (share != never) place = vec3(from + share * within * way);
        fate = share != never ? hit : exit < 1.0LF || age >= maximumAge ? gone : lives;
    }
    imageStore(nextPlaces, texelOf(n), vec4(place, age));
    imageStore(nextVelocities, texelOf(n), vec4(velocity, fate));
}
