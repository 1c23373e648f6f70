# SPDX-License-Identifier: MIT
"""Device and Sensor: what all devices of a robot have in common."""
from typing import Any, Callable, Generic, Optional, TypeVar, Union

from .library import c


T = TypeVar("T")


class reading(Generic[T]):
    """A read-only attribute that a program may hide by one of its own: `self.name = "bob"` in a class of its own."""

    def __init__(self, get: Callable[[Any], T]):
        self.get = get
        self.__doc__ = get.__doc__

    def __get__(self, owner: Any, kind: Any = None) -> T:
        return self if owner is None else self.get(owner)  # type: ignore


class Device:
    """A device of the robot. `robot.getDevice(name)` gives it."""

    def __init__(self, name: Union[str, int]):
        self._tag = name if isinstance(name, int) else c.robot_get_device(name)

    def getName(self) -> str:
        """Its name, as in the world file."""
        return c.device_get_name(self._tag)

    def getModel(self) -> str:
        """Its model; empty where the world says none."""
        return c.device_get_model(self._tag)

    def getNodeType(self) -> int:
        """Its kind, one of the constants of Node, as Node.DISTANCE_SENSOR."""
        return c.device_get_node_type(self._tag)

    name = property(getName)
    model = property(getModel)
    node_type = property(getNodeType)

    @property
    def tag(self) -> int:
        """Its number in C, from 1 on; 0: there is no such device."""
        return self._tag

    def __repr__(self):
        return "<%s %r>" % (type(self).__name__, c.device_get_name(self._tag))


class Sensor(Device):
    """A device that takes samples: nothing before enable(), and nothing before the first period is over."""

    _kind = ""  # its functions in C begin with it

    def __init__(self, name: Union[str, int], sampling_period: Optional[int] = None):
        """By its name it is enabled at once, every `sampling_period` ms or every step of the world."""
        super().__init__(name)
        if isinstance(name, str) and self._tag:
            self.enable(int(c.robot_get_basic_time_step()) if sampling_period is None else sampling_period)

    def enable(self, sampling_period: int) -> None:
        """Takes a sample every `sampling_period` ms, at ends of steps; 0: no more."""
        getattr(c, self._kind + "_enable")(self._tag, int(sampling_period))

    def disable(self) -> None:
        """Takes no more samples."""
        getattr(c, self._kind + "_disable")(self._tag)

    def getSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return getattr(c, self._kind + "_get_sampling_period")(self._tag)

    @property
    def sampling_period(self) -> int:
        """ms; 0: not enabled. Setting it enables."""
        return self.getSamplingPeriod()

    @sampling_period.setter
    def sampling_period(self, sampling_period: Optional[int]) -> None:
        self.enable(sampling_period or 0)


NAN = float("nan")


def numbers(pointer, count):
    """So many numbers at the address that a function of C gave."""
    return pointer[:count] if pointer else [NAN] * count


class LookupTable:
    """For sensors whose world may hold a table of measured and returned values."""

    _kind = ""

    def getLookupTable(self) -> list:
        """Rows of three numbers, one after the other: true value, returned value, noise; empty: no table."""
        count = getattr(c, self._kind + "_get_lookup_table_size")(self._tag)
        return numbers(getattr(c, self._kind + "_get_lookup_table")(self._tag), 3 * count)

    lookup_table = property(getLookupTable)


