#!/usr/bin/env python3
"""Writes the solids of this folder, one in each format that is read. Python 3, standard library only: `python3 make_meshes.py`.

rock.obj, sphere.obj, dart.obj, bellows.obj, bellows_full.obj, hand.obj and hand_bent.obj (no normals: they are computed), crate.ply,
wall.ply, paddle.ply and paddle_stand.ply (vertex colours), marker_post.stl (binary). Metres, +Y up, on y = 0 but for sphere and
paddle, which have their middle at the origin, and the hands, which have their wrist there.
"""
import math
import os
import struct

HERE = os.path.dirname(os.path.abspath(__file__))


def path(name):
    return os.path.join(HERE, name)


def icosphere(divisions):
    golden = (1 + math.sqrt(5)) / 2
    points = [(s * a, t * b, 0) for a, b in ((1, golden),) for s in (-1, 1) for t in (-1, 1)]
    points += [(0, s, t * golden) for s in (-1, 1) for t in (-1, 1)]
    points += [(s * golden, 0, t) for s in (-1, 1) for t in (-1, 1)]
    points = [tuple(c / math.sqrt(1 + golden * golden) for c in p) for p in points]
    edge = min(math.dist(points[0], p) for p in points[1:]) * 1.01
    faces = []
    for a in range(12):
        for b in range(a + 1, 12):
            for c in range(b + 1, 12):
                if max(math.dist(points[a], points[b]), math.dist(points[b], points[c]),
                       math.dist(points[a], points[c])) < edge:
                    p, q, r = points[a], points[b], points[c]
                    normal = cross(minus(q, p), minus(r, p))
                    faces.append((a, b, c) if dot(normal, p) > 0 else (a, c, b))
    for _ in range(divisions):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                p = tuple((points[a][i] + points[b][i]) / 2 for i in range(3))
                points.append(tuple(c / math.sqrt(dot(p, p)) for c in p))
                middles[key] = len(points) - 1
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    return points, faces


def minus(a, b):
    return tuple(a[i] - b[i] for i in range(3))


def dot(a, b):
    return sum(a[i] * b[i] for i in range(3))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def write_obj(name, comment, digits, points, faces):
    """The counts let the reader notice a file that is cut between two lines."""
    with open(path(name), "w", encoding="ascii", newline="") as file:
        file.write(f"# {comment}\n# counts: v {len(points)}, f {len(faces)}\n")
        for p in points:
            file.write("v " + " ".join(f"{x:.{digits}f}" for x in p) + "\n")
        for a, b, c in faces:
            file.write(f"f {a + 1} {b + 1} {c + 1}\n")


def rock():
    """A sphere cut by planes (facets of stone) and bent by a few waves, half buried."""
    points, faces = icosphere(2)
    cuts = []
    for i in range(11):
        y = 1 - 2 * (i + 0.5) / 11
        angle = 2.39996 * i + 0.6
        ring = math.sqrt(1 - y * y)
        cuts.append(((ring * math.cos(angle), y, ring * math.sin(angle)), 0.66 + 0.22 * ((i * 37) % 11) / 10))
    moved = []
    for p in points:
        radius = 1.0
        for normal, distance in cuts:
            across = dot(p, normal)
            if across > 0:
                radius = min(radius, distance / across)
        radius *= 1 + 0.035 * math.sin(7 * p[0] + 2 * p[1]) * math.sin(6 * p[2] - p[0]) + 0.02 * math.sin(15 * p[1] + 9 * p[0])
        moved.append((1.05 * radius * p[0], 0.78 * radius * p[1] + 0.42, 0.85 * radius * p[2]))
    write_obj("rock.obj", "a boulder, about 1.8 m long and 1 m above the ground", 4, moved, faces)


def sphere():
    """Of radius 1, its middle at the origin."""
    points, faces = icosphere(4)
    write_obj("sphere.obj", "a sphere of radius 1 m", 5, points, faces)


def bellows():
    """A ball that stands on its flattened underside, at rest and full: the same faces, for a solid that deforms."""
    points, faces = icosphere(3)
    rest = [(x, max(y, -0.8) + 0.8, z) for x, y, z in points]
    full = [(1.45 * x, 1.6 * y, 1.45 * z) for x, y, z in rest]
    write_obj("bellows.obj", "a ball of radius 1 m on the ground", 4, rest, faces)
    write_obj("bellows_full.obj", "bellows.obj, 1.45 times as wide and 1.6 times as high", 4, full, faces)


