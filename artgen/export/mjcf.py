"""MJCF: nested bodies at the joints, textured OBJ visuals, convex collision, stated inertia."""

import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np

from artgen.articulation.grips import grip_frame
from artgen.articulation.types import (
    ArticulatedObject,
    Grip,
    Joint,
    JointType,
    Latch,
    Mimic,
    Part,
    Spring,
)
from artgen.core.mesh import Floats
from artgen.core.transform import rigid
from artgen.export.kinematics import FileGrip, FileJoint, FileKinematics, FileMass, vector
from artgen.export.layout import (
    MJCF,
    BoxPiece,
    HullPiece,
    atlas_path,
    collision_pieces,
    mesh_path,
    pivots,
)
from artgen.export.numbers import exact, parsed

VISUAL_GROUP, COLLISION_GROUP = "2", "3"
KINDS = {"revolute": "hinge", "continuous": "hinge", "prismatic": "slide"}
BEYOND = 1e10
"""rad or m that no joint reaches; the far end of a tendon that is never stretched."""
FULL_INERTIA = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


def mjcf_text(obj: ArticulatedObject) -> str:
    """The whole model, fixed to the world; file paths are relative to the model."""
    root = ET.Element("mujoco", model=obj.asset_id)
    ET.SubElement(
        root, "compiler", angle="radian", autolimits="false", inertiafromgeom="false",
        balanceinertia="false", fusestatic="false", discardvisual="false",
        meshdir=".", texturedir=".",
    )  # fmt: skip
    # 1e-12 costs no time and keeps light movers on heavy bases exact.
    ET.SubElement(root, "option", timestep="0.002", integrator="implicitfast", tolerance="1e-12")
    visual = ET.SubElement(root, "visual")  # Opened alone, the asset has no other light.
    ET.SubElement(visual, "headlight", ambient="0.4 0.4 0.4", diffuse="0.6 0.6 0.6")
    root.append(_defaults())
    root.append(_assets(obj))
    world = ET.SubElement(root, "worldbody")
    frames = pivots(obj)
    bodies = {obj.base.name: ET.SubElement(world, "body", name=obj.base.name, pos="0 0 0")}
    for joint in obj.joints:
        offset = frames[joint.child] - frames[joint.parent]
        bodies[joint.child] = ET.SubElement(
            bodies[joint.parent], "body", name=joint.child, pos=exact(offset)
        )
    for part in obj.parts:
        # Nested bodies come last, behind the part's own inertia, joint and geoms.
        own = _own_elements(obj, part, frames[part.name])
        bodies[part.name][:0] = own
    if any(joint.mimic for joint in obj.joints):
        root.append(_equalities(obj))
    if any(joint.latch for joint in obj.joints):
        root.append(_latches(obj))
    ET.indent(root)
    return ET.tostring(root, encoding="unicode") + "\n"


def _defaults() -> ET.Element:
    """Stiffer stops than MuJoCo's (a 43 kg door overshoots by 0.2 instead of 4 degrees), dry joints
    that hold still (default friction creeps by 0.3 mm/s), and contact as of wood on wood."""
    default = ET.Element("default")
    ET.SubElement(default, "joint", solreflimit="0.005 1", solimpfriction="0.999 0.999 0.001 0.5 2")
    visual = ET.SubElement(default, "default", {"class": "visual"})
    ET.SubElement(
        visual, "geom", type="mesh", material="atlas", group=VISUAL_GROUP,
        contype="0", conaffinity="0", density="0",
    )  # fmt: skip
    collision = ET.SubElement(default, "default", {"class": "collision"})
    ET.SubElement(
        collision, "geom", group=COLLISION_GROUP, condim="3", friction="0.6 0.005 0.0001",
        solref="0.005 1", rgba="0.6 0.7 0.8 0.4",
    )  # fmt: skip
    return default


