"""Runs the tests that come inside MuJoCo's wheel, unchanged, on the stand-in, and writes the table of what fails and why.

    python python/compare/mujoco_tests.py [--only NAME…] [--table validation/results/standin_tests.md]

Needs `mujoco` of the version that the stand-in follows, `absl-py`, `etils[epath]`, this package and, for `sysid`, what
`mujoco[sysid]` installs, and pytest; MuJoCo's tests of pictures need OSMesa or an OpenGL display (`MUJOCO_GL`). Each file of tests runs in a process of its own, on MuJoCo's bindings and on the
stand-in; tests that fail on MuJoCo's, for want of a display, are not counted.
"""

import argparse
import importlib.metadata
import importlib.util
import io
import json
import re
import subprocess
import sys
import tempfile
import traceback
import unittest
from pathlib import Path

#: Files of tests, in the wheel's folder `mujoco`.
FILES = (
    "bindings specs rollout vfs renderer render thread_safety minimize msh2obj viewer gil memory_leak".split()
)
#: Files of tests of `sysid`, in the wheel's folder `mujoco/sysid/tests`, which pytest runs.
SYSID = "parameter timeseries signal model_modifier trajectory integration".split()
_SYSID = "sysid/"
#: Letters of a cause that are shown.
SHOWN = 160
#: What one file may take [s].
LIMIT = 600


def wheel() -> Path:
    """The wheel's folder, found without an import of it."""
    found = importlib.metadata.distribution("mujoco").locate_file("mujoco")
    folder = Path(str(found))
    if not (folder / "bindings_test.py").exists():
        raise SystemExit(f"{folder} holds no bindings_test.py")
    return folder


class Outcomes(unittest.TestResult):
    """Causes of failures by the names of tests; None of those that pass."""

    def __init__(self, file: str, out: Path) -> None:
        super().__init__()
        self.file, self.out = file, out
        self.causes: dict[str, str | None] = {}
        self.places: dict[str, dict[str, int]] = {}

    def _name(self, test: unittest.TestCase) -> str:
        place, _, parameters = test.id().partition(" ")
        name = ".".join(place.split(".")[-2:])
        if not parameters:
            return name
        # Without the number of a set of parameters and without addresses: engines may have different lists of attributes.
        shown = f"{name.rstrip('0123456789')} {re.sub('0x[0-9a-f]+', '', parameters)}"
        count = self.places.setdefault(shown, {}).setdefault(test.id(), len(self.places.get(shown, {})) + 1)
        return shown if count == 1 else f"{shown} #{count}"

    def startTest(self, test: unittest.TestCase) -> None:  # noqa: N802
        """Notes a test that begins: should the process die, it fails."""
        super().startTest(test)
        self._keep(test, "the process ended")

    def _keep(self, test: unittest.TestCase, cause: str | None) -> None:
        self.causes[self._name(test)] = cause
        self.out.write_text(json.dumps(self.causes))

    def _note(self, test: unittest.TestCase, error: tuple) -> None:
        kind, value, trace = error
        lines = [frame.lineno for frame in traceback.extract_tb(trace) if frame.filename.endswith(self.file)]
        text = " ".join(str(value).split())
        cause = f"line {lines[-1] if lines else '?'}: {kind.__name__}: {text}"
        self._keep(test, cause if len(cause) <= SHOWN else cause[:SHOWN] + "…")

    def addSuccess(self, test: unittest.TestCase) -> None:  # noqa: N802
        """Notes a test that passes."""
        self._keep(test, None)

    def addSkip(self, test: unittest.TestCase, reason: str) -> None:  # noqa: N802
        """A test that skips itself counts for nobody."""
        self.causes.pop(self._name(test), None)
        self.out.write_text(json.dumps(self.causes))

    def addError(self, test: unittest.TestCase, err: tuple) -> None:  # noqa: N802
        """Notes a test that raises."""
        self._note(test, err)

    def addFailure(self, test: unittest.TestCase, err: tuple) -> None:  # noqa: N802
        """Notes a test that fails."""
        self._note(test, err)

    def addSubTest(self, test: unittest.TestCase, subtest: unittest.TestCase, err: tuple | None) -> None:  # noqa: N802
        """Notes the part of a test that fails."""
        if err is not None:
            self._note(test, err)
            test._failed_in_part = True  # type: ignore[attr-defined]


class Reports:
    """A plugin of pytest that writes causes of failures by the names of tests; None of those that pass."""

    def __init__(self, out: Path) -> None:
        self.out = out
        self.causes: dict[str, str | None] = {}

    def _keep(self, node: str, cause: str | None) -> None:
        name = node.partition("::")[2].replace("::", ".")
        self.causes[name] = cause if cause is None or len(cause) <= SHOWN else cause[:SHOWN] + "…"
        self.out.write_text(json.dumps(self.causes))

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        """Notes a test that begins: should the process die, it fails."""
        self._keep(nodeid, "the process ended")

    def pytest_runtest_logreport(self, report: object) -> None:
        """Notes how a part of a test ended."""
        node, when, outcome = (str(getattr(report, name)) for name in ("nodeid", "when", "outcome"))
        if outcome == "failed":
            crash = getattr(getattr(report, "longrepr", None), "reprcrash", None)
            text = " ".join(str(getattr(crash, "message", "it fails")).split())
            self._keep(node, f"line {getattr(crash, 'lineno', '?')}: {text}")
        elif when == "call" and outcome == "passed":
            self._keep(node, None)


