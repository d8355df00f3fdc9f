"""Which reader makes a subject of which format."""

from collections.abc import Callable, Mapping

from artgen.validate.bounds import Bounds
from artgen.validate.bundle_subject import BundleSubject
from artgen.validate.subject import Source, Subject

READERS: Mapping[str, Callable[..., Subject]] = {"bundle": BundleSubject}


def read_subject(source: Source, bounds: Bounds) -> Subject:
    """The subject at a source; nothing is read before a check asks for it."""
    return READERS[source.format](source=source, bounds=bounds)
