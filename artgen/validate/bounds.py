"""Every bound of the validators with its reason; docs/validation.md shows the same table."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Bound:
    """A limit of a check, its unit, and why it is where it is."""

    value: float
    unit: str
    reason: str

    def at_most(self) -> str:
        """`<= value unit`."""
        return f"<= {self.value:g} {self.unit}".rstrip()

    def at_least(self) -> str:
        """`>= value unit`."""
        return f">= {self.value:g} {self.unit}".rstrip()


MAX_FILES = Bound(30, "files", "what one asset may ask of a file system that holds 100,000 of them")
MAX_BYTES = Bound(3e6, "bytes", "what one asset may weigh on disk; textures are the usual excess")
AXIS_NORM = Bound(1e-12, "", "a normalized float64 triple is off by 2 ulp at most; ours are exact")
FULL_TURN = Bound(6.283185307179587, "rad", "a hinge that turns further is a continuous joint")

SMALLEST = Bound(0.005, "m", "a smaller part is a unit mistake (mm read as m) or a lost solid")
LARGEST = Bound(5.0, "m", "no household object is larger; a larger one is a unit mistake")
MIN_AREA = Bound(1e-14, "m2", "half of a square of the vertex grid's step, 1e-7 m, rounded up")
UV_EDGE = Bound(1e-6, "", "texture coordinates are rounded to 1e-6")
BOUNDS_MATCH = Bound(1e-9, "m", "manifest and OBJ state the same rounded vertices")
GLB_BOUNDS = Bound(
    2e-6, "m", "float32 keeps 6e-8 of 5 m in the position, the node and their sum: 9e-7 together"
)
HULL_GAP = Bound(1e-5, "m", "rounding the vertices of a convex piece to 1e-7 m over short edges")
COLLISION_REACH = Bound(
    0.004, "m", "a collision piece may bridge rounded edges and chords, but not stick out further"
)

DENSITY_LOW = Bound(20.0, "kg/m3", "expanded polystyrene; lighter parts are forgotten densities")
DENSITY_HIGH = Bound(12000.0, "kg/m3", "lead; heavier parts are grams read as kilograms")
TRIANGLE = Bound(1e-9, "", "A + B >= C holds exactly for a rigid body; MuJoCo refuses 1e-9 less")
INERTIA_RATIO = Bound(1e6, "", "thin rods reach 1e4; beyond 1e6 the tensor is degenerate")
INTEGRAL = Bound(
    1e-9,
    "relative",
    "the same float64 integral over the same vertices; sums of 1e4 terms lose 1e-12",
)
AGREEMENT = Bound(
    1e-9, "relative", "files carry 17 digits; principal axes cost 1e-15, subtracting pivots 1e-16 m"
)

KINEMATICS = Bound(
    1e-12, "m", "eight joints of 1 m arms lose 4 ulp each; 1e-6 would hide a rounded axis"
)
CONTACT = Bound(1e-4, "m", "float32 hulls shift by 6e-9 m; 0.1 mm is the least visible overlap")
OVERLAP = Bound(1e-9, "m3", "1 mm3: a 0.1 mm overlap along a 10 mm edge of 1 mm")
SETTLE_FACTOR = Bound(
    2.0, "", "margin on the derived creep and sag, whose impedance is taken where it is softest"
)
SETTLE_FLOOR = Bound(1e-6, "rad or m", "solver tolerance of 1e-12 over 1000 steps")

GROUND = Bound(0.001, "m", "rounding an extreme edge pulls the bounds back by its radius at most")
HINGE_SHARE = Bound(0.05, "of the part's diagonal", "hinges sit on an edge of what they turn")
HINGE_SLACK = Bound(
    0.01, "m", "plus the joint gap, and half of what a handle adds to the box before a door's face"
)
TRAVEL = Bound(1.0, "of the part's length", "a slide that travels further leaves its rails")
CLOSED_PLAY = Bound(
    0.005, "m", "seals and bumpers leave 1 to 3 mm; a part that rests open has more"
)
