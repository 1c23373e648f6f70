# SPDX-License-Identifier: MIT
"""LightSensor: how bright it is around the robot."""
from .device import LookupTable, Sensor
from .library import c


class LightSensor(LookupTable, Sensor):
    """The ring's sensors without their own light: `ls0` to `ls7`, where `ps0` to `ps7` are."""

    _kind = "light_sensor"

    def getValue(self) -> float:
        """Counts, 0 to 4095: nearly 4095 in the dark, less in the light. NaN before the first sample."""
        return c.light_sensor_get_value(self._tag)

    value = property(getValue)