def run_sysid(folder: Path, name: str, out: Path, only: str | None) -> None:
    """Runs one file's tests of `sysid` by pytest, in this process, from a copy outside of the wheel's packages."""
    import shutil

    import pytest

    tests = Path(tempfile.mkdtemp()) / "tests"
    shutil.copytree(folder / "sysid" / "tests", tests, ignore=shutil.ignore_patterns("__init__.py", "__pycache__"))
    options = ["-q", "-p", "no:cacheprovider", *(["-k", only] if only else []), str(tests / f"test_{name}.py")]
    pytest.main(options, plugins=[Reports(out)])


def run_file(engine: str, name: str, out: Path, only: str | None) -> None:
    """Runs one file's tests in this process."""
    folder = wheel()
    if engine == "standin":
        import robohive.mujoco

        robohive.mujoco.install()
        robohive.mujoco.set_instability("reset")
    if name.startswith(_SYSID):
        run_sysid(folder, name.removeprefix(_SYSID), out, only)
        return
    if engine == "standin":
        from etils import epath

        epath.resource_path = lambda package: epath.Path(str(folder))  # type: ignore[assignment]
    from absl import flags
    from absl.testing import absltest  # noqa: F401  declares the flag

    flags.FLAGS(["mujoco_tests", f"--test_tmpdir={tempfile.mkdtemp()}"])
    file = f"{name}_test.py"
    spec = importlib.util.spec_from_file_location(f"{name}_test", folder / file)
    if spec is None or spec.loader is None:
        raise SystemExit(f"{folder} holds no {file}")
    module = importlib.util.module_from_spec(spec)
    sys.modules[f"{name}_test"] = module
    spec.loader.exec_module(module)
    loader = unittest.TestLoader()
    if only:
        loader.testNamePatterns = [f"*{only}*"]
    loader.loadTestsFromModule(module).run(Outcomes(file, out))


def outcomes_of(command: list[str], limit: float, environment: dict[str, str] | None = None) -> dict[str, str | None]:
    """Causes of failures that a process of its own writes into the file whose name is appended to its command."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "outcomes.json"
        try:
            whole = [*command, str(out)]
            said = subprocess.run(whole, capture_output=True, text=True, timeout=limit, check=False, env=environment).stderr
        except subprocess.TimeoutExpired:
            said = f"it takes more than {limit} s"
        if out.exists():
            causes: dict[str, str | None] = json.loads(out.read_text())
            return causes
        return {"(the file)": (said.strip().splitlines() or ["no test"])[-1][:SHOWN]}


def outcomes(engine: str, name: str, only: str | None) -> dict[str, str | None]:
    """Causes of failures of one file's tests."""
    return outcomes_of([sys.executable, __file__, *(["--match", only] if only else []), "--run", engine, name], LIMIT)


def shown(name: str) -> str:
    """The file of tests, in the wheel."""
    return f"sysid/tests/test_{name.removeprefix(_SYSID)}.py" if name.startswith(_SYSID) else f"{name}_test.py"


def escaped(cause: str) -> str:
    """A cause as a cell of a table."""
    return cause.replace("|", "\\|").replace("<", "&lt;")


def main() -> None:
    """Runs, prints, writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    files = [*FILES, *(_SYSID + name for name in SYSID)]
    parser.add_argument("--only", nargs="*", default=files, help="files of tests, without _test.py; of sysid: sysid/signal")
    parser.add_argument("--match", help="only tests whose name contains this")
    parser.add_argument("--table", type=Path)
    parser.add_argument("--run", nargs=3, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.run:
        engine, name, out = options.run
        run_file(engine, name, Path(out), options.match)
        return
    out, failed, total = io.StringIO(), [], [0, 0]
    print("| tests of | MuJoCo | stand-in |\n|---|---|---|", file=out)
    for name in options.only:
        theirs, ours = (outcomes(engine, name, options.match) for engine in ("mujoco", "standin"))
        expected = [test for test, cause in theirs.items() if cause is None]
        passing = [test for test in expected if ours.get(test, "") is None]
        lost = ours.get("(the file)")
        failed += [(name, test, ours.get(test) or lost or "the test did not run") for test in expected if test not in passing]
        total = [total[0] + len(expected), total[1] + len(passing)]
        print(f"| `{shown(name)}` | {len(expected)} of {len(theirs)} | {len(passing)} of {len(expected)} |", file=out)
        print(f"{name}: {len(passing)} of {len(expected)}", file=sys.stderr)
    print(f"| all | {total[0]} | {total[1]}, {100 * total[1] / max(total[0], 1):.1f} % |", file=out)
    print("\n| test | why it fails on the stand-in |\n|---|---|", file=out)
    for name, test, cause in failed:
        print(f"| {name}: {test} | {escaped(cause)} |", file=out)
    print(out.getvalue(), end="")
    if options.table:
        version = importlib.metadata.version("mujoco")
        options.table.write_text(
            "# MuJoCo's own Python tests on the stand-in for `mujoco`\n\n"
            "`python python/compare/mujoco_tests.py --table validation/results/standin_tests.md`, with the tests inside the "
            f"wheel of MuJoCo {version}, unchanged. The first column counts those that pass on MuJoCo's own bindings, the second "
            "those of them that pass on the stand-in, where unstable simulations are reset "
            "(`robohive.mujoco.set_instability(\"reset\")`). Texts of errors, warnings and written models are the stand-in's own: "
            "an error of it names file, line, column and element.\n\n" + out.getvalue()
        )


if __name__ == "__main__":
    main()