def _assets(obj: ArticulatedObject) -> ET.Element:
    """`shell`: visual meshes are placed by their surface; the volume rule of the default refuses
    thin ones."""
    asset = ET.Element("asset")
    image = atlas_path(obj.asset_id)
    ET.SubElement(asset, "texture", name="atlas", type="2d", file=image, colorspace="sRGB")
    ET.SubElement(asset, "material", name="atlas", texture="atlas", specular="0.2")
    for part in obj.parts:
        path = mesh_path(obj.asset_id, part.name)
        ET.SubElement(asset, "mesh", name=Path(path).stem, file=path, inertia="shell")
        for piece in collision_pieces(obj.asset_id, part):
            if isinstance(piece, HullPiece):
                ET.SubElement(
                    asset, "mesh", name=_hull_name(piece), file=piece.file, inertia="convex"
                )
    return asset


def _hull_name(piece: HullPiece) -> str:
    return f"{Path(piece.file).stem}_hull"


def _own_elements(obj: ArticulatedObject, part: Part, pivot: Floats) -> list[ET.Element]:
    tensor = [part.mass.inertia[i, j] for i, j in FULL_INERTIA]
    elements = [
        ET.Element(
            "inertial",
            pos=exact(part.mass.center - pivot),
            mass=exact(part.mass.mass),
            fullinertia=exact(tensor),
        )
    ]
    if (joint := obj.joint_of(part.name)) is not None:
        elements.append(joint_element(joint))
    mesh = Path(mesh_path(obj.asset_id, part.name)).stem
    visual = {"name": f"{part.name}_visual", "class": "visual", "mesh": mesh, "pos": exact(-pivot)}
    elements.append(ET.Element("geom", visual))
    pieces = collision_pieces(obj.asset_id, part)
    elements += [_collision_element(part.name, piece, pivot) for piece in pieces]
    elements += [_site_element(grip, pivot) for grip in part.grips]
    return elements


def _site_element(grip: Grip, pivot: Floats) -> ET.Element:
    """The frame of a grip, in a group that viewers hide."""
    frame = grip_frame(grip)
    axes = exact(frame[:3, :2].T.ravel())
    place = exact(frame[:3, 3] - pivot)
    return ET.Element("site", name=grip.name, pos=place, xyaxes=axes, group=COLLISION_GROUP)


def _collision_element(part: str, piece: BoxPiece | HullPiece, pivot: Floats) -> ET.Element:
    attributes = {"name": f"{part}_collision_{piece.index}", "class": "collision"}
    if isinstance(piece, BoxPiece):
        half, place = exact(piece.size / 2.0), exact(piece.center - pivot)
        return ET.Element("geom", attributes | {"type": "box", "size": half, "pos": place})
    shape = {"type": "mesh", "mesh": _hull_name(piece), "pos": exact(-pivot)}
    return ET.Element("geom", attributes | shape)


def joint_element(joint: Joint) -> ET.Element:
    """`<joint>` at its body's origin."""
    attributes = {
        "name": joint.name,
        "type": KINDS[joint.type],
        "axis": exact(joint.axis),
        "limited": "false" if joint.limit is None else "true",
        "frictionloss": exact(joint.friction),
        "damping": exact(joint.damping),
        "actuatorfrclimited": "true",
        "actuatorfrcrange": exact((-joint.effort, joint.effort)),
    }
    if joint.limit is not None:
        attributes["range"] = exact((joint.limit.lower, joint.limit.upper))
    if joint.spring is not None:
        attributes["stiffness"] = exact(joint.spring.stiffness)
        attributes["springref"] = exact(joint.spring.reference)
    return ET.Element("joint", attributes)


def _equalities(obj: ArticulatedObject) -> ET.Element:
    equality = ET.Element("equality")
    for joint in obj.joints:
        if joint.mimic is not None:
            curve = exact((joint.mimic.offset, joint.mimic.multiplier, 0.0, 0.0, 0.0))
            ET.SubElement(
                equality, "joint", joint1=joint.name, joint2=joint.mimic.joint, polycoef=curve
            )
    return equality


def _latches(obj: ArticulatedObject) -> ET.Element:
    """Tendons along one joint each. MuJoCo pulls a tendon that is shorter than its spring's length
    by stiffness times what it lacks; with a negative stiffness it shortens it further, which is
    -force (1 - q / reach) up to `reach` and nothing beyond."""
    tendons = ET.Element("tendon")
    for joint in obj.joints:
        if joint.latch is not None:
            stiffness, lengths = -joint.latch.force / joint.latch.reach, (joint.latch.reach, BEYOND)
            fixed = ET.SubElement(
                tendons, "fixed", name=f"{joint.name}_latch", stiffness=exact(stiffness),
                springlength=exact(lengths),
            )  # fmt: skip
            ET.SubElement(fixed, "joint", joint=joint.name, coef="1")
    return tendons


