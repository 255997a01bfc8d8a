"""The Python interface as Markdown, from the sources of the package, without importing it.

python site/reference/python.py FOLDER PART prints the part of the package in FOLDER: environments, control,
policy, pettingzoo, collect, data, ray or mujoco.
"""

from __future__ import annotations

import ast
import inspect
import re
import sys
from pathlib import Path

Definition = ast.FunctionDef | ast.ClassDef | ast.Assign | ast.AnnAssign
SECTIONS = ("Args", "Returns", "Raises", "Yields", "Attributes")


class Module:
    """A module's own definitions, and where the names that it imports come from."""

    known: dict[str, Module] = {}
    root = Path()

    def __init__(self, name: str) -> None:
        base = self.root.joinpath(*name.split("."))
        files = [base.with_suffix(".py"), base / "__init__.py", base.with_suffix(".pyi")]
        # What the extension module has stands in stubs.
        stub = base.with_suffix(".pyi")
        path = stub if stub.exists() else next(file for file in files if file.exists())
        tree = ast.parse(path.read_text())
        self.name = name
        self.doc = ast.get_docstring(tree) or ""
        self.names: dict[str, tuple[Module, Definition, str]] = {}
        self.all: list[str] | None = None
        self.aliases: dict[str, str] = {}
        body = tree.body
        for i, node in enumerate(body):
            after = body[i + 1] if i + 1 < len(body) else None
            self._take(node, comment(after))

    @classmethod
    def of(cls, name: str) -> Module:
        if name not in cls.known:
            cls.known[name] = cls(name)
        return cls.known[name]

    def _take(self, node: ast.stmt, doc: str) -> None:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            # Of overloads, the last is the definition.
            self.names[node.name] = (self, node, ast.get_docstring(node) or "")
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            for target in targets:
                if isinstance(target, ast.Name) and target.id == "__all__":
                    self.all = literal(node.value)
                elif isinstance(target, ast.Name):
                    self.names[target.id] = self._aliased(node, doc)
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("robohive"):
            self._import(node)

    def _aliased(self, node: Definition, doc: str) -> tuple[Module, Definition, str]:
        """What an assignment of a name of the extension module stands for."""
        value = node.value
        if isinstance(value, ast.Attribute) and isinstance(value.value, ast.Name):
            origin = self.aliases.get(value.value.id)
            if origin and value.attr in Module.of(origin).names:
                module, definition, text = Module.of(origin).names[value.attr]
                return module, definition, doc or text
        return self, node, doc

    def _import(self, node: ast.ImportFrom) -> None:
        for alias in node.names:
            name = alias.asname or alias.name
            try:
                module = Module.of(f"{node.module}.{alias.name}")
                self.aliases[name] = module.name
                continue
            except StopIteration:
                pass
            try:
                origin = Module.of(node.module)
            except StopIteration:
                continue
            if alias.name == "*":
                self.names.update({known: origin.names[known] for known in origin.public()})
            elif alias.name in origin.names:
                self.names[name] = origin.names[alias.name]

    def public(self) -> list[str]:
        """Names for others."""
        if self.all is not None:
            return [name for name in self.all if name in self.names]
        return [name for name in self.names if not name.startswith("_")]

    def own(self) -> list[str]:
        """Names for others that are defined here."""
        return [name for name in self.public() if self.names[name][0] is self]


def literal(node: ast.expr | None) -> list[str] | None:
    try:
        value = ast.literal_eval(node)  # pyright: ignore
    except (ValueError, TypeError):
        return None
    return list(value)


