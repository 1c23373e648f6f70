# SPDX-License-Identifier: MIT
"""Motor: a wheel."""
from typing import TYPE_CHECKING, Optional

from .device import Device
from .library import c

if TYPE_CHECKING:
    from .position_sensor import PositionSensor


class Motor(Device):
    """A stepper motor with its wheel: `left wheel motor`, `right wheel motor`.

    To drive: `setPosition(float("inf"))`, then `setVelocity(rad_per_s)`. To turn by an angle: `setPosition(rad)`.
    """

    ROTATIONAL, LINEAR = range(2)

    def setPosition(self, position: float) -> None:
        """Turns to `position`, rad, at most as fast as setVelocity() says; infinite: for ever."""
        c.motor_set_position(self._tag, position)

    def setVelocity(self, velocity: float) -> None:
        """rad/s, the e-puck's -6.28 to 6.28; more is limited with a warning. Towards a position: the most, its sign
        means nothing."""
        c.motor_set_velocity(self._tag, velocity)

    def setAcceleration(self, acceleration: float) -> None:
        """rad/s2, negative: as it can. Steppers start at once: no effect."""
        c.motor_set_acceleration(self._tag, acceleration)

    def setAvailableForce(self, force: float) -> None:
        """N. No effect on a stepper."""
        c.motor_set_available_force(self._tag, force)

    def setAvailableTorque(self, torque: float) -> None:
        """Nm. No effect on a stepper."""
        c.motor_set_available_torque(self._tag, torque)

    def setControlPID(self, p: float, i: float, d: float) -> None:
        """A stepper has no such control: no effect."""
        c.motor_set_control_pid(self._tag, p, i, d)

    def setForce(self, force: float) -> None:
        """N. A stepper is not driven by a force: no effect, a warning."""
        c.motor_set_force(self._tag, force)

    def setTorque(self, torque: float) -> None:
        """Nm. A stepper is not driven by a torque: no effect, a warning."""
        c.motor_set_torque(self._tag, torque)

    def getTargetPosition(self) -> float:
        """rad: what was set."""
        return c.motor_get_target_position(self._tag)

    def getVelocity(self) -> float:
        """rad/s: what was set, not what the wheel does."""
        return c.motor_get_velocity(self._tag)

    def getAcceleration(self) -> float:
        """rad/s2; -1: no limit."""
        return c.motor_get_acceleration(self._tag)

    def getMinPosition(self) -> float:
        """rad; 0 with getMaxPosition() 0: no limits."""
        return c.motor_get_min_position(self._tag)

    def getMaxPosition(self) -> float:
        """rad; 0 with getMinPosition() 0: no limits."""
        return c.motor_get_max_position(self._tag)

    def getMaxVelocity(self) -> float:
        """rad/s: the most that setVelocity() takes."""
        return c.motor_get_max_velocity(self._tag)

    def getAvailableForce(self) -> float:
        """N."""
        return c.motor_get_available_force(self._tag)

    def getMaxForce(self) -> float:
        """N."""
        return c.motor_get_max_force(self._tag)

    def getAvailableTorque(self) -> float:
        """Nm."""
        return c.motor_get_available_torque(self._tag)

    def getMaxTorque(self) -> float:
        """Nm."""
        return c.motor_get_max_torque(self._tag)

    def getMultiplier(self) -> float:
        """1: no coupled motors."""
        return c.motor_get_multiplier(self._tag)

    def enableForceFeedback(self, sampling_period: int) -> None:
        """ms. The e-puck does not measure it."""
        c.motor_enable_force_feedback(self._tag, int(sampling_period))

    def disableForceFeedback(self) -> None:
        """Measures no more."""
        c.motor_disable_force_feedback(self._tag)

    def getForceFeedbackSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return c.motor_get_force_feedback_sampling_period(self._tag)

    def getForceFeedback(self) -> float:
        """N."""
        return c.motor_get_force_feedback(self._tag)

    def enableTorqueFeedback(self, sampling_period: int) -> None:
        """ms. The e-puck does not measure it."""
        c.motor_enable_torque_feedback(self._tag, int(sampling_period))

    def disableTorqueFeedback(self) -> None:
        """Measures no more."""
        c.motor_disable_torque_feedback(self._tag)

    def getTorqueFeedbackSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return c.motor_get_torque_feedback_sampling_period(self._tag)

    def getTorqueFeedback(self) -> float:
        """Nm."""
        return c.motor_get_torque_feedback(self._tag)

    def getType(self) -> int:
        """ROTATIONAL or LINEAR."""
        return c.motor_get_type(self._tag)

    def getPositionSensor(self) -> "Optional[PositionSensor]":
        """The sensor of the same wheel."""
        from .robot import device_of
        return device_of(c.motor_get_position_sensor(self._tag))

    def getBrake(self) -> None:
        """The e-puck has no brakes: None."""
        return None

    target_position = property(getTargetPosition, setPosition)
    target_velocity = property(getVelocity, setVelocity)
    target_acceleration = property(getAcceleration, setAcceleration)
    available_force = property(getAvailableForce, setAvailableForce)
    available_torque = property(getAvailableTorque, setAvailableTorque)
    force = property(None, setForce, doc="N, to set only.")
    torque = property(None, setTorque, doc="Nm, to set only.")
    min_position = property(getMinPosition)
    max_position = property(getMaxPosition)
    max_velocity = property(getMaxVelocity)
    max_force = property(getMaxForce)
    max_torque = property(getMaxTorque)
    multiplier = property(getMultiplier)
    force_feedback = property(getForceFeedback)
    torque_feedback = property(getTorqueFeedback)
    force_feedback_sampling_period = property(getForceFeedbackSamplingPeriod, enableForceFeedback)
    torque_feedback_sampling_period = property(getTorqueFeedbackSamplingPeriod, enableTorqueFeedback)
    type = property(getType)
    position_sensor = property(getPositionSensor)
    brake = property(getBrake)
