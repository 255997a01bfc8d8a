"""Archives of a text and the files that it names."""

import posixpath
import zipfile
from typing import IO

#: Most bytes that an archive unpacks to.
LARGEST = 2 << 30


def read(file: str | IO[bytes]) -> tuple[str, None, dict[str, bytes]]:
    """Text and files of an archive, named from the folder of the text: of several, the outermost that comes first; the others
    are files that it may include.

    Raises:
        ValueError: it is no archive, holds no text, or unpacks to more than `LARGEST` bytes.
    """
    try:
        archive = zipfile.ZipFile(file)
    except zipfile.BadZipFile:
        raise ValueError(f"{file} is no zip archive") from None
    with archive:
        names = [name for name in archive.namelist() if not name.endswith("/")]
        texts = [name for name in names if name.lower().endswith(".xml")]
        if not texts:
            raise ValueError(f"{file} holds no file that ends in .xml")
        size = sum(entry.file_size for entry in archive.infolist())
        if size > LARGEST:
            raise ValueError(f"{file} unpacks to {size} bytes, more than {LARGEST}")
        model = min(texts, key=lambda name: name.count("/"))
        folder = posixpath.dirname(model) or "."
        assets = {posixpath.relpath(name, folder): archive.read(name) for name in names if name != model}
        return archive.read(model).decode(), None, assets


def write(file: str | IO[bytes], name: str, text: str, assets: dict[str, bytes]) -> None:
    """Writes an archive with a folder of the model's name."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(f"{name}/{name}.xml", text)
        for path, content in assets.items():
            archive.writestr(f"{name}/{path}", content)
