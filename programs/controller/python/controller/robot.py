# SPDX-License-Identifier: MIT
"""Robot: the program's robot, its devices and its steps."""
import atexit
import sys
from typing import Dict, Optional

from . import library
from .absent import Altimeter, Brake, Connector, Pen, Radar, Skin, VacuumGripper
from .accelerometer import Accelerometer
from .camera import Camera
from .compass import Compass
from .device import Device, reading
from .display import Display
from .distance_sensor import DistanceSensor
from .emitter import Emitter
from .gps import GPS
from .gyro import Gyro
from .inertial_unit import InertialUnit
from .keyboard import Joystick, Keyboard, Mouse
from .led import LED
from .library import c, warn
from .lidar import Lidar, RangeFinder
from .light_sensor import LightSensor
from .motor import Motor
from .node import Node
from .position_sensor import PositionSensor
from .receiver import Receiver
from .speaker import Microphone, Speaker
from .touch_sensor import TouchSensor

_CLASSES = {Node.ACCELEROMETER: Accelerometer, Node.CAMERA: Camera, Node.COMPASS: Compass, Node.DISPLAY: Display,
            Node.DISTANCE_SENSOR: DistanceSensor, Node.EMITTER: Emitter, Node.GPS: GPS, Node.GYRO: Gyro,
            Node.INERTIAL_UNIT: InertialUnit, Node.LED: LED, Node.LIGHT_SENSOR: LightSensor, Node.LINEAR_MOTOR: Motor,
            Node.ROTATIONAL_MOTOR: Motor, Node.POSITION_SENSOR: PositionSensor, Node.RECEIVER: Receiver,
            Node.LIDAR: Lidar, Node.RANGE_FINDER: RangeFinder, Node.SPEAKER: Speaker, Node.MICROPHONE: Microphone, Node.TOUCH_SENSOR: TouchSensor}

_devices: Dict[int, Device] = {}  # by tag: one object for each
_tags: Dict[str, int] = {}        # by name


def device_of(tag: int) -> Optional[Device]:
    """The object of a device; None: 0."""
    if not tag:
        return None
    if tag not in _devices:
        _devices[tag] = _CLASSES.get(c.device_get_node_type(tag), Device)(tag)
    return _devices[tag]


def _find(robot, name, kind=None):
    """The device of that name, made by the program's own createX() where it has one."""
    tag = _tags.get(name) or c.robot_get_device(name)
    if not tag:
        return None  # the library has warned
    _tags[name] = tag
    if kind and tag not in _devices:
        make = getattr(type(robot), "create" + kind.__name__)
        if make is not getattr(Robot, "create" + kind.__name__):
            _devices[tag] = make(robot, name)
    return device_of(tag)


