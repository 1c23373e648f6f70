# SPDX-License-Identifier: MIT
"""`twinpuck test`: pytest with our plug-in, and Twinpuck's exit codes."""
from __future__ import annotations

import importlib.util
import os
import sys

from . import _ending


def main(arguments: list[str]) -> int:
    """Exit codes: 0 all passed, 1 a test failed, 2 bad input (also a test that cannot be read), 5 no test was found, 6
    internal error, 7 an output was lost, or all that failed did so because a fault never took effect, 130 interrupted."""
    missing = [name for name in ("numpy", "pytest") if importlib.util.find_spec(name) is None]
    if missing:
        print(f"twinpuck test: got no Python package '{missing[0]}', expected numpy and pytest (Debian: "
              "python3-numpy, python3-pytest; python3-pytest-xdist for -n)", file=sys.stderr)
        return 2
    import pytest

    class Interrupted:
        """Says when tests begin; notes whether Ctrl-C ended them: pytest says the same of files that cannot be read."""

        by_user = False

        @pytest.hookimpl(tryfirst=True)
        def pytest_runtestloop(self) -> None:
            _ending.heed_work()

        def pytest_keyboard_interrupt(self, excinfo: pytest.ExceptionInfo[BaseException]) -> None:
            _ending.has_ended()
            self.by_user = excinfo.type is KeyboardInterrupt

    class Invalid:
        """Counts tests that failed, those that showed nothing, and those whose file is wrong."""

        failed = invalid = bad_input = 0

        def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
            why = {key for key, _ in report.user_properties} if report.failed else set()
            self.failed += report.failed
            self.invalid += "twinpuck_invalid" in why
            self.bad_input += "twinpuck_bad_input" in why

    sys.argv[0] = "twinpuck test"  # as pytest's messages have it
    os.environ["TWINPUCK_TEST"] = "1"  # also for the processes of -n
    interrupted, outcome = Interrupted(), Invalid()
    code = pytest.main(["-p", "twinpuck.pytest_plugin", "-o", "junit_logging=system-out", *arguments], plugins=[interrupted, outcome])
    if code != pytest.ExitCode.OK and _ending.was_interrupted():
        return 130
    if code == pytest.ExitCode.TESTS_FAILED and outcome.bad_input:
        return 2
    if code == 7 or code == pytest.ExitCode.TESTS_FAILED and outcome.failed == outcome.invalid:
        return 7
    if code == pytest.ExitCode.INTERRUPTED:
        return 130 if interrupted.by_user else 2
    return int({pytest.ExitCode.INTERNAL_ERROR: 6, pytest.ExitCode.USAGE_ERROR: 2}.get(pytest.ExitCode(code), code))


if __name__ == "__main__":
    _ending.run(main, needs_output=True)
