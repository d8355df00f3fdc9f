"""A MJCF under test: read by MuJoCo from bytes that we have read, and nothing else."""

import copy
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path, PurePosixPath

import mujoco
import numpy as np

from artgen.articulation.types import Mimic, Spring
from artgen.core.errors import ArtgenError, ExportError
from artgen.core.transform import inverted, rigid
from artgen.validate.assembly import Assembly, FileJoint, Geometry, LinkMass, assembled
from artgen.validate.foreign_subject import ForeignSubject
from artgen.validate.mjcf_geoms import geom_mesh, turn_of
from artgen.validate.physics import quiet
from artgen.validate.places import inside, read_capped
from artgen.validate.stated import StatedBody, StatedJoint
from artgen.validate.subject import Link
from artgen.validate.xmlfile import read_xml

WORLD = "world"
MAX_INCLUDES = 64
FOLDERS = {"mesh": "meshdir", "hfield": "assetdir", "skin": "assetdir", "texture": "texturedir"}
"""Elements that name files, and the compiler's attribute that tells where they lie."""
TYPES = {
    mujoco.mjtJoint.mjJNT_HINGE: "revolute",
    mujoco.mjtJoint.mjJNT_SLIDE: "prismatic",
    mujoco.mjtJoint.mjJNT_BALL: "planar",
    mujoco.mjtJoint.mjJNT_FREE: "floating",
}


