"""A page of sections."""

from __future__ import annotations

import html
import os
import pathlib
from collections.abc import Sequence
from dataclasses import dataclass

_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; max-width: 72em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff }
table { border-collapse: collapse; font-variant-numeric: tabular-nums } td, th { padding: .2em .7em; border-bottom: 1px solid #ddd;
text-align: right } td:first-child, th:first-child { text-align: left } svg text { font-size: 11px; fill: #555 }
.key { margin: 0 0 1em 4.5em; font-size: 13px } .marked { background: #fff2cc } nav a { margin-right: 1em }
"""


@dataclass(frozen=True)
class Section:
    """A part of a report: its title, and its content as HTML."""

    title: str
    content: str


class ReportBuilder:
    """Puts sections together."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._sections: list[Section] = []

    def add_section(self, section: Section) -> None:
        """Adds one at the end."""
        self._sections.append(section)

    def build(self) -> str:
        """The page."""
        title = html.escape(self._title)
        links = "".join(f'<a href="#s{i}">{html.escape(part.title)}</a>' for i, part in enumerate(self._sections))
        parts = "".join(
            f'<section id="s{i}"><h2>{html.escape(part.title)}</h2>{part.content}</section>'
            for i, part in enumerate(self._sections)
        )
        head = f'<meta charset="utf-8"><title>{title}</title><style>{_STYLE}</style>'
        return f"<!DOCTYPE html><html lang=en><head>{head}</head><body><h1>{title}</h1><nav>{links}</nav>{parts}</body></html>\n"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page into a file.

        Raises:
            OSError: it cannot be written.
        """
        pathlib.Path(path).write_text(self.build(), encoding="utf-8")


def table(head: Sequence[str], rows: Sequence[Sequence[str]], marked: Sequence[bool] = ()) -> str:
    """Cells as HTML; marked rows are highlighted."""
    lines = ["<tr>" + "".join(f"<th>{html.escape(cell)}</th>" for cell in head) + "</tr>"]
    for i, row in enumerate(rows):
        kind = ' class="marked"' if i < len(marked) and marked[i] else ""
        lines.append(f"<tr{kind}>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>")
    return f"<table>{''.join(lines)}</table>"
