"""S3 and its kin, by obstore; needs the `s3` extra.

Region, endpoint and credentials come from the usual variables (`AWS_REGION`, `AWS_ENDPOINT_URL`,
`AWS_ACCESS_KEY_ID`, ...), which obstore reads. Its threads do not survive a fork: worker processes
that read an object store must be spawned.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path

import obstore
from obstore.exceptions import AlreadyExistsError, BaseError, NotFoundError, PreconditionError
from obstore.store import ObjectStore as Bucket
from obstore.store import from_url

from artgen.core.errors import ShardError
from artgen.dataset.store import Range


class ObjectStore:
    """The objects directly under a URL; near ranges are fetched at once (obstore: 1 MiB)."""

    def __init__(self, url: str) -> None:
        self.url = url

    @cached_property
    def _bucket(self) -> Bucket:
        with self._explained(""):
            return from_url(self.url)

    def __getstate__(self) -> dict[str, str]:
        return {"url": self.url}

    def where(self, name: str = "") -> str:
        """URL of an object."""
        return f"{self.url}/{name}" if name else self.url

    def sizes(self) -> Mapping[str, int]:
        """Of the objects under the URL, not below further slashes."""
        with self._explained(""):
            found = obstore.list_with_delimiter(self._bucket)["objects"]
        return dict(sorted((entry["path"].rpartition("/")[2], entry["size"]) for entry in found))

    def size(self, name: str) -> int | None:
        """Of an object."""
        try:
            with self._explained(name):
                return int(obstore.head(self._bucket, name)["size"])
        except FileNotFoundError:
            return None

    def read(self, name: str) -> bytes:
        """A whole object."""
        with self._explained(name):
            return bytes(obstore.get(self._bucket, name).bytes())

    def ranges(self, name: str, ranges: Sequence[Range]) -> list[bytes]:
        """Range requests, ten at a time."""
        asked = sorted({(offset, size) for offset, size in ranges if size})
        if not asked:
            return [b"" for _ in ranges]
        starts, lengths = zip(*asked, strict=True)
        with self._explained(name):
            data = obstore.get_ranges(self._bucket, name, starts=starts, lengths=lengths)
        found = dict(zip(asked, map(bytes, data), strict=True))
        return [found.get(wanted, b"") for wanted in ranges]

    def put(self, name: str, content: bytes | Path) -> None:
        """Write an object, replacing an older one; a file goes up in parts."""
        with self._bucket_there(name):
            obstore.put(self._bucket, name, content)

    def put_new(self, name: str, content: bytes) -> bool:
        """Write an object unless there is one (`If-None-Match: *`); whether it was written."""
        try:
            with self._bucket_there(name):
                obstore.put(self._bucket, name, content, mode="create")
        except FileExistsError:
            return False
        return True

    @contextmanager
    def _bucket_there(self, name: str) -> Iterator[None]:
        """What must be there for writing is the bucket alone."""
        try:
            with self._explained(name):
                yield
        except FileNotFoundError as error:
            raise ShardError(f"{self.url}: there is no such bucket; make it first") from error

    @contextmanager
    def _explained(self, name: str) -> Iterator[None]:
        """The store's faults as Python's or ours, in one line."""
        try:
            yield
        except (NotFoundError, FileNotFoundError) as error:
            raise FileNotFoundError(f"{self.where(name)}: is not there") from error
        except (AlreadyExistsError, PreconditionError) as error:
            raise FileExistsError(f"{self.where(name)}: is there already") from error
        except BaseError as error:
            reason = " ".join(str(error).split())[:200]
            raise ShardError(
                f"{self.where(name)}: the store refuses ({reason}); check the bucket's name, "
                "AWS_ENDPOINT_URL and the credentials"
            ) from error