def load_kinematics(folder: Path) -> FileKinematics:
    """Parts and joints of `folder`/asset.xml in the object frame; MJCF has no velocity limit.

    A latch's force comes back within one rounding of a product.
    """
    root = ET.parse(folder / MJCF).getroot()
    mimics = {e.attrib["joint1"]: _file_mimic(e) for e in root.iterfind("equality/joint")}
    latches = dict(_file_latch(e) for e in root.iterfind("tendon/fixed"))
    masses: dict[str, FileMass | None] = {}
    joints: list[FileJoint] = []
    grips: list[FileGrip] = []
    base = next(root.iterfind("worldbody/body"))
    waiting: list[tuple[ET.Element, str, Floats]] = [(base, "", np.zeros(3))]
    while waiting:
        body, parent, frame = waiting.pop(0)
        name, pivot = body.attrib["name"], frame + parsed(body.attrib["pos"])
        masses[name] = _file_mass(body, pivot)
        grips += [_file_grip(e, name, pivot) for e in body.iterfind("site")]
        own = [_file_joint(e, parent, name, pivot, mimics) for e in body.iterfind("joint")]
        joints += [replace(joint, latch=latches.get(joint.name)) for joint in own]
        waiting += [(child, name, pivot) for child in body.iterfind("body")]
    return FileKinematics(
        base=base.attrib["name"], masses=masses, joints=tuple(joints), grips=tuple(grips)
    )


def _file_grip(site: ET.Element, part: str, pivot: Floats) -> FileGrip:
    x, y = np.reshape(parsed(site.attrib["xyaxes"]), (2, 3))
    turn = np.stack([x, y, np.cross(x, y)], axis=1)
    frame = rigid(turn, pivot + parsed(site.attrib["pos"]))
    return FileGrip(name=site.attrib["name"], part=part, frame=frame)


def _file_mimic(element: ET.Element) -> Mimic:
    offset, multiplier = parsed(element.attrib["polycoef"])[:2]
    return Mimic(joint=element.attrib["joint2"], multiplier=multiplier, offset=offset)


def _file_latch(tendon: ET.Element) -> tuple[str, Latch]:
    """The joint that a tendon of `_latches` runs along, and what it stands for."""
    reach, stiffness = parsed(tendon.attrib["springlength"])[0], float(tendon.attrib["stiffness"])
    joint = next(tendon.iterfind("joint")).attrib["joint"]
    return joint, Latch(force=-stiffness * reach, reach=reach)


def _file_mass(body: ET.Element, pivot: Floats) -> FileMass:
    numbers = next(body.iterfind("inertial")).attrib
    tensor = np.zeros((3, 3))
    for value, (i, j) in zip(parsed(numbers["fullinertia"]), FULL_INERTIA, strict=True):
        tensor[i, j] = tensor[j, i] = value
    center = pivot + parsed(numbers["pos"])
    return FileMass(mass=float(numbers["mass"]), center=center, inertia=tensor)


def _file_joint(
    element: ET.Element, parent: str, child: str, pivot: Floats, mimics: dict[str, Mimic]
) -> FileJoint:
    numbers = element.attrib
    limits = parsed(numbers["range"]) if numbers["limited"] == "true" else (None, None)
    turning: JointType = "continuous" if limits[0] is None else "revolute"
    spring = None
    if "stiffness" in numbers:
        spring = Spring(
            stiffness=float(numbers["stiffness"]), reference=float(numbers["springref"])
        )
    return FileJoint(
        name=numbers["name"],
        type="prismatic" if numbers["type"] == "slide" else turning,
        parent=parent,
        child=child,
        axis=vector(np.array(parsed(numbers["axis"]))),
        origin=vector(pivot),
        lower=limits[0],
        upper=limits[1],
        friction=float(numbers["frictionloss"]),
        damping=float(numbers["damping"]),
        effort=parsed(numbers["actuatorfrcrange"])[1],
        velocity=None,
        spring=spring,
        latch=None,
        mimic=mimics.get(numbers["name"]),
    )
