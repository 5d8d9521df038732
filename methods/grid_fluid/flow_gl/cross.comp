// Finds the rays that cross a triangle, one thread per triangle: counts them, or stores the crossings (STORE).
layout(std430, binding = 0) restrict readonly buffer Places { double places[]; };  // three per vertex, in cells
layout(std430, binding = 1) restrict readonly buffer Indices { uint indices[]; };
layout(std430, binding = 2) restrict buffer Counts { uint counts[]; };  // of each ray
#ifdef STORE
layout(std430, binding = 3) restrict readonly buffer Firsts { uint firsts[]; };
layout(std430, binding = 4) restrict writeonly buffer Crossings { Crossing crossings[]; };
#endif

dvec3 corner(int triangle, int number) {
    int first = 3 * int(indices[3 * triangle + number]);
    return dvec3(places[first + axis], places[first + (axis + 1) % 3], places[first + (axis + 2) % 3]);
}

// An edge is always evaluated from its smaller end, so that both of its triangles agree.
bool isLeftOf(dvec2 a, dvec2 b, dvec2 point) {
    bool turned = b.x < a.x || (b.x == a.x && b.y < a.y);
    dvec2 from = turned ? b : a, to = turned ? a : b;
    precise double area = (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x);
    return (area >= 0.0lf) != turned;
}

void main() {
    int triangle = threadNumber();
    if (triangle >= count) return;
    dvec3 a = corner(triangle, 0), b = corner(triangle, 1), c = corner(triangle, 2);
    dvec3 minimum = min(min(a, b), c), maximum = max(max(a, b), c);
    if (maximum.y < 0.0lf || maximum.z < 0.0lf || minimum.y > double(size.y) || minimum.z > double(size.z)) return;
    int firstJ = int(max(0.0lf, ceil(minimum.y - 0.5lf))), firstK = int(max(0.0lf, ceil(minimum.z - 0.5lf)));
    int lastJ = int(min(double(size.y - 1), floor(maximum.y - 0.5lf)));
    int lastK = int(min(double(size.z - 1), floor(maximum.z - 0.5lf)));
    precise dvec3 u = b - a, v = c - a;
    precise dvec3 normal = dvec3(u.y * v.z - v.y * u.z, u.z * v.x - v.z * u.x, u.x * v.y - v.x * u.y);
    if (!(abs(normal.x) > 0.0lf)) return;
    bool leaving = normal.x > 0.0lf;
    for (int k = firstK; k <= lastK; ++k)
        for (int j = firstJ; j <= lastJ; ++j) {
            dvec2 point = dvec2(double(j) + 0.5lf, double(k) + 0.5lf);
            if (isLeftOf(a.yz, b.yz, point) != leaving || isLeftOf(b.yz, c.yz, point) != leaving ||
                isLeftOf(c.yz, a.yz, point) != leaving)
                continue;
            int ray = j + size.y * k;
            uint number = atomicAdd(counts[ray], 1u);
#ifdef STORE
            precise double x = a.x - (normal.y * (point.x - a.y) + normal.z * (point.y - a.z)) / normal.x;
            precise double square = normal.x * normal.x + normal.y * normal.y + normal.z * normal.z;
            precise dvec3 unit = normal * (1.0lf / sqrt(square));
            float stored[3] = float[3](float(unit.x), float(unit.y), float(unit.z));
            crossings[firsts[ray] + number] = Crossing(float(x), leaving ? -1 : 1, uint(triangle), 0, stored, 0.0);
#endif
        }
}
