"""Where names of files in strangers' assets lead, in the layouts that ROS packages have."""

from pathlib import Path

import pytest

from artgen.core.errors import ExportError
from artgen.validate.places import inside


def put(path: Path) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("x")
    return path


@pytest.mark.parametrize(
    ("root", "text", "expected"),
    [
        ("ws/pkg", "../meshes/b.stl", "ws/pkg/meshes/b.stl"),
        ("ws/pkg", "package://pkg/meshes/b.stl", "ws/pkg/meshes/b.stl"),
        ("ws", "package://pkg/meshes/b.stl", "ws/pkg/meshes/b.stl"),
        ("ws", "package://other/c.stl", "ws/other/c.stl"),
        ("ws", "package://ws/other/c.stl", "ws/other/c.stl"),
        ("ws", "package://pkg\\meshes/b.stl", None),
        ("ws/pkg", "package://other/c.stl", None),
        ("ws/pkg/urdf", "../meshes/b.stl", None),
        ("ws/pkg/urdf", "package://pkg/meshes/b.stl", None),
        ("ws", "package://pkg/../../secret.stl", None),
        ("ws", "package://../secret.stl", None),
        ("ws", "package:///etc/passwd", None),
        ("ws", "package://pkg//etc/passwd", None),
        ("ws", "package://pkg", None),
        ("ws", "package://pkg/b\0.stl", None),
        ("ws", "package://pkg\0/b.stl", None),
        ("ws", f"package://pkg/{'b' * 300}.stl", None),
        ("ws", f"package://{'p' * 300}/b.stl", None),
    ],
)
def test_packages_are_folders_above_or_beside_and_never_outside(
    root: str, text: str, expected: str | None, tmp_path: Path
) -> None:
    for name in ("ws/pkg/urdf/x.urdf", "ws/pkg/meshes/b.stl", "ws/other/c.stl", "secret.stl"):
        put(tmp_path / name)
    base = tmp_path / "ws/pkg/urdf"
    if expected is None:
        with pytest.raises(ExportError):
            inside(tmp_path / root, base, text)
    else:
        assert inside(tmp_path / root, base, text) == (tmp_path / expected).resolve()


def test_the_nearest_package_that_holds_the_file_counts(tmp_path: Path) -> None:
    """A package whose inner folder has its name, as Python packages have."""
    outer = put(tmp_path / "pkg/meshes/b.stl")
    put(tmp_path / "pkg/pkg/x.urdf")
    assert inside(tmp_path, tmp_path / "pkg/pkg", "package://pkg/meshes/b.stl") == outer.resolve()
    inner = put(tmp_path / "pkg/pkg/meshes/b.stl")
    assert inside(tmp_path, tmp_path / "pkg/pkg", "package://pkg/meshes/b.stl") == inner.resolve()


def test_a_package_behind_a_link_has_both_names(tmp_path: Path) -> None:
    put(tmp_path / "store/pkg_v1/b.stl")
    (tmp_path / "pkg").symlink_to(tmp_path / "store/pkg_v1", target_is_directory=True)
    for name in ("pkg", "pkg_v1"):
        assert inside(tmp_path / "pkg", tmp_path / "pkg", f"package://{name}/b.stl").is_file()
    wide = inside(tmp_path / "store", tmp_path / "pkg", "package://pkg_v1/b.stl")
    assert wide == (tmp_path / "store/pkg_v1/b.stl").resolve()
