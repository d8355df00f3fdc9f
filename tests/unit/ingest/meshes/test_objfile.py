"""OBJ and MTL of strangers: every way to write a face, and materials by content."""

from pathlib import Path

import numpy as np
import pytest

from artgen.core.errors import IngestError
from artgen.ingest.meshes.objfile import read_mtl, read_obj_soup
from artgen.ingest.meshes.soup import Look, Soup

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
UV = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"


def read(root: Path, text: str) -> Soup:
    (root / "m.obj").write_text(text)
    return read_obj_soup(root / "m.obj", root)


@pytest.mark.parametrize(
    "faces",
    [
        "f 1 2 3\nf 1 3 4\n",
        "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n",
        "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n",
        "f 1/1 2/2 3/3 4/4\n",
        "f -4 -3 -2 -1\n",
        "f 1 2 3\nf 1/1 3/3 4/4\n",
        "f 1 2 \\\n 3 4\n",
    ],
)
def test_faces_are_read_however_they_are_written(faces: str, tmp_path: Path) -> None:
    soup = read(tmp_path, SQUARE + UV + "vn 0 0 1\n" + faces)
    assert soup.faces.tolist() == [[0, 1, 2], [0, 2, 3]]


@pytest.mark.parametrize(("old", "new"), [(" ", "\t"), ("\n", "\n  "), ("\n", "\r\n")])
def test_any_blanks_divide_words(old: str, new: str, tmp_path: Path) -> None:
    """Tabs, and lines that are set in: `it has no face`."""
    mtl = "newmtl my_wood\nKd 0.1 0.2 0.3\n"
    (tmp_path / "m.mtl").write_bytes(mtl.replace(old, new).encode())
    text = SQUARE + UV + "mtllib m.mtl\nusemtl my_wood\nf 1/1 2/2 3/3\nf 1/1 3/3 \\\n4/4\n"
    (tmp_path / "m.obj").write_bytes(text.replace(old, new).encode())
    soup = read_obj_soup(tmp_path / "m.obj", tmp_path)
    plain = read(tmp_path, text)
    assert soup.faces.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert soup.uv.tolist() == plain.uv.tolist()
    assert soup.looks[soup.look[0]].color == (0.1, 0.2, 0.3)


def test_texture_points_go_with_their_corners_and_missing_ones_are_nan(tmp_path: Path) -> None:
    soup = read(tmp_path, SQUARE + UV + "f 1/1 2/2 3/3\nf 1 3 4\n")
    assert soup.uv[0].tolist() == [[0, 0], [1, 0], [1, 1]]
    assert np.isnan(soup.uv[1]).all()


def test_equal_names_in_different_files_are_different_materials(tmp_path: Path) -> None:
    looks = []
    for name, color in (("a", "1 0 0"), ("b", "0 0 1")):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "m.mtl").write_text(f"newmtl material_0_0\nKd {color}\n")
        soup = read(folder, f"mtllib m.mtl\n{SQUARE}usemtl material_0_0\nf 1 2 3\n")
        looks.append(soup.looks[soup.look[0]])
    assert looks[0].digest != looks[1].digest
    assert [look.color for look in looks] == [(1.0, 0.0, 0.0), (0.0, 0.0, 1.0)]


def test_faces_before_any_usemtl_and_of_unknown_ones_are_gray(tmp_path: Path) -> None:
    soup = read(tmp_path, SQUARE + "f 1 2 3\nusemtl nowhere\nf 1 3 4\n")
    assert [soup.looks[k] for k in soup.look] == [Look(), Look()]


def test_numbers_of_an_mtl_are_read_and_nonsense_is_passed_over(tmp_path: Path) -> None:
    (tmp_path / "m.mtl").write_text(
        "newmtl glass\nd 0.3\nKd 0.1 0.2 0.3\nNs 98\nnewmtl odd\nd x\nKd 1 nan 0\nNs\n"
        "newmtl steel\nKs 0.8 0.8 0.8\nTr 0.25\n"
    )
    looks = read_mtl(tmp_path / "m.mtl", tmp_path)
    assert looks["glass"].opacity == 0.3
    # 2 / (98 + 2) is 0.02; its root 0.1414.
    assert looks["glass"].roughness == pytest.approx(0.02**0.5, rel=1e-15)
    assert looks["odd"] == Look()
    assert (looks["steel"].metallic, looks["steel"].opacity) == (1.0, 0.75)


def test_images_with_blanks_and_behind_options_are_found_none_outside(tmp_path: Path) -> None:
    root = tmp_path / "in"
    (root / "objs").mkdir(parents=True)
    (root / "images").mkdir()
    (root / "images/my wood.png").write_bytes(b"wood")
    (root / "images/a.jpg").write_bytes(b"a")
    (tmp_path / "secret.png").write_bytes(b"secret")
    (root / "objs/m.mtl").write_text(
        "newmtl blank\nmap_Kd ../images/my wood.png\nnewmtl option\nmap_Kd -s 1 1 ../images/a.jpg\n"
        "newmtl out\nmap_Kd ../../secret.png\nnewmtl gone\nmap_Kd ../images/b.png\n"
        "newmtl text\nmap_Kd ../objs/m.mtl\n"
    )
    looks = read_mtl(root / "objs/m.mtl", root)
    assert {name: look.image for name, look in looks.items()} == {
        "blank": b"wood", "option": b"a", "out": None, "gone": None, "text": None
    }  # fmt: skip


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (SQUARE, "no face"),
        (SQUARE + "f 1 2 9\n", "not there"),
        (SQUARE + "f 0 1 2\n", "not there"),
        (SQUARE + "f 1 2 x\n", "malformed"),
        (SQUARE + "f 1 2 99999999999999999999\n", "malformed"),
        (SQUARE + "f 1 2 -99999999999999999999\n", "malformed"),
        (SQUARE + "f 1 2 3 99999999999999999999/1\n", "malformed"),
        (SQUARE + "f\n", "no face"),
        ("v 0 0\nf 1 1 1\n", "malformed"),
        ("v 0 0 inf\nv 0 0 0\nv 1 1 1\nf 1 2 3\n", "not finite"),
        ("\x00\xff binary", "no face"),
    ],
)
def test_what_is_no_mesh_is_refused(text: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(IngestError, match=told):
        read(tmp_path, text)


def test_vertex_colors_behind_coordinates_are_passed_over(tmp_path: Path) -> None:
    soup = read(tmp_path, "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n")
    assert soup.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
