"""A MuJoCo model of our own making, for formats that MuJoCo does not read."""

from collections.abc import Mapping

import mujoco
import numpy as np

from artgen.core.mesh import TriMesh
from artgen.core.transform import apply, inverted
from artgen.export.mjcf import BEYOND
from artgen.validate.assembly import Assembly, Geometry
from artgen.validate.physics import quiet
from artgen.validate.subject import SubjectPart


def built_spec(
    name: str, assembly: Assembly, contact_meshes: Mapping[Geometry, TriMesh | str]
) -> mujoco.MjSpec:
    """One body for each part, its frame that of the link it is named by; the base is fixed.

    Raises:
        ValueError: a collision shape cannot be read, or a part has neither mass nor shape.
    """
    quiet()
    spec = mujoco.MjSpec()
    spec.modelname = name
    spec.compiler.degree = False
    spec.compiler.autolimits = True
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    bodies: dict[str, mujoco.MjsBody] = {}
    for part in assembly.parts:
        bodies[part.name] = _add_body(spec, assembly, part, bodies)
    for joint in assembly.joints:
        _add_joint(spec, bodies[joint.child], assembly, joint.name)
    for number, (shape, mesh) in enumerate(contact_meshes.items()):
        if isinstance(mesh, str):
            raise ValueError(f"{shape.label}: {mesh}")
        owner = assembly.links[shape.link].part
        own = apply(inverted(assembly.links[owner].object_from_link), mesh.vertices)
        added = spec.add_mesh(name=f"piece_{number}")
        added.uservert, added.userface = own.ravel(), np.asarray(mesh.faces).ravel()
        bodies[owner].add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname=f"piece_{number}")
    return spec


def _add_body(
    spec: mujoco.MjSpec,
    assembly: Assembly,
    part: SubjectPart,
    bodies: Mapping[str, mujoco.MjsBody],
) -> mujoco.MjsBody:
    joint = next((j for j in assembly.joints if j.child == part.name), None)
    own = assembly.links[part.name].object_from_link
    above = np.eye(4) if joint is None else assembly.links[joint.parent].object_from_link
    parent_from_own = inverted(above) @ own
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(parent_from_own[:3, :3]).ravel())
    holder = spec.worldbody if joint is None else bodies[joint.parent]
    body = holder.add_body(name=part.name, pos=parent_from_own[:3, 3], quat=quaternion)
    if part.mass is not None:
        turn = own[:3, :3]
        tensor = turn.T @ part.mass.inertia @ turn
        body.explicitinertial = True
        body.mass, body.ipos = part.mass.mass, apply(inverted(own), part.mass.center)
        body.fullinertia = tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return body


def _add_joint(spec: mujoco.MjSpec, body: mujoco.MjsBody, assembly: Assembly, name: str) -> None:
    joint = next(j for j in assembly.joints if j.name == name)
    own = inverted(assembly.links[joint.child].object_from_link)
    slides = joint.type == "prismatic"
    added = body.add_joint(
        name=name,
        type=mujoco.mjtJoint.mjJNT_SLIDE if slides else mujoco.mjtJoint.mjJNT_HINGE,
        axis=own[:3, :3] @ joint.axis,
        pos=apply(own, joint.origin),
    )
    added.damping[0], added.frictionloss = joint.damping, joint.friction
    if joint.spring is not None:
        added.stiffness[0], added.springref = joint.spring.stiffness, joint.spring.reference
    if joint.latch is not None:
        catch = spec.add_tendon(
            name=f"{name}_latch",
            stiffness=-joint.latch.force / joint.latch.reach,
            springlength=(joint.latch.reach, BEYOND),
        )
        catch.wrap_joint(name, 1.0)
    if joint.limit is not None:
        added.range = (joint.limit.lower, joint.limit.upper)
