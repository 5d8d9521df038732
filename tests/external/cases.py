"""The clouds that all programs draw, and their cameras.

Metres, +Y up, right-handed. A puff is a Gaussian of extinction with the standard deviation s (half of its radius) and the
optical depth `depth` through its centre.
"""

import dataclasses
import math
import random

WIDTH, HEIGHT = 160, 120


@dataclasses.dataclass(frozen=True)
class Puff:
    centre: tuple
    radius: float
    depth: float

    @property
    def deviation(self):
        return self.radius / 2

    @property
    def opacity(self):
        return -math.expm1(-self.depth)

    @property
    def peak(self):
        """Extinction at the centre, 1/m."""
        return self.depth / (math.sqrt(2 * math.pi) * self.deviation)

    def altered(self, width, mass):
        """`width` times as wide, with `mass` times the mass (2 pi s^2 times the depth)."""
        return Puff(self.centre, self.radius * width, self.depth * mass / width ** 2)


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    puffs: tuple
    eye: tuple
    target: tuple
    ground: bool = False  # the plane y = 0 is in view
    field_of_view: float = 40.0  # vertical, degrees
    resolution: int = 160  # cells along the grid's longest edge

    def altered(self, width, mass):
        return dataclasses.replace(self, puffs=tuple(puff.altered(width, mass) for puff in self.puffs))

    def widened(self, edge):
        """The puff as shown by a grid with cells of this edge: cell averages add edge^2/12 to the variance, linear
        interpolation adds edge^2/6."""
        return dataclasses.replace(self, puffs=tuple(
            puff.altered(math.sqrt(1 + (edge / puff.deviation) ** 2 / 4), 1) for puff in self.puffs))

    def moved(self, by):
        """All puffs moved by this many metres along each axis."""
        return dataclasses.replace(self, puffs=tuple(
            dataclasses.replace(puff, centre=tuple(c + by for c in puff.centre)) for puff in self.puffs))

    @property
    def region(self):
        """Bounds of the grid, 5 s around all centres: the minimum, then the maximum."""
        return ([min(p.centre[i] - 5 * p.deviation for p in self.puffs) for i in range(3)]
                + [max(p.centre[i] + 5 * p.deviation for p in self.puffs) for i in range(3)])

    @property
    def slopes(self):
        """Metres to the side per metre ahead at the right and the upper edge of the picture."""
        upper = math.tan(math.radians(self.field_of_view) / 2)
        return upper * WIDTH / HEIGHT, upper

    @property
    def axes(self):
        """Unit vectors to the right, up and ahead."""
        ahead = unit([t - e for t, e in zip(self.target, self.eye)])
        right = unit(cross(ahead, (0, 1, 0)))
        return right, cross(right, ahead), ahead


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def cloud(count):
    chance = random.Random(30)
    return tuple(Puff((chance.uniform(-1.4, 1.4), chance.uniform(2.4, 3.6), chance.uniform(-0.8, 0.8)),
                      chance.uniform(0.6, 1.0), chance.uniform(0.2, 0.6)) for _ in range(count))


CASES = (
    Case("one_puff", (Puff((0, 3, 0), 1.0, 1.5),), (0.3, 3.4, 6), (0, 3, 0)),
    Case("overlaps", cloud(16), (1, 3.5, 8), (0, 3, 0), resolution=200),
    Case("ground", (Puff((0, 0.3, 0), 1.0, 1.5), Puff((0.9, -0.2, -0.5), 0.8, 1.0)), (0, 1.5, 6), (0.2, 0.3, 0), ground=True),
    Case("inside", (Puff((0, 3, 0), 1.0, 1.5),), (0.2, 3.1, 0.4), (0, 2.8, -2), field_of_view=70.0),
    Case("depth_5", (Puff((0, 3, 0), 1.0, 5.0),), (0.3, 3.4, 6), (0, 3, 0)),
)
