# SPDX-License-Identifier: MIT
"""LED: a light of the robot."""
from .device import Device
from .library import c


class LED(Device):
    """A light: `led0` ahead to `led7` clockwise in the ring, `led8` in the body, `led9` in front."""

    def set(self, value: int) -> None:
        """0: off; anything else: on. The e-puck's have one colour."""
        c.led_set(self._tag, int(value))

    def get(self) -> int:
        """What was set."""
        return c.led_get(self._tag)

    value = property(get, set)
