"""The record of a training run: one JSON line a step, the same for TensorBoard, rendered images."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from torch.utils.tensorboard import SummaryWriter

from artgen.core.jsonio import replace_atomically, write_bytes


class TrainLog:
    """Lines, curves and pictures of one run folder; what lies beyond `step` is cut off first."""

    def __init__(self, folder: Path, *, step: int) -> None:
        self.lines = folder / "log.jsonl"
        self.pictures = folder / "pictures"
        folder.mkdir(parents=True, exist_ok=True)
        _cut(self.lines, step)
        self.curves = SummaryWriter(folder / "tensorboard", purge_step=step)

    def write(self, step: int, values: Mapping[str, float]) -> None:
        """One line: the step and its values."""
        with self.lines.open("a", encoding="utf-8") as stream:
            stream.write(json.dumps({"step": step, **values}) + "\n")
        for name, value in values.items():
            self.curves.add_scalar(name, value, step)

    def picture(self, step: int, image: NDArray[np.uint8]) -> None:
        """One rendered image, (H, W, 3) sRGB."""
        path = self.pictures / f"step_{step:08d}.png"
        replace_atomically(path, lambda partial: Image.fromarray(image).save(partial, format="PNG"))
        self.curves.add_image("rendered", image, step, dataformats="HWC")

    def close(self) -> None:
        """Flush what TensorBoard holds back."""
        self.curves.close()


def read_lines(path: Path) -> list[dict[str, float]]:
    """All whole lines of a log; none where there is no file."""
    if not path.exists():
        return []
    text = path.read_text(encoding="utf-8")
    whole, _, _ = text.rpartition("\n")
    return [json.loads(line) for line in whole.splitlines()]


def _cut(path: Path, step: int) -> None:
    """Drop lines of steps that a resumed run will make again, and a half-written last one."""
    kept = [line for line in read_lines(path) if line["step"] <= step]
    if path.exists():
        write_bytes(path, "".join(json.dumps(line) + "\n" for line in kept).encode())
