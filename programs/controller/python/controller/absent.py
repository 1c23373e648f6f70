# SPDX-License-Identifier: MIT
"""Devices that no e-puck has here. `robot.getDevice(name)` warns and gives None; the classes are there for programs that
name them, as `from controller import Robot, Lidar`."""
from .device import Device, Sensor


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


class Lidar(Sensor):
    """No e-puck has one."""


class Radar(Sensor):
    """No e-puck has one."""


class RangeFinder(Sensor):
    """No e-puck has one."""


class LidarPoint:
    """What a lidar would see."""


class RadarTarget:
    """What a radar would see."""
