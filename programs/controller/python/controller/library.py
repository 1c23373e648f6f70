# SPDX-License-Identifier: MIT
"""libcontroller.so, as the classes of this package call it.

`c.motor_set_velocity(tag, speed)` calls `wb_motor_set_velocity()`. The library is looked for at the first call, so that
this package can be imported, read and completed in an editor where no simulator is. A function is bound when it is
first called; after that a call costs what ctypes takes.

It is found by TWINPUCK_LIBCONTROLLER, a path, or else beside this package: in its clone's build/, or where it is installed.
"""
import ctypes
import math
import os
import sys

from .functions import FUNCTIONS

LANGUAGE = 2  # of a HELLO: Python

steps = 0     # how many steps the program has made; what was read before the last one is old
over = False  # a step has returned -1


class Text(ctypes.c_char_p):
    """An argument: str, bytes or None."""

    @classmethod
    def from_param(cls, value):
        if not isinstance(value, (str, bytes, type(None))):  # a number would be an address
            raise TypeError("got %r, expected text" % (value,))
        return ctypes.c_char_p(value.encode() if isinstance(value, str) else value)


class Numbers:
    """An argument: some numbers, of a list, a tuple, an array."""

    @classmethod
    def from_param(cls, value):
        return (ctypes.c_double * len(value))(*value)


class Ints:
    """An argument: some whole numbers."""

    @classmethod
    def from_param(cls, value):
        return (ctypes.c_int * len(value))(*[int(v) for v in value])


RESULTS = {"v": None, "i": ctypes.c_int, "l": ctypes.c_long, "t": ctypes.c_ushort, "b": ctypes.c_bool, "d": ctypes.c_double, "s": ctypes.c_char_p,
           "p": ctypes.c_void_p, "D": ctypes.POINTER(ctypes.c_double)}
ARGUMENTS = {"i": ctypes.c_int, "l": ctypes.c_long, "t": ctypes.c_ushort, "b": ctypes.c_bool, "d": ctypes.c_double, "s": Text, "p": ctypes.c_void_p, "B": ctypes.c_void_p,
             "D": Numbers, "I": Ints}
NOTHING = {"v": None, "i": 0, "l": 0, "t": 0, "b": False, "d": math.nan, "s": "", "p": None, "D": None}


def _decoded(result, function, arguments):
    return None if result is None else result.decode(errors="replace")


def _places():
    """Where the library may be: as told; or beside this package, as it is installed; or in the build of its clone."""
    told = os.environ.get("TWINPUCK_LIBCONTROLLER")
    if told:
        return [told]
    package = os.path.dirname(os.path.abspath(__file__))
    clone = os.path.dirname(os.path.dirname(os.path.dirname(os.path.dirname(package))))
    prefix = os.path.dirname(os.path.dirname(clone))  # of PREFIX/share/twinpuck
    return [os.path.join(os.path.dirname(package), "libcontroller.so"), os.path.join(clone, "build", "libcontroller.so"),
            os.path.join(prefix, "lib", "twinpuck", "libcontroller.so")]


def _load():
    for place in _places():
        if os.path.exists(place):
            # calls keep Python's lock, so that threads of the program meet one at a time in the library
            return ctypes.PyDLL(place)
    raise ImportError("controller: got no %s, expected the simulator's library there; build twinpuck, or name it in "
                      "TWINPUCK_LIBCONTROLLER" % " and no ".join(_places()))


def warn(text):
    """A line on stderr that names the line of the program which made the call."""
    frame = sys._getframe(1)
    package = os.path.dirname(os.path.abspath(__file__))
    while frame.f_back and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == package:
        frame = frame.f_back
    print("%s:%d: %s" % (os.path.basename(frame.f_code.co_filename), frame.f_lineno, text), file=sys.stderr)


class _Library:
    """The functions that were called, as attributes; another one is bound when it is asked for."""

    def __getattr__(self, name):
        try:
            result, arguments = FUNCTIONS[name]
        except KeyError:
            raise AttributeError(name) from None
        if "_library" not in self.__dict__:
            self.__dict__["_library"] = _load()
            self.twinpuck_language(LANGUAGE, os.path.basename(sys.argv[0]) if sys.argv else None)
        symbol = name if name.startswith("twinpuck_") else "wb_" + name
        try:
            library = self.__dict__["_library"]
            if name == "twinpuck_wait":  # the one that blocks lets the other threads run meanwhile
                library = ctypes.CDLL(library._name, handle=library._handle)
            function = library[symbol]
            function.restype = RESULTS[result]
            function.argtypes = [ARGUMENTS[a] for a in arguments]
            if result == "s":
                function.errcheck = _decoded
        except AttributeError:
            function = _missing(symbol, NOTHING[result])
        self.__dict__[name] = function
        return function


def _missing(symbol, result):
    told = []

    def function(*arguments):
        if not told:
            told.append(True)
            warn("%s() is not there; it does nothing" % symbol)
        return result
    return function


c = _Library()


def step(ms):
    """A step, for which other threads of the program do not have to wait. 0; -1: the run is over."""
    if over:
        raise SystemExit(0)  # it was told and goes on; the library would end the process with words unprinted
    c.robot_step_begin(ms)
    return step_end()


def step_end():
    """The second half of a step."""
    global steps, over
    if over:
        raise SystemExit(0)
    while not c.twinpuck_wait():
        pass  # a signal: Python handles it here
    steps += 1
    result = c.robot_step_end()
    over = result < 0
    return result