class Robot:
    """The robot of this program. Make one, find its devices, then step:

        robot = Robot()
        time_step = int(robot.getBasicTimeStep())
        sensor = robot.getDevice("ps0")
        sensor.enable(time_step)
        while robot.step(time_step) != -1:
            print(sensor.getValue())

    A class of the program's own may be made of it; its attributes may have any names.
    """

    EVENT_QUIT, EVENT_NO_EVENT, EVENT_MOUSE_CLICK, EVENT_MOUSE_MOVE, EVENT_KEYBOARD = -1, 0, 1, 2, 4
    EVENT_JOYSTICK_BUTTON, EVENT_JOYSTICK_AXIS, EVENT_JOYSTICK_POV = 8, 16, 32
    MODE_SIMULATION, MODE_CROSS_COMPILATION, MODE_REMOTE_CONTROL = range(3)

    created: "Optional[Robot]" = None  # the first one

    def __init__(self):
        """Connects to the simulator; a program that was not started by it is told so and ends."""
        if Robot.created is not None:
            warn("Robot: got a second one, expected one in a program; it is the same robot")
            return
        Robot.created = self
        if hasattr(sys.stdout, "reconfigure") and not sys.stdout.isatty():
            sys.stdout.reconfigure(line_buffering=True, write_through=False)  # the console has each line at once, whole
        c.robot_init()
        atexit.register(c.robot_cleanup)

    def cleanup(self) -> None:
        """Leaves the simulation, which goes on without the program; it happens by itself when the program ends."""
        c.robot_cleanup()

    # --- time

    def step(self, time_step: Optional[int] = None) -> int:
        """Lets the world go on for `time_step` ms, or for one step of the world, and takes the samples.

        A multiple of getBasicTimeStep(). Commands of the program, as a motor's speed, begin with the step.
        0; or -1: the run is over, and the program should write its files and end within a second. A further step ends it.
        """
        return library.step(int(c.robot_get_basic_time_step() if time_step is None else time_step))

    def stepBegin(self, time_step: Optional[int] = None) -> int:
        """The first half of step(): the program goes on while the world steps. It commands and reads nothing until stepEnd()."""
        return c.robot_step_begin(int(c.robot_get_basic_time_step() if time_step is None else time_step))

    def stepEnd(self) -> int:
        """The second half of step(): waits and takes the samples. -1: the run is over."""
        return library.step_end()

    def getTime(self) -> float:
        """s since the run began."""
        return c.robot_get_time()

    def getBasicTimeStep(self) -> float:
        """ms: the world's step."""
        return c.robot_get_basic_time_step()

    # --- devices

    def getDevice(self, name: str) -> Optional[Device]:
        """The device of that name; always the same object. None: the robot has none, and a warning says so."""
        return _find(self, name)

    def getDeviceByIndex(self, index: int) -> Optional[Device]:
        """A device by its place, from 0 on."""
        return device_of(c.robot_get_device_by_index(index))

    def getNumberOfDevices(self) -> int:
        """How many devices the robot has."""
        return c.robot_get_number_of_devices()

    def getKeyboard(self) -> Keyboard:
        """The keyboard; it is to be enabled."""
        return _KEYBOARD

    def getMouse(self) -> Mouse:
        """The mouse, which is nowhere."""
        return _MOUSE

    def getJoystick(self) -> Joystick:
        """The joystick, which is not connected."""
        return _JOYSTICK

    # as versions up to R2022 have it; getDevice() does the same

    def getAccelerometer(self, name: str) -> Optional[Accelerometer]:
        return _find(self, name, Accelerometer)

    def getAltimeter(self, name: str) -> Optional[Altimeter]:
        return _find(self, name, Altimeter)

    def getBrake(self, name: str) -> Optional[Brake]:
        return _find(self, name, Brake)

    def getCamera(self, name: str) -> Optional[Camera]:
        return _find(self, name, Camera)

    def getCompass(self, name: str) -> Optional[Compass]:
        return _find(self, name, Compass)

    def getConnector(self, name: str) -> Optional[Connector]:
        return _find(self, name, Connector)

    def getDisplay(self, name: str) -> Optional[Display]:
        return _find(self, name, Display)

    def getDistanceSensor(self, name: str) -> Optional[DistanceSensor]:
        return _find(self, name, DistanceSensor)

    def getEmitter(self, name: str) -> Optional[Emitter]:
        return _find(self, name, Emitter)

    def getGPS(self, name: str) -> Optional[GPS]:
        return _find(self, name, GPS)

    def getGyro(self, name: str) -> Optional[Gyro]:
        return _find(self, name, Gyro)

    def getInertialUnit(self, name: str) -> Optional[InertialUnit]:
        return _find(self, name, InertialUnit)

    def getLED(self, name: str) -> Optional[LED]:
        return _find(self, name, LED)

    def getLidar(self, name: str) -> Optional[Lidar]:
        return _find(self, name, Lidar)

    def getLightSensor(self, name: str) -> Optional[LightSensor]:
        return _find(self, name, LightSensor)

    def getMicrophone(self, name: str) -> Optional[Microphone]:
        return _find(self, name, Microphone)

    def getMotor(self, name: str) -> Optional[Motor]:
        return _find(self, name, Motor)

    def getPen(self, name: str) -> Optional[Pen]:
        return _find(self, name, Pen)

    def getPositionSensor(self, name: str) -> Optional[PositionSensor]:
        return _find(self, name, PositionSensor)

    def getRadar(self, name: str) -> Optional[Radar]:
        return _find(self, name, Radar)

    def getRangeFinder(self, name: str) -> Optional[RangeFinder]:
        return _find(self, name, RangeFinder)

    def getReceiver(self, name: str) -> Optional[Receiver]:
        return _find(self, name, Receiver)

    def getSkin(self, name: str) -> Optional[Skin]:
        return _find(self, name, Skin)

    def getSpeaker(self, name: str) -> Optional[Speaker]:
        return _find(self, name, Speaker)

    def getTouchSensor(self, name: str) -> Optional[TouchSensor]:
        return _find(self, name, TouchSensor)

    def getVacuumGripper(self, name: str) -> Optional[VacuumGripper]:
        return _find(self, name, VacuumGripper)

    # --- what the robot and the world are

    def getName(self) -> str:
        """The robot's name in the world file."""
        return c.robot_get_name() or ""

    def getModel(self) -> str:
        """The robot's model."""
        return c.robot_get_model() or ""

    def getCustomData(self) -> str:
        """The robot's text, which supervisors and the program may change."""
        return c.robot_get_custom_data() or ""

    def setCustomData(self, data: str) -> None:
        """The robot's text, from the next step on for others."""
        c.robot_set_custom_data(data)

    def getProjectPath(self) -> str:
        """The folder above `worlds/` and `controllers/`."""
        return c.robot_get_project_path() or ""

    def getWorldPath(self) -> str:
        """The world file."""
        return c.robot_get_world_path() or ""

    def getSupervisor(self) -> bool:
        """Whether it may do what Supervisor has."""
        return c.robot_get_supervisor()

    def getSynchronization(self) -> bool:
        """True: the world waits for the program."""
        return c.robot_get_synchronization()

    def getMode(self) -> int:
        """MODE_SIMULATION."""
        return c.robot_get_mode()

    def setMode(self, mode: int, arg: str) -> None:
        """A remote control: there is none here."""
        c.robot_set_mode(mode, arg)

    def getUrdf(self, prefix: str = "") -> str:
        """The robot as URDF."""
        return c.robot_get_urdf(prefix) or ""

    # --- battery

    def batterySensorEnable(self, sampling_period: int) -> None:
        """Measures every `sampling_period` ms."""
        c.robot_battery_sensor_enable(int(sampling_period))

    def batterySensorDisable(self) -> None:
        """Measures no more."""
        c.robot_battery_sensor_disable()

    def batterySensorGetSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return c.robot_battery_sensor_get_sampling_period()

    def batterySensorGetValue(self) -> float:
        """What is in the battery, J."""
        return c.robot_battery_sensor_get_value()

    # --- a window, which is not there

    def wwiSendText(self, text: str) -> None:
        """To the robot's window: nobody reads it."""
        c.robot_wwi_send_text(text)

    def wwiReceiveText(self) -> Optional[str]:
        """From the robot's window: None."""
        return c.robot_wwi_receive_text() or None

    def waitForUserInputEvent(self, event_type: int, timeout: int) -> int:
        """Nobody types or clicks: EVENT_NO_EVENT."""
        return c.robot_wait_for_user_input_event(event_type, int(timeout))

    time = reading(getTime)
    basic_time_step = reading(getBasicTimeStep)
    name = reading(getName)
    model = reading(getModel)
    project_path = reading(getProjectPath)
    world_path = reading(getWorldPath)
    supervisor = reading(getSupervisor)
    synchronization = reading(getSynchronization)
    mode = reading(getMode)
    number_of_devices = reading(getNumberOfDevices)
    keyboard = reading(getKeyboard)
    mouse = reading(getMouse)
    joystick = reading(getJoystick)
    custom_data = property(getCustomData, setCustomData)

    @reading
    def devices(self) -> Dict[str, Device]:
        """All devices by their names."""
        found = [device_of(c.robot_get_device_by_index(i)) for i in range(c.robot_get_number_of_devices())]
        return {device.getName(): device for device in found if device}


def _creator(kind):
    def create(self, name):
        return kind(c.robot_get_device(name))
    create.__name__ = "create" + kind.__name__
    create.__doc__ = "Makes what get%s() gives; a class of the program's own may make one of its own." % kind.__name__
    return create


for _kind in set(_CLASSES.values()) | {Altimeter, Brake, Connector, Pen, Radar, Skin, VacuumGripper}:
    setattr(Robot, "create" + _kind.__name__, _creator(_kind))

_KEYBOARD, _MOUSE, _JOYSTICK = Keyboard(0), Mouse(0), Joystick(0)
