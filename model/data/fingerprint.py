"""What a library or a folder of shards holds, in one hash."""

from pathlib import Path

from artgen.core.jsonio import content_hash, file_hash
from artgen.dataset.shard import manifest_path
from artgen.dataset.split import Split


def fingerprint(place: Path, split: Split | None = None) -> str:
    """A sha256 that changes with the objects of a library file, or of a folder of shards.

    Shards are told by their manifests, which hold the hashes of the images: these are not read.

    Args:
        split: the shards that are read; None for all. A library is one file.
    """
    if not place.is_dir():
        return file_hash(place)
    shards = place.glob(f"{split}-*.tar" if split else "*.tar")
    manifests = sorted(path for path in map(manifest_path, shards) if path.exists())
    return content_hash({path.name: file_hash(path) for path in manifests})
