# SPDX-License-Identifier: MIT
"""InertialUnit: how the robot is turned."""
from typing import List

from .device import Sensor, numbers
from .library import c


class InertialUnit(Sensor):
    """The true attitude. Real e-pucks have none: the world gives it by `[[robot.device]]` of kind "inertial"."""

    _kind = "inertial_unit"

    def getRollPitchYaw(self) -> List[float]:
        """Roll, pitch, yaw in rad, -pi to pi. NaN before the first sample."""
        return numbers(c.inertial_unit_get_roll_pitch_yaw(self._tag), 3)

    def getQuaternion(self) -> List[float]:
        """x, y, z, w."""
        return numbers(c.inertial_unit_get_quaternion(self._tag), 4)

    def getNoise(self) -> float:
        """rad: none, 0."""
        return c.inertial_unit_get_noise(self._tag)

    roll_pitch_yaw = property(getRollPitchYaw)
    quaternion = property(getQuaternion)
    noise = property(getNoise)