def comment(node: ast.stmt | None) -> str:
    """The text that stands below an assignment."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
        return inspect.cleandoc(node.value.value)
    return ""


def signature(name: str, node: Definition) -> str:
    if isinstance(node, ast.FunctionDef):
        result = f" -> {ast.unparse(node.returns)}" if node.returns else ""
        arguments = ast.unparse(node.args)
        for first in ("self, ", "cls, ", "self", "cls"):
            if arguments.startswith(first):
                arguments = arguments.removeprefix(first)
                break
        return f"{name}({arguments.removeprefix('/, ')}){result}"
    if isinstance(node, ast.ClassDef):
        bases = ", ".join(ast.unparse(base) for base in node.bases)
        return f"class {name}({bases})" if bases else f"class {name}"
    if isinstance(node, ast.AnnAssign):
        return f"{name}: {ast.unparse(node.annotation)}"
    value = ast.unparse(node.value)
    return f"{name} = {value}" if len(value) < 60 else name


def markdown(doc: str) -> str:
    """A docstring in Google's style as Markdown."""
    doc = re.sub(r":\w+:`([^`]*)`", r"`\1`", doc).replace("``", "`")
    out, section, example = [], "", False
    for line in doc.splitlines():
        is_example = line.strip().startswith((">>>", "...")) or (example and bool(line.strip()))
        if is_example != example:
            out.append("```python" if is_example else "```")
            example = is_example
        if example:
            out.append(line)
        elif line.removesuffix(":") in SECTIONS and line.endswith(":"):
            section = line.removesuffix(":")
            out += ["", f"**{section}**", ""]
        elif section and line.startswith("    "):
            entry = re.match(r"    ([\w.*]+)( \([^)]*\))?: (.*)", line)
            out.append(f"- `{entry[1]}`: {entry[3]}" if entry else f"  {line.strip()}")
        else:
            section = "" if line.strip() else section
            out.append(line)
    if example:
        out.append("```")
    text, code = [], False
    for line in out:
        code ^= line.startswith("```")
        text.append(line if code else line.replace("<", "&lt;"))
    return "\n".join(text)


def describe(name: str, entry: tuple[Module, Definition, str], level: int) -> None:
    """Prints a heading, the signature and the text of a definition, and of the members of a class."""
    _, node, doc = entry
    print(f"{'#' * level} {name}\n\n```python\n{signature(name.rsplit('.')[-1], node)}\n```\n\n{markdown(doc)}\n")
    if not isinstance(node, ast.ClassDef):
        return
    for i, member in enumerate(node.body):
        after = node.body[i + 1] if i + 1 < len(node.body) else None
        if isinstance(member, ast.FunctionDef) and (member.name == "__init__" or not member.name.startswith("_")):
            print(f"```python\n{signature(member.name, member)}\n```\n\n{markdown(ast.get_docstring(member) or '')}\n")
        elif isinstance(member, ast.AnnAssign) and isinstance(member.target, ast.Name) and not member.target.id.startswith("_"):
            print(f"`{signature(member.target.id, member)}` {markdown(comment(after))}\n")


def module(name: str, heading: bool = True) -> None:
    found = Module.of(name)
    if heading:
        print(f"## {name}\n\n{markdown(found.doc)}\n")
    for public in found.public():
        describe(public, found.names[public], 3)


def mujoco() -> None:
    """One row a name: there are as many as MuJoCo has."""
    found = Module.of("robohive.mujoco")
    mujocos = re.compile(r"(mj|Mj|set_|get_|install$|from_zip|to_zip|Renderer|FatalError|UnexpectedError|MISSING)")
    kinds: dict[str, list[tuple[str, Definition, str]]] = {"Functions": [], "Classes": [], "Constants": []}
    for name in sorted(filter(mujocos.match, found.public()), key=str.lower):
        _, node, doc = found.names[name]
        kind = "Functions" if isinstance(node, ast.FunctionDef) else "Classes" if isinstance(node, ast.ClassDef) else "Constants"
        kinds[kind].append((name, node, doc))
    for kind, rows in kinds.items():
        print(f"## {kind} ({len(rows)})\n\n| name | |\n|---|---|")
        for name, node, doc in rows:
            first = doc.split("\n\n")[0].replace("\n", " ").replace("|", "\\|").replace("<", "&lt;")
            code = signature(name, node).replace("|", "\\|") if kind == "Functions" else name
            print(f"| `{code}` | {first} |")
        print()


def main() -> None:
    folder, part = sys.argv[1:]
    Module.root = Path(folder)
    if part == "mujoco":
        mujoco()
    elif part == "environments":
        module("robohive")
        describe("RoboHiveEnv", Module.of("robohive.envs").names["RoboHiveEnv"], 3)
        describe("RoboHiveVectorEnv", Module.of("robohive.vector").names["RoboHiveVectorEnv"], 3)
    elif part == "ray":
        describe("Collector", Module.of("robohive.ray.collector").names["Collector"], 3)
        describe("LostEpisodes", Module.of("robohive.ray.plan").names["LostEpisodes"], 3)
        module("robohive.ray.rllib")
    else:
        module(f"robohive.{part}")


main()
