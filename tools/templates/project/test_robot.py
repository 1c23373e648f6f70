# SPDX-License-Identifier: MIT
"""Tests of @NAME@: `twinpuck test` runs them. Each begins anew in world.toml beside this file."""


def test_turns_away_from_the_wall(world):
    robot = world.robots["e-puck"]
    world.run(2.0)  # simulated seconds
    assert robot.collisions == 0
    assert world.run_until(lambda: robot.leds[0], at_most=1.0)
    assert "ready" in robot.uart1.text
    assert robot.variable("step_due") in (0, 1)
    assert robot.traps == []
