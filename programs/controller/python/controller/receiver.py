# SPDX-License-Identifier: MIT
"""Receiver: packets that others have sent."""
import ctypes
import struct
from typing import List, Tuple

from .device import Sensor, numbers
from .library import c


class Data(bytes):
    """A packet's bytes, as getData() gives them up to R2022. Where R2023 gives text, programs compare and search with text:
    `data == "go"`, `"go" in data`, `data.startswith("go")`, `data.split(",")` do so."""

    def __eq__(self, other):
        return self.decode() == other if isinstance(other, str) else bytes.__eq__(self, other)

    def __ne__(self, other):
        return not self == other

    __hash__ = bytes.__hash__

    def __contains__(self, part):
        return part in self.decode() if isinstance(part, str) else bytes.__contains__(self, part)


def _of_text_too(name):
    of_bytes = getattr(bytes, name)

    def method(self, *arguments):
        if any(isinstance(a, str) for a in arguments):
            return getattr(self.decode(), name)(*arguments)
        return of_bytes(self, *arguments)
    method.__name__ = name
    return method


for _name in ("startswith", "endswith", "split", "rsplit", "partition", "rpartition", "strip", "lstrip", "rstrip", "find",
              "rfind", "index", "count", "replace"):
    setattr(Data, _name, _of_text_too(_name))


class Receiver(Sensor):
    """Hears packets on its channel.

        while receiver.getQueueLength() > 0:
            text = receiver.getString()
            receiver.nextPacket()

    The functions that read are about the packet at the head of the queue, the oldest one.
    """

    CHANNEL_BROADCAST = -1
    _kind = "receiver"

    def getQueueLength(self) -> int:
        """How many packets are there."""
        return c.receiver_get_queue_length(self._tag)

    def nextPacket(self) -> None:
        """Drops the packet at the head."""
        c.receiver_next_packet(self._tag)

    def getBytes(self) -> bytes:
        """The packet as it was sent; empty: there is none."""
        address = c.receiver_get_data(self._tag)
        return ctypes.string_at(address, c.receiver_get_data_size(self._tag)) if address else b""

    def getData(self) -> Data:
        """The same as getBytes(), as versions up to R2022 have it; compared with text it is text, as R2023 has it."""
        return Data(self.getBytes())

    def getString(self) -> str:
        """The packet as UTF-8 text, without the 0 that programs in C send at its end."""
        data = self.getBytes()
        return (data[:-1] if data.endswith(b"\0") else data).decode()

    def getFloats(self) -> Tuple[float, ...]:
        """The packet as numbers of 8 bytes: double in C, what Emitter.send() makes of a list of float."""
        return self._unpacked("d")

    def getInts(self) -> Tuple[int, ...]:
        """The packet as numbers of 4 bytes: int in C, what Emitter.send() makes of a list of int."""
        return self._unpacked("i")

    def getBools(self) -> Tuple[bool, ...]:
        """The packet as bytes that are 0 or not."""
        return self._unpacked("?")

    def _unpacked(self, kind):
        data = self.getBytes()
        size = struct.calcsize(kind)
        return struct.unpack("%d%s" % (len(data) // size, kind), data[:len(data) // size * size])

    def getDataSize(self) -> int:
        """Bytes; 0: there is no packet."""
        return c.receiver_get_data_size(self._tag)

    def getSignalStrength(self) -> float:
        """1 / d2, d the distance to the sender in m."""
        return c.receiver_get_signal_strength(self._tag)

    def getEmitterDirection(self) -> List[float]:
        """A unit vector towards the sender, in the robot's axes."""
        return numbers(c.receiver_get_emitter_direction(self._tag), 3)

    def getChannel(self) -> int:
        """0 and above; -1: all."""
        return c.receiver_get_channel(self._tag)

    def setChannel(self, channel: int) -> None:
        """0 and above; -1: all."""
        c.receiver_set_channel(self._tag, int(channel))

    queue_length = property(getQueueLength)
    data = property(getBytes)
    data_size = property(getDataSize)
    string = property(getString)
    signal_strength = property(getSignalStrength)
    emitter_direction = property(getEmitterDirection)
    channel = property(getChannel, setChannel)
