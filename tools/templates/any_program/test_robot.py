# SPDX-License-Identifier: MIT
"""Tests of @NAME@: `twinpuck test` runs them. Each begins anew in world.toml beside this file."""


def test_runs_without_a_trap(world):
    robot = world.robots["e-puck"]
    world.run(2.0)  # simulated seconds
    assert robot.traps == []
    # more of what can be asked:
    # assert world.run_until(lambda: robot.leds[0], at_most=1.0)
    # assert "hello" in robot.uart1.text
    # assert robot.variable("state") == 1
    # assert robot.collisions == 0
