# SPDX-License-Identifier: MIT
"""DifferentialWheels: a robot with two wheels, as versions up to R2018 have it."""
from .library import c
from .robot import Robot


class DifferentialWheels(Robot):
    """A robot whose wheels are driven and measured by its own functions, not by devices.

    Speeds are units of getSpeedUnit(): with 0.00628 rad/s, 1000 is a turn a second.
    """

    def setSpeed(self, left: float, right: float) -> None:
        """Units of getSpeedUnit(), forward positive."""
        c.differential_wheels_set_speed(left, right)

    def getLeftSpeed(self) -> float:
        """What was set."""
        return c.differential_wheels_get_left_speed()

    def getRightSpeed(self) -> float:
        """What was set."""
        return c.differential_wheels_get_right_speed()

    def enableEncoders(self, sampling_period: int) -> None:
        """Counts steps of the wheels, every `sampling_period` ms."""
        c.differential_wheels_enable_encoders(int(sampling_period))

    def disableEncoders(self) -> None:
        """Counts no more."""
        c.differential_wheels_disable_encoders()

    def getEncodersSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return c.differential_wheels_get_encoders_sampling_period()

    def getLeftEncoder(self) -> float:
        """Steps, 1000 a turn, since the beginning or as set."""
        return c.differential_wheels_get_left_encoder()

    def getRightEncoder(self) -> float:
        """Steps, 1000 a turn, since the beginning or as set."""
        return c.differential_wheels_get_right_encoder()

    def setEncoders(self, left: float, right: float) -> None:
        """Steps: what the encoders show from now on."""
        c.differential_wheels_set_encoders(left, right)

    def getMaxSpeed(self) -> float:
        """rad/s."""
        return c.differential_wheels_get_max_speed()

    def getSpeedUnit(self) -> float:
        """rad/s a unit of setSpeed()."""
        return c.differential_wheels_get_speed_unit()
