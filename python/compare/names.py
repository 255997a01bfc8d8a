"""Which names of MuJoCo's bindings a package uses, and whether the stand-in has them.

Names are found in the sources: attributes of `mujoco`, and of what is called a model or data.
"""

import ast
from pathlib import Path

#: What the owner of an attribute may be called.
_OWNERS = {
    "mujoco": "mujoco",
    "model": "MjModel",
    "_model": "MjModel",
    "data": "MjData",
    "_data": "MjData",
    "opt": "MjOption",
    "stat": "MjStatistic",
}


def _owner(node: ast.expr) -> str | None:
    if isinstance(node, ast.Name):
        return _OWNERS.get(node.id)
    if isinstance(node, ast.Attribute):
        return _OWNERS.get(node.attr)
    return None


def used(folder: Path) -> set[tuple[str, str]]:
    """Owners and names in the Python files under a folder, tests left out."""
    found = set()
    for path in sorted(folder.rglob("*.py")):
        if "test" in path.name or "mujoco_py" in path.name:
            continue
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Attribute) and (owner := _owner(node.value)):
                found.add((owner, node.attr))
            if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "mujoco":
                found.update(("mujoco", alias.name) for alias in node.names)
    return found


def present(owner: str, name: str) -> bool | None:
    """Whether the stand-in has a name; None where MuJoCo's bindings have no such name either."""
    import mujoco
    import robohive.mujoco as standin

    text = "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"

    def owners(module: object) -> dict[str, object]:
        model = module.MjModel.from_xml_string(text)  # type: ignore[attr-defined]
        data = module.MjData(model)  # type: ignore[attr-defined]
        return {"mujoco": module, "MjModel": model, "MjData": data, "MjOption": model.opt, "MjStatistic": model.stat}

    if not hasattr(owners(mujoco)[owner], name):
        return None
    return hasattr(owners(standin)[owner], name) and name not in standin.MISSING


def rows_of(folders: list[Path]) -> list[str]:
    """Lines of a table: how many names the packages use, which are missing, and which are there."""
    found: set[tuple[str, str]] = set().union(*(used(folder) for folder in folders))
    verdicts: dict[bool, list[str]] = {True: [], False: []}
    for owner, name in sorted(found):
        here = present(owner, name)
        if here is not None:
            verdicts[here].append(f"`{owner}.{name}`")
    return [
        f"{len(verdicts[True]) + len(verdicts[False])} names are used, {len(verdicts[True])} are there.",
        "",
        "Not there: " + (", ".join(verdicts[False]) or "none") + ".",
        "",
        "There: " + ", ".join(verdicts[True]) + ".",
    ]
