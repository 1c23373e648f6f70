# SPDX-License-Identifier: MIT
"""Keyboard, Mouse, MouseState, Joystick: what somebody does at the simulator."""
from typing import Optional

from .library import c


class Keyboard:
    """Keys that are down: those of `twinpuck run --key ROBOT=keyboard:UP@TIME`. `robot.getKeyboard()` gives it.

    Letters are capitals (`ord("W")`), others the constants here; with SHIFT, CONTROL and ALT added where they are down.
    """

    END, HOME, LEFT, UP, RIGHT, DOWN = range(312, 318)
    PAGEUP, PAGEDOWN = 366, 367
    NUMPAD_HOME, NUMPAD_LEFT, NUMPAD_UP, NUMPAD_RIGHT, NUMPAD_DOWN, NUMPAD_END = 375, 376, 377, 378, 379, 382
    KEY, SHIFT, CONTROL, ALT = 0x0000ffff, 0x00010000, 0x00020000, 0x00040000

    def __init__(self, sampling_period: Optional[int] = None):
        """Enabled at once, every `sampling_period` ms or every step of the world; 0: not."""
        from .robot import Robot
        if sampling_period is None:
            sampling_period = int(c.robot_get_basic_time_step()) if Robot.created else 0
        if sampling_period:
            self.enable(sampling_period)

    def enable(self, sampling_period: int) -> None:
        """Looks every `sampling_period` ms, at ends of steps."""
        c.keyboard_enable(int(sampling_period))

    def disable(self) -> None:
        """Looks no more."""
        c.keyboard_disable()

    def getSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return c.keyboard_get_sampling_period()

    def getKey(self) -> int:
        """The next key that is down; -1: no more of them in this step."""
        return c.keyboard_get_key()

    getKeyCode = getKey

    def get_key(self) -> str:
        """The next key in words, as "shift-left" or "W"; empty: no more of them in this step."""
        code = c.keyboard_get_key()
        if code < 0:
            return ""
        words = [word for bit, word in ((self.SHIFT, "shift"), (self.CONTROL, "control"), (self.ALT, "alt")) if code & bit]
        return "-".join(words + [_NAMES.get(code & self.KEY) or chr(code & self.KEY)])

    @property
    def sampling_period(self) -> int:
        """ms; 0: not enabled. Setting it enables."""
        return c.keyboard_get_sampling_period()

    @sampling_period.setter
    def sampling_period(self, sampling_period: Optional[int]) -> None:
        c.keyboard_enable(int(sampling_period or 0))


_NAMES = {getattr(Keyboard, name): name.lower().replace("_", " ").replace("page", "page ")
          for name in ("END", "HOME", "LEFT", "UP", "RIGHT", "DOWN", "PAGEUP", "PAGEDOWN", "NUMPAD_HOME", "NUMPAD_LEFT",
                       "NUMPAD_UP", "NUMPAD_RIGHT", "NUMPAD_DOWN", "NUMPAD_END")}


class _Absent:
    """Somebody's hand that is never there: runs have no window."""

    def __init__(self, sampling_period: Optional[int] = None):
        self.sampling_period = int(sampling_period or 0)

    def enable(self, sampling_period: int) -> None:
        """ms. Accepted."""
        self.sampling_period = int(sampling_period)

    def disable(self) -> None:
        """Accepted."""
        self.sampling_period = 0

    def getSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return self.sampling_period


class MouseState:
    """Where the mouse is, 0 to 1 from the left and the top of the window, and at which place of the world, m."""

    def __init__(self):
        nan = float("nan")
        self.u: float = nan
        self.v: float = nan
        self.x: float = nan
        self.y: float = nan
        self.z: float = nan
        self.left = self.middle = self.right = False


class Mouse(_Absent):
    """A run has no window: the mouse is nowhere (NaN), no button is down."""

    _in_space = False

    def getState(self) -> MouseState:
        """NaN and False."""
        return MouseState()

    def enable3dPosition(self) -> None:
        """Accepted."""
        self._in_space = True

    def disable3dPosition(self) -> None:
        """Accepted."""
        self._in_space = False

    def is3dPositionEnabled(self) -> bool:
        """As it was set."""
        return self._in_space


class Joystick(_Absent):
    """There is none: isConnected() is False."""

    def isConnected(self) -> bool:
        """False."""
        return False

    def getModel(self) -> str:
        """Empty."""
        return ""

    def getNumberOfAxes(self) -> int:
        """0."""
        return 0

    def getAxisValue(self, axis: int) -> int:
        """0."""
        return 0

    def getNumberOfPovs(self) -> int:
        """0."""
        return 0

    def getPovValue(self, pov: int) -> int:
        """0."""
        return 0

    def getPressedButton(self) -> int:
        """-1: none."""
        return -1

    def setConstantForce(self, level: int) -> None:
        """Accepted."""

    def setConstantForceDuration(self, duration: float) -> None:
        """Accepted."""

    def setAutoCenteringGain(self, gain: float) -> None:
        """Accepted."""

    def setResistanceGain(self, gain: float) -> None:
        """Accepted."""

    def setForceAxis(self, axis: int) -> None:
        """Accepted."""

    is_connected = property(isConnected)
    model = property(getModel)
    number_of_axes = property(getNumberOfAxes)
    number_of_povs = property(getNumberOfPovs)
    pressed_button = property(getPressedButton)
