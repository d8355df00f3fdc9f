"""Image encoders that supply semantics beside the patches: by name, frozen unless said."""

from model.network.encoders.protocol import Encoder
from model.network.encoders.registry import make_encoder

__all__ = ["Encoder", "make_encoder"]