def tube(points, faces, path, sides=14):
    """A closed tube with round ends along `path`: a list of (centre, half-width along x, half-width across)."""
    def direction(k):
        d = minus(path[min(k + 1, len(path) - 1)][0], path[max(k - 1, 0)][0])
        length = math.sqrt(dot(d, d))
        return tuple(c / length for c in d)

    rings = []
    for angle in (80, 55, 30):  # the round end: a quarter of an ellipse
        (centre, wide, thick), d = path[0], direction(0)
        back, share = thick * math.sin(math.radians(angle)), math.cos(math.radians(angle))
        rings.append((tuple(centre[i] - back * d[i] for i in range(3)), wide * share, thick * share, d))
    rings += [(*path[k], direction(k)) for k in range(len(path))]
    for angle in (30, 55, 80):
        (centre, wide, thick), d = path[-1], direction(len(path) - 1)
        on, share = thick * math.sin(math.radians(angle)), math.cos(math.radians(angle))
        rings.append((tuple(centre[i] + on * d[i] for i in range(3)), wide * share, thick * share, d))
    first = len(points)
    for centre, wide, thick, d in rings:
        across = cross((1, 0, 0), d)
        length = math.sqrt(dot(across, across))
        across = tuple(c / length for c in across)
        side = cross(d, across)
        for i in range(sides):
            c, s = math.cos(2 * math.pi * i / sides), math.sin(2 * math.pi * i / sides)
            points.append(tuple(centre[a] + wide * c * side[a] + thick * s * across[a] for a in range(3)))
    for ring in range(len(rings) - 1):
        for i in range(sides):
            a, b = first + ring * sides + i, first + ring * sides + (i + 1) % sides
            faces += [(a, b + sides, b), (a, a + sides, b + sides)]
    last = first + (len(rings) - 1) * sides
    for i in range(1, sides - 1):
        faces += [(first, first + i, first + i + 1), (last, last + i + 1, last + i)]


def hand():
    """A right hand with its forearm, its palm towards +Z, stretched out and with bent fingers: the same faces."""
    for name, comment, bend in (("hand.obj", "a right hand of 0.19 m and its forearm", 6),
                                ("hand_bent.obj", "hand.obj with bent fingers", 34)):
        points, faces = [], []
        tube(points, faces, [((0, -0.36, 0), 0.040, 0.036), ((0, -0.2, 0), 0.037, 0.032), ((0, -0.05, 0), 0.028, 0.022),
                             ((0, 0.0, 0), 0.027, 0.019)])
        tube(points, faces, [((0, 0.0, 0), 0.027, 0.016), ((0, 0.035, 0), 0.037, 0.017), ((0, 0.07, 0), 0.042, 0.015),
                             ((0, 0.092, 0), 0.041, 0.011)])
        for x, length, radius in ((-0.032, 0.060, 0.0075), (-0.011, 0.078, 0.0085), (0.0105, 0.084, 0.009),
                                  (0.0315, 0.074, 0.0085)):
            y, z, angle = 0.088, 0.0, 0.0
            path = [((x, y, z), radius, radius)]
            for joint, share in enumerate((0.46, 0.30, 0.24)):
                angle += math.radians(bend) * (0.8, 1.1, 0.8)[joint]
                for part in (0.5, 0.5):  # a ring in the middle of every bone
                    y += part * share * length * math.cos(angle)
                    z += part * share * length * math.sin(angle)
                    path.append(((x, y, z), radius * (1 - 0.07 * joint), radius * (1 - 0.07 * joint)))
            tube(points, faces, path)
        lean = math.radians(bend) * 0.6
        tube(points, faces, [((0.022, 0.012, 0.002), 0.013, 0.013), ((0.044, 0.036, 0.008), 0.0115, 0.011),
                             ((0.062, 0.062, 0.012 + 0.02 * math.sin(lean)), 0.0105, 0.010),
                             ((0.068, 0.084, 0.014 + 0.06 * math.sin(lean)), 0.0095, 0.009)])
        write_obj(name, comment, 5, points, faces)


