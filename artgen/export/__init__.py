"""ArticulatedObject to files: GLB, OBJ, URDF, MJCF, USD, bundle; and back to kinematics."""

from collections.abc import Callable, Mapping
from pathlib import Path

from artgen.export import glb, mjcf, urdf, usd_joints
from artgen.export.bundle import Bundle, BundlePart, read_bundle
from artgen.export.kinematics import FileKinematics
from artgen.export.write import write_bundle

READERS: Mapping[str, Callable[[Path], FileKinematics]] = {
    "glb": glb.load_kinematics,
    "urdf": urdf.load_kinematics,
    "mjcf": mjcf.load_kinematics,
    "usd": usd_joints.load_kinematics,
}
"""Format to the function that reads parts and joints back from a bundle's folder."""

__all__ = [
    "READERS",
    "Bundle",
    "BundlePart",
    "FileKinematics",
    "read_bundle",
    "write_bundle",
]
