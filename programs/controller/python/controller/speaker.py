# SPDX-License-Identifier: MIT
"""Speaker and Microphone."""
import ctypes
from typing import Optional

from .device import Device, Sensor
from .library import c


class Speaker(Device):
    """The loudspeaker; it plays the five sounds that the robot holds."""

    @staticmethod
    def playSound(left: "Speaker", right: "Speaker", sound: str, volume: float, pitch: float, balance: float, loop: bool) -> None:
        """`sound` is a file or one of the robot's sounds; volume 0 to 1; pitch 1 as recorded; balance -1 left to 1;
        loop: again and again. The e-puck has one speaker: left and right are the same."""
        c.speaker_play_sound(left.tag, right.tag, sound, volume, pitch, balance, bool(loop))

    def stop(self, sound: Optional[str] = None) -> None:
        """Ends a sound; without one, all of them."""
        c.speaker_stop(self._tag, sound)

    def isSoundPlaying(self, sound: Optional[str] = None) -> bool:
        """Whether this sound, or without one any, is to be heard."""
        return c.speaker_is_sound_playing(self._tag, sound)

    def setEngine(self, engine: str) -> bool:
        """Of speak(). The robot has none: False."""
        return c.speaker_set_engine(self._tag, engine)

    def setLanguage(self, language: str) -> bool:
        """Of speak(). The robot has none: False."""
        return c.speaker_set_language(self._tag, language)

    def getEngine(self) -> str:
        """Of speak()."""
        return c.speaker_get_engine(self._tag)

    def getLanguage(self) -> str:
        """Of speak()."""
        return c.speaker_get_language(self._tag)

    def speak(self, text: str, volume: float) -> None:
        """The robot cannot speak: no effect, a warning."""
        c.speaker_speak(self._tag, text, volume)

    def isSpeaking(self) -> bool:
        """False."""
        return c.speaker_is_speaking(self._tag)


class Microphone(Sensor):
    """One of the e-puck's three: `mic0` right, `mic1` left, `mic2` behind."""

    _kind = "microphone"

    def getSampleSize(self) -> int:
        """Bytes that getSampleData() gives."""
        return c.microphone_get_sample_size(self._tag)

    def getSampleData(self) -> bytes:
        """Signed numbers of 2 bytes, 16384 a second, the oldest first; empty before the first sample."""
        address = c.microphone_get_sample_data(self._tag)
        return ctypes.string_at(address, c.microphone_get_sample_size(self._tag)) if address else b""

    sample_size = property(getSampleSize)
    sample_data = property(getSampleData)
