"""Archives of a text and the files that it names."""

import posixpath
import zipfile
from typing import IO


def read(file: str | IO[bytes]) -> tuple[str, None, dict[str, bytes]]:
    """Text and files of an archive, named from the folder of the text.

    Raises:
        ValueError: it is no archive, or holds no text.
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
        folder = posixpath.dirname(texts[0]) or "."
        others = (name for name in names if name not in texts)
        assets = {posixpath.relpath(name, folder): archive.read(name) for name in others}
        return archive.read(texts[0]).decode(), None, assets


def write(file: str | IO[bytes], name: str, text: str, assets: dict[str, bytes]) -> None:
    """Writes an archive with a folder of the model's name."""
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(f"{name}/{name}.xml", text)
        for path, content in assets.items():
            archive.writestr(f"{name}/{path}", content)
