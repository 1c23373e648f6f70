# SPDX-License-Identifier: MIT
"""Twinpuck in Python: e-puck firmware on a simulated robot, to run, look at, touch and test.

    import twinpuck

    world = twinpuck.World("maze", firmware="obstacle")   # a file of one's own, or a world of Twinpuck's
    robot = world.robots[0]
    world.run(2.0)                                        # simulated seconds
    print(robot.x_m, robot.y_m, robot.leds, robot.uart1.text)
    world.run_until(lambda: robot.collisions > 0, at_most=60)

A program is the robot's own code, built as `twinpuck build` does it. The simulation runs in this process and in
virtual time: the same world, programs, seed and touches give the same run, to the bit.

Units are in the names: metres, seconds, degrees, volts, counts (as the robot's converter gives them), steps (of a
motor; 1000 are a turn of a wheel) and cycles (of the processor; 14,745,600 are a second).

World    a world with its robots, opened from a file, a text or a dict
Robot    one robot: pose, sensors, LEDs, pins, serial lines, variables, cycles, traps
pytest   `twinpuck test` runs pytest with fixtures for these; docs/testing.md is the guide
"""
from ._errors import ExpectTimeout, FirmwareFault, InvalidRun, OutputLost, TwinpuckError, WorldError
from ._faults import Fault
from ._records import Recording, read_recording
from ._robot import CameraPicture, Cycles, Diagnosis, Interrupt, Place, Profile, Robot, SerialLine, Trap
from ._world import Body, Condition, Lamp, Robots, World

__all__ = [
    "Body", "CameraPicture", "Condition", "Cycles", "Diagnosis", "ExpectTimeout", "Fault", "FirmwareFault", "Interrupt",
    "InvalidRun", "Lamp", "OutputLost", "Place", "Profile", "Recording", "Robot", "Robots", "SerialLine", "Trap",
    "TwinpuckError", "World", "WorldError", "read_recording",
]
