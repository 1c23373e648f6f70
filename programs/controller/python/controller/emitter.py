# SPDX-License-Identifier: MIT
"""Emitter: sends packets."""
import struct
from typing import Optional, Sequence, Union

from .device import Device
from .library import c


def packed(message) -> bytes:
    """The bytes of a message, as Emitter.send() takes it."""
    if isinstance(message, str):
        return message.encode()
    if isinstance(message, (bytes, bytearray, memoryview)):
        return bytes(message)
    try:
        members = list(message)
    except TypeError:
        members = []
    if members and all(isinstance(m, bool) for m in members):
        return struct.pack("%d?" % len(members), *members)
    if members and all(isinstance(m, int) for m in members):
        return struct.pack("%di" % len(members), *members)
    try:
        if members:
            return struct.pack("%dd" % len(members), *members)
    except struct.error:
        pass
    raise TypeError("Emitter.send: got %r, expected text, bytes or a list of numbers" % (message,))


class Emitter(Device):
    """Sends packets on its channel to receivers that are near enough; they have them with the next step."""

    CHANNEL_BROADCAST = -1

    def send(self, message: Union[str, bytes, Sequence[float]], length: Optional[int] = None) -> int:
        """Text goes as UTF-8, bytes as they are (the first `length` of them), numbers as getFloats(), getInts() and
        getBools() of Receiver read them. 1: sent; 0: the queue is full."""
        data = packed(message)
        if length is not None:
            data = data[:length].ljust(length, b"\0")
        return c.emitter_send(self._tag, data, len(data))

    def getChannel(self) -> int:
        """0 and above; -1: all."""
        return c.emitter_get_channel(self._tag)

    def setChannel(self, channel: int) -> None:
        """0 and above; -1: all."""
        c.emitter_set_channel(self._tag, int(channel))

    def getRange(self) -> float:
        """m; -1: no limit."""
        return c.emitter_get_range(self._tag)

    def setRange(self, range: float) -> None:
        """m; -1: no limit. Not above what the world says."""
        c.emitter_set_range(self._tag, range)

    def getBufferSize(self) -> int:
        """Bytes that can wait for the next step."""
        return c.emitter_get_buffer_size(self._tag)

    channel = property(getChannel, setChannel)
    range = property(getRange, setRange)
    buffer_size = property(getBufferSize)
