"""Runs MuJoCo's own tests of `MjSpec` on the stand-in, and writes the table of what fails and why.

    python python/compare/specs.py CHECKOUT [--table validation/results/standin_specs.md]

CHECKOUT is a copy of MuJoCo's repository, of the version that the stand-in follows. Needs `absl-py`, `etils[epath]` and this
package.
"""

import argparse
import importlib.util
import io
import traceback
import unittest
from pathlib import Path
from types import ModuleType

import robohive.mujoco

#: Letters of a cause that are shown.
_SHOWN = 160


def load(checkout: Path) -> ModuleType:
    """The tests, which find the stand-in as `mujoco` and their files in the checkout."""
    robohive.mujoco.install()
    from etils import epath

    folder = checkout / "python" / "mujoco"
    epath.resource_path = lambda package: epath.Path(str(folder))  # type: ignore[assignment]
    spec = importlib.util.spec_from_file_location("specs_test", folder / "specs_test.py")
    if spec is None or spec.loader is None:
        raise SystemExit(f"{folder} holds no specs_test.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Outcomes(unittest.TestResult):
    """Causes of failures by the names of tests; None where there is none."""

    def __init__(self) -> None:
        super().__init__()
        self.causes: dict[str, str | None] = {}

    def _note(self, test: unittest.TestCase, error: tuple) -> None:
        kind, value, trace = error
        lines = [frame.lineno for frame in traceback.extract_tb(trace) if frame.filename.endswith("specs_test.py")]
        text = " ".join(str(value).split())
        cause = f"line {lines[-1] if lines else '?'}: {kind.__name__}: {text}"
        self.causes[test.id().rpartition(".")[2]] = cause if len(cause) <= _SHOWN else cause[:_SHOWN] + "…"

    def addSuccess(self, test: unittest.TestCase) -> None:  # noqa: N802
        """Notes a test that passes."""
        self.causes[test.id().rpartition(".")[2]] = None

    def addError(self, test: unittest.TestCase, err: tuple) -> None:  # noqa: N802
        """Notes a test that raises."""
        self._note(test, err)

    def addFailure(self, test: unittest.TestCase, err: tuple) -> None:  # noqa: N802
        """Notes a test that fails."""
        self._note(test, err)


def main() -> None:
    """Runs, prints, writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkout", type=Path)
    parser.add_argument("--table", type=Path)
    options = parser.parse_args()
    outcomes = Outcomes()
    unittest.defaultTestLoader.loadTestsFromModule(load(options.checkout.resolve())).run(outcomes)
    failed = {name: cause for name, cause in outcomes.causes.items() if cause is not None}
    out = io.StringIO()
    print("# MuJoCo's tests of `MjSpec` on the stand-in for `mujoco`\n", file=out)
    print(
        "`python python/compare/specs.py CHECKOUT --table validation/results/standin_specs.md`, with a copy of MuJoCo "
        f"{robohive.mujoco.__version__}: {len(outcomes.causes) - len(failed)} of {len(outcomes.causes)} tests of its "
        "`python/mujoco/specs_test.py` pass. Texts of errors and of written models are the stand-in's own.\n",
        file=out,
    )
    print("| test | why it fails |\n|---|---|", file=out)
    for name, cause in failed.items():
        shown = cause.replace("|", "\\|").replace("<", "&lt;")
        print(f"| {name} | {shown} |", file=out)
    print("\nPassing: " + ", ".join(f"`{name}`" for name, cause in outcomes.causes.items() if cause is None) + ".", file=out)
    print(out.getvalue(), end="")
    if options.table:
        options.table.write_text(out.getvalue())


if __name__ == "__main__":
    main()
