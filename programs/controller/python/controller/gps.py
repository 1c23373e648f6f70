# SPDX-License-Identifier: MIT
"""GPS: where the robot is."""
from typing import List

from .device import Sensor, numbers
from .library import c


class GPS(Sensor):
    """The true place. Real e-pucks have none: the world gives it by `[[robot.device]]` of kind "gps"."""

    LOCAL, WGS84 = range(2)
    _kind = "gps"

    def getValues(self) -> List[float]:
        """x, y, z in m, in the world's axes (`[webots] axes`). NaN before the first sample."""
        return numbers(c.gps_get_values(self._tag), 3)

    def getSpeed(self) -> float:
        """m/s."""
        return c.gps_get_speed(self._tag)

    def getSpeedVector(self) -> List[float]:
        """x, y, z in m/s, in the world's axes."""
        return numbers(c.gps_get_speed_vector(self._tag), 3)

    def getCoordinateSystem(self) -> int:
        """LOCAL."""
        return c.gps_get_coordinate_system(self._tag)

    @staticmethod
    def convertToDegreesMinutesSeconds(decimal_degrees: float) -> str:
        """46.5186 as 46° 31′ 6″."""
        seconds = int(abs(decimal_degrees) * 3600)
        return "%s%d° %d′ %d″" % ("-" if decimal_degrees < 0 else "", seconds // 3600, seconds // 60 % 60, seconds % 60)

    value = property(getValues)
    values = property(getValues)
    speed = property(getSpeed)
    speed_vector = property(getSpeedVector)
    coordinate_system = property(getCoordinateSystem)
