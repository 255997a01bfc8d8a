"""Files in memory, from which models are loaded and compiled."""

from collections.abc import Iterable, Mapping
from typing import Any


class MjVfs:
    """Files by name, that `vfs=` of loading and compiling looks in before the disk. A context manager; `close` ends the use.

        with MjVfs() as files:
            files["ball.obj"] = content
            model = MjModel.from_xml_string(text, vfs=files)
    """

    def __init__(self) -> None:
        self._files: dict[str, bytes] | None = {}

    def _open(self) -> dict[str, bytes]:
        if self._files is None:
            raise RuntimeError("this MjVfs is closed")
        return self._files

    def __setitem__(self, name: str, content: bytes | str) -> None:
        """Adds a file.

        Raises:
            ValueError: there is one of this name; delete it first.
            RuntimeError: the files are closed.
        """
        files = self._open()
        if name in files:
            raise ValueError(f"there is a file {name!r} already; delete it first")
        files[name] = content.encode() if isinstance(content, str) else bytes(content)

    def __delitem__(self, name: str) -> None:
        """Removes a file.

        Raises:
            KeyError: there is none of this name.
        """
        del self._open()[name]

    def __contains__(self, name: object) -> bool:
        return name in self._open()

    def close(self) -> None:
        """Drops the files; may be called again."""
        self._files = None

    def __enter__(self) -> "MjVfs":
        self._open()
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def given_files(vfs: MjVfs | None, *mappings: Mapping[str, Any] | None) -> dict[str, Any]:
    """The files of a call: those of `vfs`, or those of the mappings.

    Raises:
        ValueError: both are given.
    """
    given = [mapping for mapping in mappings if mapping]
    if vfs is not None:
        if given:
            raise ValueError("files are given by vfs or by a mapping, not by both")
        return dict(vfs._open())
    return {name: content for mapping in given for name, content in mapping.items()}


def refuse_repeated(names: Iterable[str]) -> None:
    """Files of a model are looked up without their folders too, so that each name may occur once.

    Raises:
        ValueError: two have the same name in different folders.
    """
    known: set[str] = set()
    for name in names:
        own = str(name).replace("\\", "/").rpartition("/")[2]
        if own in known:
            raise ValueError(f"Repeated file name in assets: {own}")
        known.add(own)
