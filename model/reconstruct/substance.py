"""What is left at the end is sound: no part is a shred, no triangle is flat, nothing meets.

What cutting leaves of a torn surface may be a shred: too light for a simulator beside a carcass, or
so thin that no contact box fits inside; its hull would stick out and jam its neighbors.
"""

from artgen.geometry.solid import Solid
from model.reconstruct.apart import made_sound
from model.reconstruct.contact import boxes_inside
from model.reconstruct.proof import proven
from model.reconstruct.scene import Scene
from model.reconstruct.seating import seated

LIGHT = 2e-6
"""Share of the largest part's volume; validators refuse a mass a million times another's."""
THIN = 0.05
"""Share of its hull that a part fills to be looked at as a shred."""


def settled(scene: Scene) -> Scene:
    """The scene in which triangles have areas, joints are seated, nothing meets and nothing is a
    shred; looked at anew where a part became a piece of another."""
    joints = -1
    while joints != len(scene.joints):  # Solids change no more where no joint goes.
        joints = len(scene.joints)
        scene = substantial(proven(seated(made_sound(scene))))
    return scene


def substantial(scene: Scene) -> Scene:
    """The scene in which every moving part has weight and room for contact, and nothing meets."""
    while found := shred(scene):
        scene = proven(scene.fixed(*found))
    return scene


def shred(scene: Scene) -> tuple[str, str] | None:
    """The joint of a part that is none, and why; None where there is no such part."""
    largest = max(solid.volume for solid in scene.solids.values())
    for joint in scene.joints:
        solid = scene.solids[joint.child]
        if solid.volume < LIGHT * largest:
            return joint.name, f"a {solid.volume / largest:.0e} part of the largest is left of it"
        if is_thin(solid):
            return joint.name, "what is left of it is so thin that no contact box fits inside"
    return None


def is_thin(solid: Solid) -> bool:
    """Whether no box of contact fits inside."""
    return solid.volume < THIN * solid.hull().volume and not boxes_inside(solid)
