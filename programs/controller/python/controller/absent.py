# SPDX-License-Identifier: MIT
"""Devices that no e-puck has here. `robot.getDevice(name)` warns and gives None; the classes are there for programs that
name them, as `from controller import Robot, Lidar`."""
from .device import Device, Sensor
from .library import warn


class Brake(Device):
    """No e-puck has one."""


class Connector(Device):
    """No e-puck has one."""


class Pen(Device):
    """No e-puck has one."""


class Skin(Device):
    """No e-puck has one."""


class VacuumGripper(Device):
    """No e-puck has one."""


class Altimeter(Sensor):
    """No e-puck has one."""


class Radar(Sensor):
    """No e-puck has one."""


class RadarTarget:
    """What a radar would see."""


class Motion:
    """A file of movements, for robots with limbs. An e-puck plays none."""

    def __init__(self, filename: str):
        warn("Motion: got %r, expected none: the robot has no limbs" % filename)

    def isValid(self) -> bool:
        """False."""
        return False

    def isOver(self) -> bool:
        """True."""
        return True

    def play(self) -> None:
        """No effect."""

    def stop(self) -> None:
        """No effect."""

    def getDuration(self) -> int:
        """0 ms."""
        return 0
