"""Runs dm_control's own tests, unchanged, on MuJoCo and on the stand-in, and writes the table.

    python python/compare/dm_control_tests.py [--only mjcf composer …] [--table validation/results/standin_dm_control.md]

Needs `dm_control`, `mujoco` of the version that the stand-in follows, `pytest`, `mock` and this package; tests of pictures need
OSMesa (`MUJOCO_GL=osmesa`). Each file of tests runs in a process of its own. A test that fails on MuJoCo's bindings is not counted.
"""

import argparse
import importlib.metadata
import io
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as Tree
from pathlib import Path

FOLDERS = "mjcf composer suite locomotion mujoco entities manipulation rl utils".split()
#: What one file may take [s].
LIMIT = 1800
#: Letters of a cause that are shown.
SHOWN = 140


def home() -> Path:
    """dm_control's folder, found without an import of it."""
    return Path(str(importlib.metadata.distribution("dm_control").locate_file("dm_control")))


def outcomes(engine: str, file: Path) -> dict[str, str | None]:
    """Causes of failures by the names of one file's tests; None of those that pass."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.xml"
        command = [sys.executable, __file__, "--run", engine, str(file), str(report)]
        try:
            subprocess.run(command, capture_output=True, timeout=LIMIT, check=False, env={"MUJOCO_GL": "osmesa", **os.environ})
        except subprocess.TimeoutExpired:
            return {"(the file)": f"it takes more than {LIMIT} s"}
        if not report.exists():
            return {"(the file)": "the process ended"}
        found: dict[str, str | None] = {}
        for case in Tree.parse(report).iter("testcase"):
            name = f"{case.get('classname', '').rpartition('.')[2]}.{case.get('name')}"
            fault = case.find("failure") if case.find("failure") is not None else case.find("error")
            if case.find("skipped") is None:
                found[name] = None if fault is None else " ".join((fault.get("message") or "?").split())[:SHOWN]
        return found


def run_file(engine: str, file: str, report: str) -> None:
    """Runs one file's tests in this process."""
    if engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
        robohive.mujoco.set_instability("reset")
    import pytest

    pytest.main(["-q", "-p", "no:cacheprovider", "-o", "junit_family=xunit1", f"--junitxml={report}", file])


def main() -> None:
    """Runs, prints, writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="*", default=FOLDERS, help="folders of dm_control, or files in them")
    parser.add_argument("--table", type=Path)
    parser.add_argument("--run", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run:
        run_file(*options.run)
        return
    out, failed = io.StringIO(), []
    print("| tests of | MuJoCo | stand-in |\n|---|---|---|", file=out)
    for folder in options.only:
        passing, count = 0, 0
        for file in sorted((home() / folder).rglob("*_test.py")) if not folder.endswith(".py") else [home() / folder]:
            theirs, ours = outcomes("mujoco", file), outcomes("standin", file)
            expected = [name for name, cause in theirs.items() if cause is None]
            lost = [name for name in expected if ours.get(name, "") is not None]
            place = file.relative_to(home())
            failed += [(place, name, ours.get(name) or ours.get("(the file)") or "the test did not run") for name in lost]
            count, passing = count + len(expected), passing + len(expected) - len(lost)
            print(f"{place}: {len(expected) - len(lost)} of {len(expected)}", file=sys.stderr, flush=True)
        print(f"| `{folder}` | {count} | {passing} |", file=out)
    print("\n| test | why it fails on the stand-in |\n|---|---|", file=out)
    for place, name, cause in failed:
        shown = cause.replace("|", "\\|").replace("<", "&lt;")
        print(f"| {place}: {name} | {shown} |", file=out)
    print(out.getvalue(), end="")
    if options.table:
        versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in ("dm_control", "mujoco", "numpy"))
        options.table.write_text(
            "# dm_control's own tests on the stand-in for `mujoco`\n\n"
            "`python python/compare/dm_control_tests.py --table validation/results/standin_dm_control.md`, with "
            f"{versions}. The first column counts the tests that pass on MuJoCo's own bindings, the second those of them that "
            "pass on the stand-in.\n\n" + out.getvalue()
        )


if __name__ == "__main__":
    main()