@dataclass(frozen=True, kw_only=True, eq=False)
class MjcfSubject(ForeignSubject):
    """A MuJoCo model of anyone's, judged with its base fixed and every joint at qpos = 0."""

    @cached_property
    def document(self) -> ET.Element:
        """The root element with every include in its place."""
        return self._included(read_xml(self.source.file), [self.source.file.resolve()])

    def _included(self, element: ET.Element, opened: list[Path]) -> ET.Element:
        """An element whose `<include>` children are replaced by what they name."""
        children = []
        for child in element:
            if child.tag != "include":
                children.append(self._included(child, opened))
                continue
            path = inside(self.source.root, self.source.file.parent, child.get("file", ""))
            if path in opened or len(opened) > MAX_INCLUDES:
                raise ExportError(f"{path.name} is included twice; MuJoCo refuses it")
            opened.append(path)
            children += list(self._included(read_xml(path), opened))
        whole = ET.Element(element.tag, element.attrib)
        whole.extend(children)
        return whole

    def files(self) -> Iterable[Path]:
        """The file, what it includes, and the meshes and images that it names."""
        yield self.source.file
        with suppress(ArtgenError, OSError, ET.ParseError, ValueError):
            for child in read_xml(self.source.file).iter("include"):
                yield inside(self.source.root, self.source.file.parent, child.get("file", ""))
            for _, path in self._assets(self.document):
                yield path

    def problems(self) -> Iterator[tuple[str, str]]:
        """The file itself, and the files that it names."""
        file = self.source.file.name
        try:
            if self.document.tag != "mujoco":
                yield file, f"root element <{self.document.tag}> instead of <mujoco>"
                return
            for _ in self._assets(self.document):
                pass
            self.read_spec()
        except OSError as error:
            yield file, f"cannot be opened: {error.strerror}"
        except (ET.ParseError, ValueError, ArtgenError) as error:
            yield file, " ".join(f"cannot be parsed: {error}".split())

    def _assets(self, document: ET.Element) -> Iterator[tuple[ET.Element, Path]]:
        """Every element that names a file, with that file; ExportError where it leads outside."""
        compilers = {k: v for c in document.iter("compiler") for k, v in c.attrib.items()}
        stripped = compilers.get("strippath") == "true"
        for element in document.iter():
            if FILE_KEYS & set(element.attrib) and element.tag not in FOLDERS:
                raise ExportError(f"<{element.tag}> names a file; that is not read here")
        for tag, key in FOLDERS.items():
            folder = compilers.get(key, compilers.get("assetdir", ""))
            for element in document.iter(tag):
                for name in FILE_KEYS & set(element.attrib):
                    text = element.attrib[name]
                    text = PurePosixPath(text).name if stripped else text
                    text = f"{folder}/{text}" if folder else text
                    yield element, inside(self.source.root, self.source.file.parent, text)

    def read_spec(self) -> mujoco.MjSpec:
        """What MuJoCo reads, files as bytes under names of ours, everything named.

        Raises:
            ValueError: MuJoCo refuses it.
            ExportError: it names a file outside of its folder.
        """
        quiet()
        document, assets = copy.deepcopy(self.document), dict[str, bytes]()
        for element, path in list(self._assets(document)):
            key = f"asset{len(assets)}{path.suffix.lower()}"
            assets[key] = read_capped(path)
            name = next(iter(FILE_KEYS & set(element.attrib)))
            if element.tag != "texture" or "name" in element.attrib:
                element.attrib.setdefault("name", PurePosixPath(element.attrib[name]).stem)
            element.set(name, key)
        for compiler in document.iter("compiler"):
            for attribute in ("meshdir", "texturedir", "assetdir", "strippath"):
                compiler.attrib.pop(attribute, None)
        spec = mujoco.MjSpec.from_string(ET.tostring(document, encoding="unicode"), assets=assets)
        for kind, listed in (("body", spec.bodies[1:]), ("joint", spec.joints)):
            for number, element in enumerate(listed):
                element.name = element.name or f"{kind}_{number}"
        for joint in list(spec.joints):
            if joint.type == mujoco.mjtJoint.mjJNT_FREE and joint.parent.parent.name == WORLD:
                spec.delete(joint)
        return spec

    def spec(self, file: str) -> mujoco.MjSpec:
        """A spec of its own for each who asks."""
        try:
            return self.read_spec()
        except ArtgenError as error:
            raise ValueError(str(error)) from error

    @cached_property
    def stated_links(self) -> Mapping[str, list[str]]:
        """Names of the bodies, and of one link more for each further joint of a body."""
        names = [WORLD]
        for body in self.read_spec().bodies[1:]:
            names += [_between(body.name, k) for k in range(len(body.joints) - 1)]
            names.append(body.name)
        return {self.source.file.name: names}

    @cached_property
    def stated_joints(self) -> list[StatedJoint]:
        """Joints as MuJoCo reads them, defaults filled in; bodies without one are fixed."""
        spec = self.read_spec()
        turns = np.pi / 180.0 if spec.compiler.degree else 1.0
        return [
            joint
            for body in spec.bodies[1:]
            for joint in _stated(self.source.file.name, body, turns)
        ]

    @cached_property
    def stated_bodies(self) -> list[StatedBody]:
        """The `<inertial>` of each body that has one."""
        return [
            _stated_body(self.source.file.name, body)
            for body in self.read_spec().bodies[1:]
            if body.explicitinertial
        ]

    @cached_property
    def whole(self) -> mujoco.MjModel:
        """The model with its visual geoms; ValueError where MuJoCo refuses it."""
        spec = self.spec(self.source.file.name)
        spec.compiler.fusestatic = False
        return spec.compile()

    @cached_property
    def assembly(self) -> Assembly:
        """Parts and joints in the object frame, which is the world's, at qpos = 0."""
        model = self.whole
        data = mujoco.MjData(model)
        data.qpos[:] = 0.0
        mujoco.mj_kinematics(model, data)
        poses = {WORLD: np.eye(4)}
        for i in range(1, model.nbody):
            poses[model.body(i).name] = rigid(data.xmat[i].reshape(3, 3), data.xpos[i])
        mimics = _mimics(model)
        joints = []
        for stated in self.stated_joints:
            child = poses.setdefault(stated.child, poses[_body_of(stated.child)])
            known = model.joint(stated.name) if stated.moves else None
            if known is not None:
                stated = _exact(stated, known, data.xaxis[known.id] @ child[:3, :3])
            joints.append(
                FileJoint(
                    stated=stated,
                    parent_from_joint=inverted(poses[stated.parent]) @ child,
                    anchor=None if known is None else data.xanchor[known.id],
                    spring=None if known is None else _spring(known),
                    mimic=mimics.get(stated.name),
                )
            )
        names = self.stated_links[self.source.file.name]
        return assembled(names, _masses(model), joints)

    @property
    def links(self) -> Mapping[str, Link]:
        """Bodies of the model alone."""
        real = self.assembly.links.items()
        return {name: link for name, link in real if name == _body_of(name)}

    @cached_property
    def visuals(self) -> Sequence[Geometry]:
        """Geoms without contact; all of them where every geom has contact."""
        shapes = list(self._geoms(contact=False))
        return shapes or list(self._geoms(contact=True))

    @cached_property
    def contact_shapes(self) -> Sequence[Geometry]:
        """Geoms with contact."""
        return list(self._geoms(contact=True))

    def _geoms(self, *, contact: bool) -> Iterator[Geometry]:
        model = self.whole
        # MuJoCo lets two geoms meet where the type of one is in the affinity of the other.
        types = int(np.bitwise_or.reduce(model.geom_contype, initial=0))
        affinities = int(np.bitwise_or.reduce(model.geom_conaffinity, initial=0))
        unseen = (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD)
        for i in range(model.ngeom):
            own = model.geom_contype[i] & affinities | model.geom_conaffinity[i] & types
            touches = bool(own)
            if touches != contact or model.geom_type[i] in unseen:
                continue
            body = model.body(model.geom_bodyid[i]).name
            yield Geometry(
                link=body,
                label=f"{body}, geom {i}",
                link_from_shape=rigid(turn_of(model.geom_quat[i]), model.geom_pos[i]),
                read=partial(geom_mesh, model, i),
            )


