"""`artgen render`: renders what is missing, in any number of processes, and says what is wrong."""

import hashlib
import shutil
from pathlib import Path

import pytest

from artgen.core.errors import UsageError
from artgen.export import Bundle
from renders.cli import render

SMALL = ["--views", "1", "--states", "1", "--size", "24", "--accuracy", "2spp"]


def run_folder(bundle: Bundle, root: Path) -> Path:
    """Three copies of the chest; one is damaged."""
    for index in ("000001", "000002", "000003"):
        shutil.copytree(bundle.folder, root / "assets" / "chest" / index)
    for index in ("000002", "000003"):
        copy = root / "assets" / "chest" / index
        manifest = copy / "manifest.json"
        manifest.write_text(manifest.read_text().replace("chest_000001", f"chest_{index}"))
        for mesh in sorted((copy / "meshes").iterdir()):
            mesh.rename(mesh.with_name(mesh.name.replace("000001", index)))
    (root / "assets" / "chest" / "000003" / "asset.glb").write_bytes(b"no GLB")
    return root


def hashes(out: Path) -> dict[str, str]:
    files = [path for path in sorted(out.rglob("samples/**/*")) if path.is_file()]
    files.append(out / "contact_sheet.png")
    return {
        path.relative_to(out).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
    }


@pytest.mark.blender
def test_a_bad_asset_fails_alone_and_workers_do_not_show(
    bundle: Bundle, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    one = run_folder(bundle, tmp_path / "one")
    assert render([str(one), *SMALL, "--workers", "1"]) == 1
    said = capsys.readouterr().out
    assert "2 of 3 assets rendered" in said
    assert "failed chest_000003: Blender job 'render' failed" in said
    two = run_folder(bundle, tmp_path / "two")
    assert render([str(two), *SMALL, "--workers", "2"]) == 1
    assert hashes(one) == hashes(two)
    shutil.rmtree(one / "assets" / "chest" / "000003")
    (one / "samples" / "chest" / "000002.tar").unlink()
    assert render([str(one), *SMALL, "--workers", "1"]) == 0
    assert hashes(one) == hashes(two)
    assert not list((one / "work" / "render").iterdir())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--views", "0"], "--views 0 is too small; ask for at least 1"),
        (["--size", "8"], "--size 8 is too small; ask for at least 16"),
        (["--workers", "-1"], "--workers -1 is too small"),
    ],
)
def test_nonsense_is_refused(tmp_path: Path, words: list[str], said: str) -> None:
    with pytest.raises(UsageError, match=said):
        render([str(tmp_path), *words])


def test_a_missing_folder_is_told(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="no such folder; name a run of `artgen generate`"):
        render([str(tmp_path / "nowhere")])
