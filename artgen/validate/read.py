"""Which reader makes a subject of which format."""

from collections.abc import Callable, Mapping

from artgen.validate.bounds import Bounds
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.mjcf_subject import MjcfSubject
from artgen.validate.subject import Source, Subject
from artgen.validate.urdf_subject import UrdfSubject
from artgen.validate.usd_subject import UsdSubject

READERS: Mapping[str, Callable[..., Subject]] = {
    "bundle": BundleSubject,
    "urdf": UrdfSubject,
    "mjcf": MjcfSubject,
    "usd": UsdSubject,
}


def read_subject(source: Source, bounds: Bounds) -> Subject:
    """The subject at a source; nothing is read before a check asks for it."""
    return READERS[source.format](source=source, bounds=bounds)