FILE_KEYS = frozenset(
    ("file", "fileright", "fileleft", "fileup", "filedown", "filefront", "fileback")
)


def _between(body: str, number: int) -> str:
    """The link between two joints of one body."""
    return f"{body}|{number}"


def _body_of(link: str) -> str:
    return link.partition("|")[0]


def _stated(file: str, body: mujoco.MjsBody, turns: float) -> Iterator[StatedJoint]:
    """The joints of a body in a chain; one fixed joint where it has none."""
    parent = body.parent.name
    if not body.joints:
        yield _joint_row(file, f"{body.name}_fixed", "fixed", parent, body.name)
    for number, joint in enumerate(body.joints):
        last = number == len(body.joints) - 1
        child = body.name if last else _between(body.name, number)
        kind, (lower, upper) = TYPES[joint.type], joint.range
        unit = turns if kind == "revolute" else 1.0
        off = joint.limited == mujoco.mjtLimited.mjLIMITED_FALSE or lower == upper == 0.0
        if kind == "revolute" and off:
            kind = "continuous"
        row = _joint_row(file, joint.name, kind, parent, child)
        yield replace(
            row,
            axis=tuple(joint.axis / (np.linalg.norm(joint.axis) or 1.0)),
            origin=tuple(joint.pos),
            lower=np.nan if off else float(lower * unit),
            upper=np.nan if off else float(upper * unit),
            friction=float(np.ravel(joint.frictionloss)[0]),
            damping=float(np.ravel(joint.damping)[0]),
            effort=float(joint.actfrcrange[1]) if joint.actfrcrange[1] > 0.0 else None,
        )
        parent = child


def _joint_row(file: str, name: str, kind: str, parent: str, child: str) -> StatedJoint:
    return StatedJoint(
        file=file, name=name, type=kind, parent=parent, child=child, axis=(1.0, 0.0, 0.0),
        origin=(0.0, 0.0, 0.0), lower=np.nan, upper=np.nan, friction=None, damping=None,
        effort=None, velocity=None,
    )  # fmt: skip


def _stated_body(file: str, body: mujoco.MjsBody) -> StatedBody:
    xx, yy, zz, xy, xz, yz = body.fullinertia
    tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    if not np.isfinite(xx):
        turn = turn_of(body.iquat)
        tensor = turn @ np.diag(body.inertia) @ turn.T
    return StatedBody(
        file=file, name=body.name, mass=float(body.mass), center=body.ipos.copy(), inertia=tensor
    )


def _exact(stated: StatedJoint, known: object, axis: np.ndarray) -> StatedJoint:  # type: ignore[type-arg]
    """A joint with its axis in the child's frame and the limits of the compiled model."""
    lower, upper = known.range  # type: ignore[attr-defined]
    limits = {"lower": float(lower), "upper": float(upper)} if stated.limited else {}
    return replace(stated, axis=tuple(axis.tolist()), **limits)  # type: ignore[arg-type]


def _spring(known: object) -> Spring | None:
    stiffness = float(np.ravel(known.stiffness)[0])  # type: ignore[attr-defined]
    reference = float(np.ravel(known.qpos_spring)[0])  # type: ignore[attr-defined]
    return Spring(stiffness=stiffness, reference=reference) if stiffness > 0.0 else None


def _mimics(model: mujoco.MjModel) -> dict[str, Mimic]:
    """Joint name to the linear equality that ties it to another."""
    found = {}
    for i in range(model.neq):
        second = int(model.eq_obj2id[i])
        if model.eq_type[i] == mujoco.mjtEq.mjEQ_JOINT and second >= 0:
            offset, multiplier = model.eq_data[i, :2].tolist()
            found[model.joint(model.eq_obj1id[i]).name] = Mimic(
                joint=model.joint(second).name, multiplier=multiplier, offset=offset
            )
    return found


def _masses(model: mujoco.MjModel) -> dict[str, LinkMass]:
    """Compiled mass properties of the bodies that have mass."""
    found = {}
    for i in range(1, model.nbody):
        if model.body_mass[i] > 0.0:
            turn = turn_of(model.body_iquat[i])
            tensor = turn @ np.diag(model.body_inertia[i]) @ turn.T
            found[model.body(i).name] = LinkMass(
                mass=float(model.body_mass[i]), center=model.body_ipos[i].copy(), tensor=tensor
            )
    return found
