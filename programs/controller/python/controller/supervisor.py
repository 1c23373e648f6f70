# SPDX-License-Identifier: MIT
"""Supervisor: a program that may see and change the whole world."""
from typing import Optional

from .library import c
from .node import Node, node_or_none
from .robot import Robot


class Supervisor(Robot):
    """A robot's program, or one of its own, with the right to see and change the world (`supervisor` in the world file).
    Without that right the functions here warn and do nothing.

        supervisor = Supervisor()
        ball = supervisor.getFromDef("BALL")
        while supervisor.step(64) != -1:
            print(ball.getPosition())

    Places are m, angles rad, in the world's axes.
    """

    SIMULATION_MODE_PAUSE, SIMULATION_MODE_REAL_TIME, SIMULATION_MODE_FAST = range(3)
    SIMULATION_MODE_RUN = SIMULATION_MODE_FAST
    MOVIE_READY, MOVIE_RECORDING, MOVIE_SAVING, MOVIE_WRITE_ERROR, MOVIE_ENCODING_ERROR, MOVIE_SIMULATION_ERROR = range(6)

    # --- nodes

    def getRoot(self) -> Optional[Node]:
        """The node that holds all others, in its field `children`."""
        return node_or_none(c.supervisor_node_get_root())

    def getSelf(self) -> Optional[Node]:
        """The node of the program's own robot."""
        return node_or_none(c.supervisor_node_get_self())

    def getFromDef(self, DEF: str) -> Optional[Node]:
        """The node of that DEF, or else of that name; of one inside another: "OUTER.INNER". None: there is none."""
        return node_or_none(c.supervisor_node_get_from_def(DEF))

    def getFromId(self, id: int) -> Optional[Node]:
        """The node of that number; None: there is none."""
        return node_or_none(c.supervisor_node_get_from_id(id))

    def getFromDevice(self, device) -> Optional[Node]:
        """The node of a device of the program's own robot, or of its tag."""
        return node_or_none(c.supervisor_node_get_from_device(getattr(device, "tag", device)))

    def getSelected(self) -> Optional[Node]:
        """The node that somebody has selected in the view; None: there is none."""
        return node_or_none(c.supervisor_node_get_selected())

    # --- the run

    def simulationQuit(self, status: int = 0) -> None:
        """The run ends with this status, with the next step: 0 passed, else failed."""
        c.supervisor_simulation_quit(int(status))

    def simulationReset(self) -> None:
        """The world begins again, with the next step: all robots, objects and programs but this one."""
        c.supervisor_simulation_reset()

    def simulationResetPhysics(self) -> None:
        """All come to rest."""
        c.supervisor_simulation_reset_physics()

    def simulationRevert(self) -> None:
        """The same as worldReload(), as old versions have it."""
        c.supervisor_world_reload()

    def simulationGetMode(self) -> int:
        """SIMULATION_MODE_FAST."""
        return c.supervisor_simulation_get_mode()

    def simulationSetMode(self, mode: int) -> None:
        """Accepted; how fast a run goes is the command's --speed."""
        c.supervisor_simulation_set_mode(int(mode))

    def worldReload(self) -> None:
        """The world begins again, this program too."""
        c.supervisor_world_reload()

    def worldLoad(self, filename: str) -> None:
        """Another world: not in a run, a warning."""
        c.supervisor_world_load(filename)

    def worldSave(self, filename: Optional[str] = None) -> bool:
        """Writes the world into a file: not in a run, a warning, False."""
        return c.supervisor_world_save(filename)

    # --- pictures and labels

    def setLabel(self, id: int, label: str, x: float, y: float, size: float, color: int, transparency: float = 0,
                 font: str = "Arial") -> None:
        """Text on the picture of the world: x, y from the upper left corner, 0 to 1; size 0 to 1 of the picture's
        height; color 0xRRGGBB; transparency 0 to 1. A label of the same id is replaced."""
        c.supervisor_set_label(int(id), label, x, y, size, int(color), transparency, font)

    def exportImage(self, filename: str, quality: int = 100) -> None:
        """A picture of the world, from above: PNG or SVG."""
        c.supervisor_export_image(filename, int(quality))

    def movieStartRecording(self, filename: str, width: int, height: int, codec: int = 0, quality: int = 100,
                            acceleration: int = 1, caption: bool = False) -> None:
        """Films are made by `twinpuck run --film`: a warning."""
        c.supervisor_movie_start_recording(filename, width, height, codec, quality, acceleration, bool(caption))

    def movieStopRecording(self) -> None:
        """Accepted."""
        c.supervisor_movie_stop_recording()

    def movieIsReady(self) -> bool:
        """Whether a film is written."""
        return c.supervisor_movie_is_ready()

    def movieFailed(self) -> bool:
        """Whether a film could not be written."""
        return c.supervisor_movie_failed()

    def movieGetStatus(self) -> int:
        """MOVIE_READY."""
        return self.MOVIE_READY

    startMovie = movieStartRecording
    stopMovie = movieStopRecording

    def animationStartRecording(self, filename: str) -> bool:
        """A page of the run is made by `twinpuck run --report`: False."""
        return c.supervisor_animation_start_recording(filename)

    def animationStopRecording(self) -> bool:
        """Accepted."""
        return c.supervisor_animation_stop_recording()

    def virtualRealityHeadsetIsUsed(self) -> bool:
        """False."""
        return False

    simulation_mode = property(simulationGetMode, simulationSetMode)
