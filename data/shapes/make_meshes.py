#!/usr/bin/env python3
"""Writes the models of meshes/ from simple parts: helicopter.ply, figure.ply, hare.ply,
cloud.ply. Python 3, standard library only.

Metres, +Y up, +X forward; colours are sRGB bytes, one a vertex. Every part is a closed surface of its own; parts overlap.
"""
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))


class Model:
    def __init__(self):
        self.vertices, self.faces = [], []

    def rings(self, rings, colour):
        """A closed surface through rings of points, its ends closed by fans."""
        first = len(self.vertices)
        width = len(rings[0])
        for j, ring in enumerate(rings):
            tint = colour(j / (len(rings) - 1)) if callable(colour) else colour
            self.vertices += [(p, tint) for p in ring]
        for j in range(len(rings) - 1):
            for i in range(width):
                a, b = first + j * width + i, first + j * width + (i + 1) % width
                self.faces += [(a, b, a + width), (b, b + width, a + width)]
        for j, order in ((0, -1), (len(rings) - 1, 1)):
            ring = rings[j]
            middle = len(self.vertices)
            tint = colour(j / (len(rings) - 1)) if callable(colour) else colour
            self.vertices.append((tuple(sum(p[k] for p in ring) / width for k in range(3)), tint))
            for i in range(width):
                a, b = first + j * width + i, first + j * width + (i + 1) % width
                self.faces.append((middle, a, b) if order > 0 else (middle, b, a))

    def ellipsoid(self, centre, radii, colour, rings=14, width=20, turn=0.0):
        """`turn`: radians about z."""
        c, s = math.cos(turn), math.sin(turn)

        def point(polar, around):
            x = radii[0] * math.sin(polar) * math.cos(around)
            y = radii[1] * math.cos(polar)
            z = radii[2] * math.sin(polar) * math.sin(around)
            return (centre[0] + c * x - s * y, centre[1] + s * x + c * y, centre[2] + z)

        polars = [1e-3 + (math.pi - 2e-3) * j / rings for j in range(rings + 1)]
        self.rings([[point(p, 2 * math.pi * i / width) for i in range(width)] for p in polars], colour)

    def tube(self, points, radii, colour, width=14):
        """Round a line through points."""
        rings = []
        for j, (p, r) in enumerate(zip(points, radii)):
            a, b = points[max(j - 1, 0)], points[min(j + 1, len(points) - 1)]
            d = unit(tuple(b[k] - a[k] for k in range(3)))
            u = unit(cross(d, (0, 0, 1) if abs(d[2]) < 0.9 else (1, 0, 0)))
            v = cross(d, u)
            rings.append([tuple(p[k] + r * (math.cos(t) * u[k] + math.sin(t) * v[k]) for k in range(3))
                          for t in (2 * math.pi * i / width for i in range(width))])
        self.rings(rings, colour)

    def box(self, least, most, colour, turn=0.0, about=(0, 0, 0)):
        """`turn`: radians about y, through `about`."""
        c, s = math.cos(turn), math.sin(turn)
        corners = []
        for k in range(8):
            p = tuple((most if k >> axis & 1 else least)[axis] - about[axis] for axis in range(3))
            corners.append((about[0] + c * p[0] + s * p[2], about[1] + p[1], about[2] - s * p[0] + c * p[2]))
        first = len(self.vertices)
        self.vertices += [(p, colour) for p in corners]
        for a, b, c4, d in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)):
            self.faces += [(first + a, first + b, first + c4), (first + a, first + c4, first + d)]

    def write(self, name, comment):
        with open(os.path.join(HERE, "meshes", name), "w") as file:
            file.write(f"ply\nformat ascii 1.0\ncomment {comment}\nelement vertex {len(self.vertices)}\n"
                       "property float x\nproperty float y\nproperty float z\n"
                       "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                       f"element face {len(self.faces)}\nproperty list uchar int vertex_indices\nend_header\n")
            for p, colour in self.vertices:
                file.write("%.4f %.4f %.4f %d %d %d\n" % (*p, *colour))
            for face in self.faces:
                file.write("3 %d %d %d\n" % face)


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def helicopter():
    olive, dark, glass, red, white = (120, 138, 70), (58, 62, 60), (90, 175, 225), (214, 44, 36), (240, 240, 235)
    m = Model()
    m.ellipsoid((0, 0, 0), (1.55, 0.95, 0.85), olive)                            # cabin
    m.ellipsoid((0.85, 0.05, 0), (0.95, 0.72, 0.76), glass)                      # canopy
    m.ellipsoid((-0.5, 0.75, 0), (0.85, 0.42, 0.42), dark)                       # engine

    def boom(share):
        return red if 0.42 < share < 0.56 else (white if 0.56 <= share < 0.68 else olive)

    steps = 16
    m.tube([(-1.0 - 3.1 * k / steps, 0.15 + 0.35 * k / steps, 0) for k in range(steps + 1)],
           [0.46 - 0.2 * k / steps for k in range(steps + 1)], boom)            # boom with its marking
    m.box((-4.35, 0.35, -0.13), (-3.7, 1.55, 0.13), red)                        # fin
    m.box((-3.75, 0.36, -0.75), (-3.2, 0.6, 0.75), olive)                       # tail plane
    m.tube([(0, 0.8, 0), (0, 1.5, 0)], [0.2, 0.2], dark)                       # mast
    for turn in (0.35, 0.35 + math.pi / 2):
        m.box((-2.7, 1.4, -0.26), (2.7, 1.64, 0.26), dark, turn)                # blades
    m.ellipsoid((-4.05, 1.0, 0.2), (0.6, 0.6, 0.13), dark, rings=8)            # tail rotor
    for side in (-1, 1):
        m.tube([(-1.35, -1.35, side * 0.85), (1.3, -1.35, side * 0.85), (1.7, -1.15, side * 0.85)], [0.15] * 3, dark)
        for x in (-0.7, 0.7):
            m.tube([(x, -0.7, side * 0.45), (x, -1.35, side * 0.85)], [0.14, 0.14], dark)
    m.write("helicopter.ply", "our own: a helicopter of simple parts")


def figure():
    """Our own character: a lamplighter, a small bearded man with a bent pointed hat, who holds a lantern on a crook."""
    teal, rust, cream, brown, yellow = (34, 128, 138), (196, 78, 40), (244, 232, 208), (84, 56, 36), (250, 208, 66)
    m = Model()
    for side in (-1, 1):
        m.ellipsoid((0.1, 0.1, side * 0.2), (0.27, 0.1, 0.13), brown)            # boots
        m.tube([(0, 0.1, side * 0.19), (0, 0.66, side * 0.15)], [0.12, 0.14], teal)
    m.tube([(0, 0.5, 0), (0, 0.76, 0), (0, 1.05, 0), (0, 1.28, 0)], [0.52, 0.44, 0.35, 0.25], rust, width=20)  # coat
    m.tube([(0, 0.74, 0), (0, 0.84, 0)], [0.465, 0.435], brown, width=20)        # belt
    m.ellipsoid((0.45, 0.79, 0), (0.05, 0.08, 0.1), yellow, rings=8, width=12)  # its buckle
    m.ellipsoid((0, 1.46, 0), (0.31, 0.3, 0.31), cream)                         # head
    m.ellipsoid((0.33, 1.46, 0), (0.1, 0.08, 0.08), rust, rings=8, width=12)     # nose
    for side in (-1, 1):
        m.ellipsoid((0.27, 1.55, side * 0.13), (0.05, 0.06, 0.05), brown, rings=8, width=12)  # eyes
    m.tube([(0.12, 1.4, 0), (0.27, 1.22, 0), (0.38, 1.02, 0), (0.44, 0.9, 0)], [0.29, 0.24, 0.14, 0.04], cream)  # beard
    m.tube([(0, 1.62, 0), (0, 1.69, 0)], [0.5, 0.42], brown, width=24)          # brim
    m.tube([(0, 1.66, 0), (-0.04, 1.9, 0), (-0.16, 2.12, 0), (-0.36, 2.26, 0), (-0.54, 2.22, 0)],
           [0.38, 0.29, 0.2, 0.14, 0.07], teal, width=18)                       # hat
    m.tube([(0, 1.18, 0.16), (0.1, 1.05, 0.44), (0.3, 1.2, 0.62)], [0.13, 0.12, 0.1], rust)      # the arm that holds
    m.tube([(0, 1.18, -0.16), (0.02, 0.95, -0.42), (0.1, 0.72, -0.5)], [0.13, 0.12, 0.1], rust)  # the arm that hangs
    m.ellipsoid((0.34, 1.23, 0.66), (0.11, 0.11, 0.11), cream)
    m.ellipsoid((0.11, 0.66, -0.5), (0.1, 0.11, 0.1), cream)
    m.tube([(0.36, 0.02, 0.68), (0.36, 2.0, 0.68), (0.44, 2.2, 0.68), (0.62, 2.24, 0.68), (0.72, 2.1, 0.68)],
           [0.07] * 5, brown)                                                    # crook
    m.tube([(0.72, 2.02, 0.68), (0.72, 2.1, 0.68)], [0.18, 0.08], brown)         # lantern
    m.ellipsoid((0.72, 1.87, 0.68), (0.18, 0.2, 0.18), yellow)
    m.tube([(0.72, 1.63, 0.68), (0.72, 1.7, 0.68)], [0.15, 0.15], brown)
    m.write("figure.ply", "our own: a lamplighter of simple parts")


def hare():
    """Of the bunny's size and in its pose, so that the same edits fit: nose towards -x, tail at +x."""
    fur = (172, 150, 122)
    m = Model()
    m.ellipsoid((0.25, 0.78, 0), (0.95, 0.74, 0.8), fur, turn=-0.2)              # body
    m.ellipsoid((0.45, 0.55, 0), (0.72, 0.55, 0.95), fur)                        # haunches
    m.ellipsoid((-0.45, 1.0, 0.05), (0.5, 0.6, 0.5), fur)                        # breast
    m.ellipsoid((-0.75, 1.55, 0.15), (0.42, 0.4, 0.4), fur)                      # head
    m.ellipsoid((-1.08, 1.48, 0.3), (0.22, 0.18, 0.2), fur)                      # muzzle
    m.ellipsoid((1.06, 0.45, 0.2), (0.24, 0.24, 0.24), fur)                      # tail
    for z in (-0.15, 0.3):
        m.ellipsoid((-0.5, 2.12, z), (0.14, 0.46, 0.12), fur, turn=-0.15)        # ears
    for side in (-1, 1):
        m.ellipsoid((-0.7, 0.13, side * 0.4), (0.36, 0.13, 0.2), fur)            # paws
        m.ellipsoid((0.1, 0.13, side * 0.7), (0.5, 0.13, 0.24), fur)
    m.write("hare.ply", "our own: a hare of simple parts, in place of the bunny")


def cloud():
    white = (238, 240, 245)
    m = Model()
    for centre, radii in (((-0.14, 0.19, 0), (0.16, 0.15, 0.16)), ((0.02, 0.25, 0.02), (0.19, 0.18, 0.18)),
                          ((0.18, 0.19, -0.01), (0.15, 0.14, 0.15)), ((-0.25, 0.13, 0.03), (0.1, 0.09, 0.1)),
                          ((0.27, 0.12, 0.03), (0.09, 0.08, 0.09)), ((0.03, 0.13, 0.08), (0.17, 0.11, 0.14)),
                          ((-0.06, 0.32, -0.05), (0.11, 0.1, 0.11)), ((0.12, 0.32, 0.03), (0.1, 0.09, 0.1))):
        m.ellipsoid(centre, radii, white)
    m.write("cloud.ply", "our own: a small cloud of balls")


if __name__ == "__main__":
    os.makedirs(os.path.join(HERE, "meshes"), exist_ok=True)
    helicopter()
    figure()
    hare()
    cloud()
