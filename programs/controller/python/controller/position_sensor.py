# SPDX-License-Identifier: MIT
"""PositionSensor: how far a wheel has turned."""
from typing import TYPE_CHECKING, Optional

from .device import Sensor
from .library import c

if TYPE_CHECKING:
    from .motor import Motor


class PositionSensor(Sensor):
    """The steps of a wheel: `left wheel sensor` and `right wheel sensor`."""

    ROTATIONAL, LINEAR = range(2)
    _kind = "position_sensor"

    def getValue(self) -> float:
        """rad, forward positive, since the beginning; the e-puck makes 1000 steps a turn. NaN before the first sample."""
        return c.position_sensor_get_value(self._tag)

    def getType(self) -> int:
        """ROTATIONAL or LINEAR."""
        return c.position_sensor_get_type(self._tag)

    def getMotor(self) -> "Optional[Motor]":
        """The motor that turns it."""
        from .robot import device_of
        return device_of(c.position_sensor_get_motor(self._tag))

    def getBrake(self) -> None:
        """The e-puck has no brakes: None."""
        return None

    value = property(getValue)
    type = property(getType)
    motor = property(getMotor)
    brake = property(getBrake)
