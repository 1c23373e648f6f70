# SPDX-License-Identifier: MIT
"""Accelerometer: how the robot is pushed and tilted."""
from typing import List

from .device import LookupTable, Sensor, numbers
from .library import c


class Accelerometer(LookupTable, Sensor):
    """The e-puck's accelerometer."""

    _kind = "accelerometer"

    def getValues(self) -> List[float]:
        """x, y, z in m/s2, in the robot's axes, with the weight: 9.81 upwards when it stands. NaN before the first sample."""
        return numbers(c.accelerometer_get_values(self._tag), 3)

    value = property(getValues)
    values = property(getValues)
