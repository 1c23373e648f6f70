# SPDX-License-Identifier: MIT
"""Gyro: how fast the robot turns."""
from typing import List

from .device import LookupTable, Sensor, numbers
from .library import c


class Gyro(LookupTable, Sensor):
    """The gyroscope, on revision 1.3 of the e-puck or as a `[[robot.device]]` of kind "gyro"."""

    _kind = "gyro"

    def getValues(self) -> List[float]:
        """rad/s about the robot's axes. NaN before the first sample."""
        return numbers(c.gyro_get_values(self._tag), 3)

    value = property(getValues)
    values = property(getValues)
