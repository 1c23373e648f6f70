# SPDX-License-Identifier: MIT
"""When steps and watches of test files hold and when they do not: windows of time, lines, robots."""
import pytest

import twinpuck
from twinpuck import _declarative

SAYS = """
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
int main(void)
{
  e_init_port();
  e_init_uart1();
  e_init_uart2();
  e_send_uart1_char("one\\r", 4);
  e_send_uart2_char("two\\r", 4);
  while (1) ;
}
"""

#: (what is written behind the world, what it fails with: "" it passes)
ROWS = [
    ('at_most_s = 1\n[[step]]\nwait = 1\n', ""),
    ('at_most_s = 1\n[[step]]\nwait = 0.625\n[[step]]\nwait = 0.375\n', ""),
    ('at_most_s = 1\n[[step]]\nwait = 0.625\n[[step]]\nwait = 0.5\n',
     "8: step.wait: got 0.5 s, expected at most the 0.375 s that are left of at_most_s = 1"),
    ('[[step]]\nexpect = "one"\n', ""),
    ('[[step]]\nexpect = "one"\nuart = 1\n', ""),
    ('[[step]]\nexpect = "two"\nuart = 2\n', ""),
    ('[[step]]\nexpect = "two"\nwithin_s = 0.1\n', "5: robot 'a' uart1: expected 'two' within 0.1 s, got 'one\\r' behind the last match"),
    ('[[step]]\nexpect = "one"\nuart = 2\nwithin_s = 0.1\n', "5: robot 'a' uart2: expected 'one' within 0.1 s, got 'two\\r' behind"),
    ('at_most_s = 0.5\n[[never]]\nthat = "time_s > 0.3"\nto_s = 0.25\n', ""),
    ('at_most_s = 0.5\n[[never]]\nthat = "time_s > 0.3"\nto_s = 0.35\n', "6: never: expected never 'time_s > 0.3', got it at 0.30"),
    ('at_most_s = 0.5\n[[never]]\nthat = "time_s < 0.3"\nfrom_s = 0.35\n', ""),
    ('at_most_s = 0.5\n[[never]]\nthat = "time_s < 0.3"\nfrom_s = 0.25\n', "6: never: expected never 'time_s < 0.3', got it at 0.25"),
    ('at_most_s = 0.5\n[[always]]\nthat = "time_s > 0.3"\nfrom_s = 0.35\n', ""),
    ('at_most_s = 0.5\n[[always]]\nthat = "time_s < 0.3"\nto_s = 0.25\n', ""),
    ('at_most_s = 0.5\n[[always]]\nthat = "time_s < 0.3"\nbecause = "it is late"\n',
     "6: always: expected always 'time_s < 0.3', got otherwise at 0.30"),
    ('at_most_s = 0.1\n[[finally]]\nthat = "x_m < 0"\n', ""),
    ('at_most_s = 0.1\n[[finally]]\nthat = "x_m < 0"\nrobot = "b"\n', "6: finally: expected 'x_m < 0', got otherwise at 0.1"),
    ('robot = "b"\nat_most_s = 0.1\n[[finally]]\nthat = "x_m > 0"\n', ""),
    ('robot = "b"\nat_most_s = 0.1\n[[step]]\nturn = 3\nrobot = "a"\n[[finally]]\nthat = "selector == 3"\n', "10: finally: expected 'selector"),
]


@pytest.mark.parametrize("text, wrong", ROWS, ids=range(len(ROWS)))
def test_steps_and_watches(text, wrong, tmp_path, programs):
    (tmp_path / "a.test.toml").write_text('# two robots\n\n\nworld = "w"\n' + text)
    file = _declarative.TestFile(tmp_path / "a.test.toml")
    robots = [{"name": name, "firmware": str(programs(SAYS)), "position": [x, 0]} for name, x in (("a", -0.2), ("b", 0.2))]
    with twinpuck.World({"arena": {"size": [1, 1]}, "robot": robots}) as world:
        run = _declarative.Run(file, world)
        if not wrong:
            run.run()
            return
        with pytest.raises((_declarative.TestFailed, _declarative.TestFileError)) as said:
            run.run()
        assert str(said.value).startswith(f"{tmp_path}/a.test.toml:{wrong}")
        assert str(said.value).endswith("; it is late") == ("late" in text)
