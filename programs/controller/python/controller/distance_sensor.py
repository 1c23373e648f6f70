# SPDX-License-Identifier: MIT
"""DistanceSensor: infra-red proximity and ground sensors."""
from .device import LookupTable, Sensor
from .library import c


class DistanceSensor(LookupTable, Sensor):
    """An infra-red sensor that looks for obstacles: `ps0` to `ps7` around the e-puck, or the floor: `gs0` to `gs2`.

    `ps0` is ahead on the right, and so on clockwise, `ps7` ahead on the left (a world of the lab counts otherwise).
    `enable(period_ms)`, then after the first period `getValue()`.
    """

    GENERIC, INFRA_RED, SONAR, LASER = range(4)
    _kind = "distance_sensor"

    def getValue(self) -> float:
        """Counts: the ring's 0 to 4095, more when near; of ground sensors 0 to 1000 or so, less on black.

        NaN before the first sample."""
        return c.distance_sensor_get_value(self._tag)

    def getMaxValue(self) -> float:
        """The most that it returns, in the units of getValue()."""
        return c.distance_sensor_get_max_value(self._tag)

    def getMinValue(self) -> float:
        """The least that it returns, in the units of getValue()."""
        return c.distance_sensor_get_min_value(self._tag)

    def getAperture(self) -> float:
        """How wide it looks, rad."""
        return c.distance_sensor_get_aperture(self._tag)

    def getType(self) -> int:
        """GENERIC, INFRA_RED, SONAR or LASER."""
        return c.distance_sensor_get_type(self._tag)

    value = property(getValue)
    max_value = property(getMaxValue)
    min_value = property(getMinValue)
    aperture = property(getAperture)
    type = property(getType)