def write_quads(name, comment, vertices, faces):
    """Vertices: a point and a colour in bytes; faces: four numbers of vertices each."""
    with open(path(name), "w", newline="") as file:
        file.write(f"ply\nformat ascii 1.0\ncomment {comment}\n")
        file.write(f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n")
        file.write("property uchar red\nproperty uchar green\nproperty uchar blue\n")
        file.write(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
        for (x, y, z), (r, g, b) in vertices:
            file.write(f"{x:.3f} {y:.3f} {z:.3f} {r} {g} {b}\n")
        for face in faces:
            file.write("4 " + " ".join(str(i) for i in face) + "\n")


def crate():
    """A wooden crate of 1 m: five planks a side between two battens."""
    vertices, faces = [], []

    def quad(corners, colour):
        first = len(vertices)
        vertices.extend((corner, colour) for corner in corners)
        faces.append(tuple(range(first, first + 4)))

    def block(low, high, colour):
        for axis in range(3):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            for side in (0, 1):
                corners = []
                for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
                    corner = [0, 0, 0]
                    corner[axis] = (low, high)[side][axis]
                    corner[u] = (low, high)[a][u]
                    corner[v] = (low, high)[b][v]
                    corners.append(tuple(corner))
                quad(corners, colour)

    tones = [(164, 122, 74), (150, 108, 64), (172, 131, 82), (143, 104, 62), (158, 116, 70)]
    batten = (112, 80, 47)
    for i, tone in enumerate(tones):
        block((-0.47, 0.03 + 0.19 * i, -0.47), (0.47, 0.03 + 0.19 * i + 0.18, 0.47), tone)
    block((-0.455, 0.02, -0.455), (0.455, 0.96, 0.455), (60, 44, 28))
    for x in (-0.5, 0.4):
        for z in (-0.5, 0.4):
            block((x, 0, z), (x + 0.1, 1, z + 0.1), batten)
    for y in (0, 0.91):
        for z in (-0.5, 0.42):
            block((-0.4, y, z), (0.4, y + 0.09, z + 0.08), batten)
        for x in (-0.5, 0.42):
            block((x, y, -0.4), (x + 0.08, y + 0.09, 0.4), batten)
    write_quads("crate.ply", "a wooden crate of one metre", vertices, faces)


def wall():
    """Bricks with a running bond: 0.4 x 2.4 x 6 m, one end at z = 0, the other at z = -6."""
    thick, high, course, long = 0.4, 2.4, 0.2, 0.6
    vertices, faces = [], []

    def quad(corners, shade):
        first = len(vertices)
        vertices.extend((p, shade) for p in corners)
        faces.append(tuple(range(first, first + 4)))

    courses = round(high / course)
    for j in range(courses):
        y0, y1 = j * course, (j + 1) * course
        cuts = [0.0] + [z for z in (long * (k + (0.5 if j % 2 else 1.0)) for k in range(10)) if z < 6 - 1e-9] + [6.0]
        for k, (a, b) in enumerate(zip(cuts, cuts[1:])):
            tone = (37 * j + 61 * k + 13 * j * k) % 5
            shade = (150 + 9 * tone, 74 + 5 * tone, 56 + 4 * tone)
            for x, order in ((-thick / 2, -1), (thick / 2, 1)):
                corners = [(x, y0, -a), (x, y1, -a), (x, y1, -b), (x, y0, -b)]
                quad(corners[::-order], shade)
            if j == courses - 1:
                quad([(-thick / 2, y1, -a), (thick / 2, y1, -a), (thick / 2, y1, -b), (-thick / 2, y1, -b)], shade)
            if j == 0:
                quad([(-thick / 2, 0, -b), (thick / 2, 0, -b), (thick / 2, 0, -a), (-thick / 2, 0, -a)], shade)
        shade = (150 + 9 * (j % 3), 74 + 5 * (j % 3), 56 + 4 * (j % 3))
        quad([(-thick / 2, y0, 0), (thick / 2, y0, 0), (thick / 2, y1, 0), (-thick / 2, y1, 0)], shade)
        quad([(-thick / 2, y0, -6), (-thick / 2, y1, -6), (thick / 2, y1, -6), (thick / 2, y0, -6)], shade)
    write_quads("wall.ply", "a wall of bricks", vertices, faces)


def prism(vertices, faces, low, high, radius, colour):
    """Along z with twelve sides; its ends are five quads each."""
    sides, first = 12, len(vertices)
    for z in (low, high):
        for i in range(sides):
            angle = 2 * math.pi * i / sides
            vertices.append(((radius * math.cos(angle), radius * math.sin(angle), z), colour))
    for i in range(sides):
        j = (i + 1) % sides
        faces.append((first + i, first + j, first + sides + j, first + sides + i))
    for i in range(1, sides - 1, 2):
        faces.append((first, first + i + 2, first + i + 1, first + i))
        faces.append(tuple(first + sides + k for k in (0, i, i + 1, i + 2)))


def cuboid(vertices, faces, low, high, colour):
    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, 1):
            first = len(vertices)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
                corner = [0, 0, 0]
                corner[axis], corner[u], corner[v] = (low, high)[side][axis], (low, high)[a][u], (low, high)[b][v]
                vertices.append((tuple(corner), colour))
            faces.append(tuple(range(first, first + 4)))


def paddle():
    """A wheel of four blades that turns about z, and the stand with its two bearings 1.7 m above the ground."""
    wood, dark, iron = (176, 128, 72), (140, 98, 54), (70, 74, 80)
    vertices, faces = [], []
    cuboid(vertices, faces, (-0.7, -0.03, -0.45), (0.7, 0.03, 0.45), wood)
    cuboid(vertices, faces, (-0.03, -0.7, -0.45), (0.03, 0.7, 0.45), dark)
    prism(vertices, faces, -0.5, 0.5, 0.11, dark)
    prism(vertices, faces, -0.7, 0.7, 0.04, iron)
    write_quads("paddle.ply", "a paddle wheel of 1.4 m", vertices, faces)
    vertices, faces = [], []
    for z in (-0.68, 0.58):
        cuboid(vertices, faces, (-0.05, 0, z), (0.05, 1.76, z + 0.1), iron)
        cuboid(vertices, faces, (-0.3, 0, z), (0.3, 0.06, z + 0.1), iron)
    write_quads("paddle_stand.ply", "what the paddle wheel hangs in", vertices, faces)


def marker_post():
    """A six-sided post with a slanted cap, 1.2 m high."""
    sides, radius, triangles = 6, 0.07, []

    def ring(y, r, slant=0.0):
        return [(r * math.cos(2 * math.pi * i / sides), y + slant * math.cos(2 * math.pi * i / sides),
                 r * math.sin(2 * math.pi * i / sides)) for i in range(sides)]

    rings = [ring(0, radius), ring(1.05, radius), ring(1.15, 0.05, 0.03)]
    for low, high in zip(rings, rings[1:]):
        for i in range(sides):
            j = (i + 1) % sides
            triangles += [(low[i], high[i], high[j]), (low[i], high[j], low[j])]
    bottom, top = rings[0], rings[-1]
    for i in range(1, sides - 1):
        triangles.append((top[0], top[i + 1], top[i]))
        triangles.append((bottom[0], bottom[i], bottom[i + 1]))
    with open(path("marker_post.stl"), "wb") as file:
        file.write(b"marker post, metres".ljust(80, b"\0"))
        file.write(struct.pack("<I", len(triangles)))
        for a, b, c in triangles:
            normal = cross(minus(b, a), minus(c, a))
            length = math.sqrt(dot(normal, normal))
            file.write(struct.pack("<12fH", *(n / length for n in normal), *a, *b, *c, 0))


def dart():
    """A folded paper plane, nose along +X: two wings and a keel. Wings are drawn from both sides."""
    nose, left, right, keel = (1.0, 0.0, 0.0), (-0.6, 0.12, -0.55), (-0.6, 0.12, 0.55), (-0.6, -0.15, 0.0)
    back = (-0.45, 0.0, 0.0)
    faces = [(nose, back, left), (nose, right, back), (nose, keel, back)]
    with open(path("dart.obj"), "w") as file:
        file.write("# dart: metres, nose along +X, written by make_meshes.py\n")
        file.write(f"# counts: v {3 * len(faces)}, f {len(faces)}\n")
        for face in faces:
            for corner in face:
                file.write("v {:.4f} {:.4f} {:.4f}\n".format(*corner))
        for i in range(len(faces)):
            file.write(f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}\n")


rock()
sphere()
dart()
bellows()
hand()
crate()
wall()
paddle()
marker_post()
