# SPDX-License-Identifier: MIT
"""TouchSensor: bumpers."""
from typing import List

from .device import LookupTable, Sensor, numbers
from .library import c


class TouchSensor(LookupTable, Sensor):
    """Whether something is touched, or with what force."""

    BUMPER, FORCE, FORCE3D = range(3)
    _kind = "touch_sensor"

    def getValue(self) -> float:
        """A bumper: 1 touched, 0 not; a force sensor: N. NaN before the first sample."""
        return c.touch_sensor_get_value(self._tag)

    def getValues(self) -> List[float]:
        """Of a FORCE3D: x, y, z in N."""
        return numbers(c.touch_sensor_get_values(self._tag), 3)

    def getType(self) -> int:
        """BUMPER, FORCE or FORCE3D."""
        return c.touch_sensor_get_type(self._tag)

    value = property(getValue)
    values = property(getValues)
    type = property(getType)
