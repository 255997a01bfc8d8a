"""Runs dm_control's own tests, unchanged, on MuJoCo and on the stand-in, and writes the table.

    python python/compare/dm_control_tests.py [--only mjcf composer …] [--table validation/results/standin_dm_control.md]

Needs `dm_control`, `mujoco` of the version that the stand-in follows, `absl-py`, `mock` and this package; tests of pictures need
OSMesa (`MUJOCO_GL=osmesa`), those of recorded motions `h5py` and protobuf 5, as newer ones lack what dm_control 1.0.45 asks for.
Each file of tests runs in a process of its own. A test that fails on MuJoCo's bindings is not counted.
"""

import argparse
import importlib
import importlib.metadata
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path

from mujoco_tests import Outcomes, outcomes_of

FOLDERS = "mjcf composer suite locomotion mujoco entities manipulation rl utils".split()
#: What one file may take [s].
LIMIT = 3600


def home() -> Path:
    """dm_control's folder, found without an import of it."""
    return Path(str(importlib.metadata.distribution("dm_control").locate_file("dm_control")))


def outcomes(engine: str, module: str) -> dict[str, str | None]:
    """Causes of failures by the names of one module's tests; None of those that pass."""
    # Names of tests that show sets are the same on both with one seed of hashes.
    environment = {"MUJOCO_GL": "osmesa", **os.environ, "PYTHONHASHSEED": "0"}
    return outcomes_of([sys.executable, __file__, "--run", engine, module], LIMIT, environment)


def run_module(engine: str, module: str, out: str) -> None:
    """Runs one module's tests in this process."""
    if engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
        robohive.mujoco.set_instability("reset")
    from absl import flags
    from absl.testing import absltest  # noqa: F401  declares the flag

    flags.FLAGS(["dm_control_tests", f"--test_tmpdir={tempfile.mkdtemp()}"])
    tests = importlib.import_module(module)
    unittest.TestLoader().loadTestsFromModule(tests).run(Outcomes(f"{module.rpartition('.')[2]}.py", Path(out)))
    # Threads that draw may wait for more.
    os._exit(0)


def main() -> None:
    """Runs, prints, writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="*", default=FOLDERS, help="folders of dm_control, or files in them")
    parser.add_argument("--table", type=Path)
    parser.add_argument("--run", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run:
        run_module(*options.run)
        return
    out, failed = io.StringIO(), []
    print("| tests of | MuJoCo | stand-in |\n|---|---|---|", file=out)
    for folder in options.only:
        passing, count = 0, 0
        for file in sorted((home() / folder).rglob("*_test.py")) if not folder.endswith(".py") else [home() / folder]:
            place = file.relative_to(home())
            module = ".".join(("dm_control", *place.with_suffix("").parts))
            theirs, ours = outcomes("mujoco", module), outcomes("standin", module)
            expected = [name for name, cause in theirs.items() if cause is None]
            lost = [name for name in expected if ours.get(name, "") is not None]
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
            f"`python python/compare/dm_control_tests.py --only {' '.join(options.only)} --table "
            f"validation/results/standin_dm_control.md`, with {versions}. The first column counts the tests that pass on MuJoCo's own bindings, the second those of them that "
            "pass on the stand-in.\n\n" + out.getvalue()
        )


if __name__ == "__main__":
    main()
