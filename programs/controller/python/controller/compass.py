# SPDX-License-Identifier: MIT
"""Compass: where north is."""
from typing import List

from .device import LookupTable, Sensor, numbers
from .library import c


class Compass(LookupTable, Sensor):
    """Where north is. Real e-pucks have none: the world gives it by `[[robot.device]]` of kind "compass"."""

    _kind = "compass"

    def getValues(self) -> List[float]:
        """A unit vector to the north, in the robot's axes. NaN before the first sample."""
        return numbers(c.compass_get_values(self._tag), 3)

    value = property(getValues)
    values = property(getValues)
