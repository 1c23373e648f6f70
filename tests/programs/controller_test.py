# SPDX-License-Identifier: MIT
"""Programs of robots in Python, against a simulator that the test plays: what they send, what they see.
The library is TWINPUCK_LIBCONTROLLER's or the build's."""
import os
import struct
import subprocess
import sys
import unittest

from fake_simulator import Simulator, python, record

# kinds, as in webots/nodes.h
ACCELEROMETER, CAMERA, COMPASS, DISPLAY, DISTANCE_SENSOR, EMITTER, GPS, GYRO, INERTIAL_UNIT, LED, LIGHT_SENSOR = \
    35, 38, 39, 41, 42, 43, 44, 45, 46, 47, 49
LIDAR, RANGE_FINDER = 48, 55
POSITION_SENSOR, RECEIVER, MOTOR, SPEAKER, TOUCH_SENSOR, MICROPHONE = 52, 56, 57, 59, 60, 86

PUCK = [(1, DISTANCE_SENSOR, "ps0", [0, 4095, 0.3, 1]), (2, DISTANCE_SENSOR, "ps1", [0, 4095, 0.3, 1]),
        (3, MOTOR, "left wheel motor", [6.28, 5]), (4, MOTOR, "right wheel motor", [6.28, 6]),
        (5, POSITION_SENSOR, "left wheel sensor", [3]), (6, POSITION_SENSOR, "right wheel sensor", [4]),
        (7, LED, "led0", []), (8, CAMERA, "camera", [3, 2, 0.84, 0.0055, 1]), (9, RECEIVER, "receiver", [1]),
        (10, EMITTER, "emitter", [1, -1, 4096]), (11, GPS, "gps", []), (12, COMPASS, "compass", []),
        (13, INERTIAL_UNIT, "inertial unit", []), (14, ACCELEROMETER, "accelerometer", []), (15, GYRO, "gyro", []),
        (16, LIGHT_SENSOR, "ls0", []), (17, TOUCH_SENSOR, "bumper", [0]), (18, DISPLAY, "display", [4, 3]),
        (19, SPEAKER, "speaker", []), (20, MICROPHONE, "mic0", []), (21, 0, "keyboard", []), (22, 0, "battery", [])]


class Programs(unittest.TestCase):
    def run_program(self, text, simulator=None, status=0, **more):
        simulator = simulator or Simulator(PUCK)
        run = python(text, simulator, **more)
        self.assertEqual(run.status, status, run.out + run.err)
        return run

    def lines(self, text, simulator=None, **more):
        run = self.run_program(text, simulator, **more)
        self.assertEqual(run.err, "")
        return run.out.splitlines()


class Beginning(Programs):
    def test_it_says_who_it_is(self):
        run = self.run_program("from controller import Robot; Robot()")
        self.assertEqual(run.said, [("HELLO", 2, 2, b"program.py")])

    def test_imports_by_all_names(self):
        self.assertEqual(self.lines("""
import controller
from controller import *
from controller.robot import Robot as A
from webots.controller import Robot as B, Supervisor
import webots.controller
print(Robot is A is B is controller.Robot is webots.controller.Robot, issubclass(Supervisor, Robot))
print(Node.ROBOT, Node.SOLID, Node.RADIO, Keyboard.LEFT, Keyboard.NUMPAD_END, Field.MF_NODE, repr(AnsiCodes.RED_FOREGROUND))
"""), ["True True", "34 80 87 314 382 25 '\\x1b[31m'"])

    def test_what_the_robot_and_the_world_are(self):
        self.assertEqual(self.lines("""
from controller import Robot
robot = Robot()
print(robot.getName(), robot.name, robot.getModel(), robot.getBasicTimeStep(), robot.basic_time_step)
print(robot.getCustomData(), robot.getProjectPath(), robot.getWorldPath(), robot.getSupervisor(), robot.getMode())
robot.custom_data = "mine"
print(robot.getCustomData(), robot.getTime())
robot.step()
print(robot.time)
"""), ["puck puck e-puck 32.0 32.0", "custom /project world.toml False 0", "mine 0.0", "0.032"])

    def test_a_class_of_the_programs_own_may_use_any_names(self):
        run = self.run_program("""
from controller import Robot
class Environment:
    pass
class Mine(Robot, Environment):
    def __init__(self):
        super().__init__()
        self.name, self.time, self.supervisor, self.mode, self.model = "bob", 5, None, "walk", [1]
        self.keyboard = self.getKeyboard()
        self.devices = [self.getDevice("ps%d" % i) for i in range(2)]
    def getName(self):
        return "overridden"
    def drive(self):
        for device in self.devices:
            device.enable(32)
        self.step(32)
        return [device.getValue() for device in self.devices]
mine = Mine()
print(mine.drive(), mine.name, mine.time, mine.getTime(), mine.getName())
""", Simulator(PUCK, lambda step: record("NUMBERS", 1, [7]) + record("NUMBERS", 2, [8])))
        self.assertEqual((run.out, run.err), ("[7.0, 8.0] bob 5 0.032 overridden\n", ""))

    def test_a_second_robot_is_the_same_one(self):
        run = self.run_program("""
from controller import Robot, Supervisor
first = Robot()
second = Supervisor()
print(second.getDevice("ps0") is first.getDevice("ps0"))
""")
        self.assertEqual(run.out, "True\n")
        self.assertIn("program.py:4: Robot: got a second one, expected one in a program", run.err)
        self.assertEqual(len(run.of("HELLO")), 1)

    def test_no_library_is_told(self):
        run = self.run_program("from controller import Robot; Robot()", status=1,
                               environment={"TWINPUCK_LIBCONTROLLER": "/nowhere/libcontroller.so"})
        self.assertIn("got no /nowhere/libcontroller.so", run.err)


class Devices(Programs):
    def test_a_number_is_no_text(self):
        self.assertEqual(self.lines("""
from controller import Robot
robot = Robot()
camera = robot.getDevice("camera")
for call in (lambda: robot.getDevice(5), lambda: setattr(robot, "custom_data", 5), lambda: camera.saveImage(5, 1)):
    try:
        call()
    except Exception as wrong:
        print(str(wrong).split(": ")[-1])
"""), ["got 5, expected text"] * 3)

    def test_a_sensor_has_values_after_its_period(self):
        run = self.run_program("""
from controller import Robot
robot = Robot()
sensor = robot.getDevice("ps0")
print(sensor.getSamplingPeriod())
sensor.enable(64)
print(sensor.getValue(), sensor.getSamplingPeriod(), sensor.sampling_period)
robot.step(32)
print(sensor.getValue())
robot.step(32)
print(sensor.getValue(), sensor.value)
sensor.disable()
robot.step(32)
""", Simulator(PUCK, lambda step: record("NUMBERS", 1, [100.5]) if step == 2 else b""))
        self.assertEqual(run.out.split(), ["0", "nan", "64", "64", "nan", "100.5", "100.5"])
        self.assertEqual(run.of("ENABLE"), [(1, 64), (1, 0)])
        self.assertEqual(run.of("STEP"), [(32,), (32,), (32,)])

    def test_devices_by_all_names_are_the_same_objects(self):
        self.assertEqual(self.lines("""
from controller import *
robot = Robot()
motor = robot.getMotor("left wheel motor")
print(type(motor).__name__, motor is robot.getDevice("left wheel motor"), motor is robot.devices["left wheel motor"])
print(motor.getPositionSensor() is robot.getPositionSensor("left wheel sensor"), motor.getPositionSensor().getMotor() is motor)
print(robot.getNumberOfDevices(), robot.getDeviceByIndex(0).getName(), robot.getDevice("ps0").getNodeType() == Node.DISTANCE_SENSOR)
for get, name in (("DistanceSensor", "ps0"), ("LED", "led0"), ("Camera", "camera"), ("Receiver", "receiver"), ("Emitter", "emitter"),
                  ("GPS", "gps"), ("Compass", "compass"), ("InertialUnit", "inertial unit"), ("Accelerometer", "accelerometer"),
                  ("Gyro", "gyro"), ("LightSensor", "ls0"), ("TouchSensor", "bumper"), ("Display", "display"),
                  ("Speaker", "speaker"), ("Microphone", "mic0")):
    assert type(getattr(robot, "get" + get)(name)) is globals()[get], get
"""), ["Motor True True", "True True", "20 ps0 True"])

    def test_lidars_and_range_finders_give_rows_of_distances(self):
        inf = float("inf")
        simulator = Simulator(PUCK + [(30, LIDAR, "lidar", [4, 1, 3.14, 0.1, 3.5, 0.2]),
                                      (31, RANGE_FINDER, "range-finder", [2, 2, 1, 0.01, 1, 0])],
                              lambda step: record("NUMBERS", 30, [0.5, inf, 1, 2]) + record("NUMBERS", 31, [0.25, 1, 2, 4]))
        self.assertEqual(self.lines("""
from controller import Robot
robot = Robot()
lidar, finder = robot.getDevice("lidar"), robot.getRangeFinder("range-finder")
lidar.enable(32)
finder.enable(32)
print(lidar.getPointCloud.__name__, lidar.getRangeImage())
lidar.enablePointCloud()
robot.step(32)
print(lidar.getRangeImage(), lidar.getHorizontalResolution(), lidar.getMaxRange())
print(len(lidar.getPointCloud()), lidar.getPointCloud()[1].x, "%.3f" % lidar.getPointCloud()[3].x)
print(finder.getRangeImageArray(), finder.rangeImageGetDepth(finder.getRangeImage(), 2, 0, 1))
""", simulator), ["getPointCloud [inf, inf, inf, inf]", "[0.5, inf, 1.0, 2.0] 4 3.5", "4 inf 0.766",
                 "[[0.25, 2.0], [1.0, 4.0]] 2.0"])

    def test_a_device_that_is_not_there_is_none(self):
        run = self.run_program("""
from controller import Robot
robot = Robot()
print(robot.getDevice("lidar"), robot.getLidar("lidar"))
""")
        self.assertEqual(run.out, "None None\n")
        self.assertIn("lidar", run.err)
        self.assertEqual(run.of("FIND_DEVICE")[0], (b"lidar",))

    def test_a_device_that_was_not_told_is_asked_for(self):
        simulator = Simulator(PUCK, lambda step: record("NUMBERS", 30, [0.4]),
                              {"FIND_DEVICE": lambda name: record("DEVICE", 30, DISTANCE_SENSOR, name, "", [0, 1, 0, 0])})
        self.assertEqual(self.lines("""
from controller import Robot
robot = Robot()
ball = robot.getDistanceSensor("ball_distance")
ball.enable(32)
robot.step(32)
print(ball.getValue(), ball.getMaxValue(), ball.getType())
""", simulator), ["0.4 1.0 0"])

    def test_a_device_made_by_its_class_is_enabled(self):
        run = self.run_program("""
from controller import Robot, DistanceSensor, Camera, LED
robot = Robot()
sensor = DistanceSensor("ps1")
Camera("camera", 64)
LED("led0").value = True
robot.step(32)
""")
        self.assertEqual(run.of("ENABLE"), [(2, 32), (8, 64)])
        self.assertEqual(run.of("LED"), [(7, 1)])

    def test_a_program_makes_devices_of_its_own_class(self):
        self.assertEqual(self.lines("""
from controller import Robot, DistanceSensor
class Loud(DistanceSensor):
    def getValue(self):
        return "loud"
class Mine(Robot):
    def createDistanceSensor(self, name):
        return Loud(name)
robot = Mine()
print(robot.getDistanceSensor("ps0").getValue(), type(robot.getLED("led0")).__name__)
"""), ["loud LED"])

    def test_motors_get_what_was_set(self):
        run = self.run_program("""
from controller import Robot
robot = Robot()
left, right = robot.getDevice("left wheel motor"), robot.getDevice("right wheel motor")
left.setPosition(float("inf"))
left.setVelocity(3)
right.target_position = 1.5
print(left.getVelocity(), left.target_velocity, right.getTargetPosition(), left.getMaxVelocity(), left.getType() == left.ROTATIONAL)
robot.step(32)
try:
    left.setVelocity("fast")
except Exception as error:
    print(type(error).__name__)
""")
        self.assertEqual(run.out.splitlines(), ["3.0 3.0 1.5 6.28 True", "ArgumentError"])
        self.assertEqual(run.of("POSITION"), [(3, float("inf")), (4, 1.5)])
        self.assertIn((3, 3.0), run.of("VELOCITY"))

    def test_sensors_of_several_numbers(self):
        def samples(step):
            return (record("NUMBERS", 11, [1, 2, 3, 3, 4, 0]) + record("NUMBERS", 12, [0, 1, 0]) +
                    record("NUMBERS", 13, [0, 0, 0.5]) + record("NUMBERS", 14, [0, 0, 9.81]) + record("NUMBERS", 15, [0, 0, 1]) +
                    record("NUMBERS", 16, [4000]) + record("NUMBERS", 17, [1]) + record("NUMBERS", 22, [12.5]) +
                    record("SOUND", 20, struct.pack("<3h", 1, -2, 3)))
        lines = self.lines("""
from controller import Robot
robot = Robot()
names = ["gps", "compass", "inertial unit", "accelerometer", "gyro", "ls0", "bumper", "mic0"]
gps, compass, unit, accelerometer, gyro, light, bumper, mic = devices = [robot.getDevice(name) for name in names]
for device in devices:
    device.enable(32)
robot.batterySensorEnable(32)
print(gps.getValues(), gps.value)
robot.step(32)
print(gps.getValues(), gps.getSpeed(), gps.getSpeedVector(), compass.getValues(), accelerometer.getValues(), gyro.value)
print(unit.getRollPitchYaw(), [round(q, 4) for q in unit.getQuaternion()], light.getValue(), bumper.getValue())
print(robot.batterySensorGetValue(), list(memoryview(mic.getSampleData()).cast("h")))
print(gps.convertToDegreesMinutesSeconds(-46.51861))
""", Simulator(PUCK, samples))
        self.assertEqual(lines, ["[nan, nan, nan] [nan, nan, nan]",
                                 "[1.0, 2.0, 3.0] 5.0 [3.0, 4.0, 0.0] [0.0, 1.0, 0.0] [0.0, 0.0, 9.81] [0.0, 0.0, 1.0]",
                                 "[0.0, 0.0, 0.5] [0.0, 0.0, 0.2474, 0.9689] 4000.0 1.0", "12.5 [1, -2, 3]", "-46° 31′ 6″"])

    def test_keys(self):
        run = self.run_program("""
from controller import Robot, Keyboard
keyboard = Keyboard()
robot = Robot()
assert robot.getKeyboard().getSamplingPeriod() == 0
robot.getKeyboard().enable(32)
robot.step(32)
print(keyboard.getKey() == Keyboard.UP, robot.keyboard.getKey() == ord("W"), keyboard.getKey())
robot.step(32)
print(keyboard.get_key(), keyboard.get_key(), repr(keyboard.get_key()))
print(robot.getMouse().getState().left, robot.getJoystick().isConnected())
""", Simulator(PUCK, lambda step: record("KEYS", [315, ord("W")] if step == 1 else [0x10000 | 366, ord("A")])))
        self.assertEqual(run.out.splitlines(), ["True True -1", "shift-page up A ''", "False False"])

    def test_differential_wheels(self):
        run = self.run_program("""
from controller import DifferentialWheels
robot = DifferentialWheels()
robot.enableEncoders(32)
robot.setSpeed(500, -250)
robot.step(32)
print(robot.getLeftSpeed(), robot.getRightSpeed(), robot.getSpeedUnit(), round(robot.getLeftEncoder()), robot.getMaxSpeed())
""", Simulator(PUCK, lambda step: record("NUMBERS", 5, [6.283185307]) + record("NUMBERS", 6, [0])))
        self.assertEqual(run.out, "500.0 -250.0 0.00628 1000 6.28\n")
        self.assertEqual([round(v, 4) for tag, v in run.of("VELOCITY")][-2:], [3.14, -1.57])


class Pictures(Programs):
    PIXELS = bytes(range(24))  # 3 columns, 2 rows of blue, green, red, alpha

    def samples(self, step):
        return record("PICTURE", 8, 3, 2, 0, bytes(v ^ (step - 1) for v in self.PIXELS))

    def test_a_picture_is_bytes_kept_until_the_next(self):
        run = self.run_program("""
from controller import Robot
robot = Robot()
camera = robot.getDevice("camera")
print(camera.getImage())
camera.enable(32)
robot.step(32)
image = camera.getImage()
print(list(image[:8]), len(image), image is camera.getImage(), camera.width, camera.getHeight(), round(camera.getFov(), 2))
print(camera.imageGetRed(image, 3, 1, 1), camera.imageGetGreen(image, 3, 1, 1), camera.imageGetBlue(image, 3, 1, 1), camera.imageGetGray(image, 3, 1, 1))
print(camera.getImageArray()[2][1], len(camera.getImageArray()), len(camera.getImageArray()[0]))
robot.step(32)
print(camera.getImage()[0], image[0])
""", Simulator(PUCK, self.samples))
        self.assertEqual(run.out.splitlines(), ["None", "[0, 1, 2, 3, 4, 5, 6, 7] 24 True 3 2 0.84", "18 17 16 17.0", "[22, 21, 20] 3 2", "1 0"])
        self.assertIn("not enabled", run.err)

    def test_an_array_of_it_is_no_copy(self):
        lines = self.lines("""
import ctypes
from controller import Robot
robot = Robot()
camera = robot.getDevice("camera")
camera.enable(32)
print(camera.__array_interface__["shape"][1:])
robot.step(32)
of = camera.__array_interface__
print(of["shape"], of["typestr"], list(ctypes.string_at(of["data"][0], 4)), of["data"][1])
robot.step(32)
print(list(ctypes.string_at(of["data"][0], 4)))
""", Simulator(PUCK, self.samples))
        self.assertEqual(lines, ["(3, 4)", "(2, 3, 4) |u1 [0, 1, 2, 3] True", "[1, 0, 3, 2]"])

    def test_numpy_takes_it(self):
        interpreter = next((p for p in (sys.executable, "/usr/bin/python3")
                            if subprocess.run([p, "-c", "import numpy"], capture_output=True).returncode == 0), None)
        if not interpreter:
            self.skipTest("no NumPy here; apt install python3-numpy")
        lines = self.lines("""
import numpy
from controller import Robot
robot = Robot()
camera = robot.getDevice("camera")
camera.enable(32)
robot.step(32)
view, copy = numpy.asarray(camera), numpy.frombuffer(camera.getImage(), numpy.uint8).reshape(2, 3, 4)
print(view.shape, view.flags.writeable, view[1, 2].tolist(), (view == copy).all())
robot.step(32)
print(view[0, 0].tolist(), copy[0, 0].tolist())
robot.getDevice("left wheel motor").setVelocity(numpy.float32(1.5))
robot.getDevice("led0").set(numpy.int64(1))
robot.step(numpy.int64(32))
""", Simulator(PUCK, self.samples), interpreter=interpreter)
        self.assertEqual(lines, ["(2, 3, 4) False [20, 21, 22, 23] True", "[1, 0, 3, 2] [0, 1, 2, 3]"])

    def test_recognised_objects(self):
        def samples(step):
            return record("RECOGNITION", 8, 2 - step) + (record(
                "RECOGNISED", 8, 77, "red ball", [0.3, 0.1, 0, 0, 0, 1, 0.5, 0.06, 0.05, 26, 19, 10, 8],
                [1, 0, 0, 0.5, 0.5, 0.5]) if step == 1 else b"")
        run = self.run_program("""
from controller import Robot, CameraRecognitionObject
CameraRecognitionObject()
robot = Robot()
camera = robot.getDevice("camera")
print(camera.hasRecognition(), camera.getRecognitionObjects())
camera.recognitionEnable(32)
robot.step(32)
ball, = camera.getRecognitionObjects()
robot.step(32)
print(ball.getId(), ball.getPosition(), ball.getOrientation(), ball.getSize(), ball.getPositionOnImage(), ball.getSizeOnImage())
print(ball.getColors(), ball.getNumberOfColors(), ball.getModel(), ball.position_on_image[0])
print(ball.get_id(), ball.get_model(), ball.get_position_on_image(), ball.get_colors()[:3] == [1, 0, 0])
print(camera.getRecognitionNumberOfObjects(), camera.getRecognitionObjects())
""", Simulator(PUCK, samples))
        self.assertEqual(run.out.splitlines(), [
            "True []", "77 [0.3, 0.1, 0.0] [0.0, 0.0, 1.0, 0.5] [0.06, 0.05] [26, 19] [10, 8]",
            "[1.0, 0.0, 0.0, 0.5, 0.5, 0.5] 2 red ball 26", "77 b'red ball' [26, 19] True", "0 []"])
        self.assertEqual(run.of("RECOGNISE"), [(8, 32)])

    def test_a_display_is_drawn_and_saved(self):
        run = self.run_program("""
import os
from controller import Robot, Display
robot = Robot()
display = robot.getDevice("display")
display.setColor(0xff0000)
display.fillRectangle(0, 0, 2, 3)
display.color = 0x0000ff
display.drawPolygon([2, 3, 3], [0, 0, 2])
image = display.imageNew(bytes([0, 255, 0, 255] * 4), Display.BGRA, 2, 2)
display.imagePaste(image, 1, 1, False)
display.imageDelete(image)
display.imageSave(None, "drawn.png")
print(display.getWidth(), display.height, open("drawn.png", "rb").read(4))
copy = display.imageCopy(0, 0, 2, 2)
display.imagePaste(copy, 2, 1)
try:
    display.imageNew(b"short", Display.BGRA, 2, 2)
except ValueError as error:
    print(error)
""")
        self.assertEqual(run.out.splitlines(), ["4 3 b'\\x89PNG'", "Display.imageNew: got 5 bytes, expected 16"])


class Radio(Programs):
    def test_packets_are_read_as_they_were_sent(self):
        def samples(step):
            packets = [b"hello\0", "grüße".encode(), struct.pack("<2d", 0.5, -1), struct.pack("<3i", 1, -2, 3), b"\x01\x00"]
            return b"".join(record("PACKET", 9, 1, p, 4.0, 0.6, 0.8, 0) for p in packets) if step == 1 else b""
        run = self.run_program("""
from controller import Robot
robot = Robot()
receiver = robot.getDevice("receiver")
receiver.enable(32)
print(receiver.getQueueLength(), receiver.getData(), receiver.getChannel())
robot.step(32)
print(receiver.getQueueLength(), receiver.getData(), receiver.getString(), receiver.getDataSize())
print(receiver.getSignalStrength(), receiver.getEmitterDirection())
receiver.nextPacket()
print(receiver.getString(), receiver.getBytes() == receiver.getData() == receiver.data)
data = receiver.getData()
print(data == "grüße", data != "grüße", "üß" in data, data.startswith("gr"), data.split("ü"), data.split(b"r"), data[0])
receiver.nextPacket()
print(receiver.getFloats())
receiver.nextPacket()
print(receiver.getInts())
receiver.nextPacket()
print(receiver.getBools())
receiver.nextPacket()
print(receiver.queue_length)
receiver.setChannel(-1)
""", Simulator(PUCK, samples))
        self.assertEqual(run.out.splitlines(), [
            "0 b'' 1", "5 b'hello\\x00' hello 6", "4.0 [0.6, 0.8, 0.0]", "grüße True",
            "True False True True ['gr', 'ße'] [b'g', b'\\xc3\\xbc\\xc3\\x9fe'] 103", "(0.5, -1.0)", "(1, -2, 3)",
            "(True, False)", "0"])
        self.assertEqual(run.of("CHANNEL"), [(9, -1)])

    def test_what_an_emitter_sends(self):
        run = self.run_program("""
from controller import Robot, Emitter
robot = Robot()
emitter = robot.getDevice("emitter")
for message in ("grüße", b"ab\\0c", bytearray(b"x"), [1, 2], [0.5, 1], (True, False)):
    emitter.send(message)
emitter.send(b"abcdef", 3)
emitter.channel = Emitter.CHANNEL_BROADCAST
emitter.setRange(0.5)
for wrong in ({}, [], ["a"], None):
    try:
        emitter.send(wrong)
        print("sent", wrong)
    except TypeError as error:
        said = error
print(said)
robot.step(32)
""")
        self.assertEqual(run.out, "Emitter.send: got None, expected text, bytes or a list of numbers\n")
        self.assertEqual([data for tag, data in run.of("SEND")], [
            "grüße".encode(), b"ab\0c", b"x", struct.pack("<2i", 1, 2), struct.pack("<2d", 0.5, 1), b"\x01\x00", b"abc"])
        self.assertEqual((run.of("CHANNEL"), run.of("RANGE")), ([(10, -1)], [(10, 0.5)]))


class Ends(Programs):
    def test_the_last_step_is_minus_one(self):
        run = self.run_program("""
from controller import Robot
robot = Robot()
steps = 0
while robot.step(32) != -1:
    steps += 1
print(steps)
robot.cleanup()
""", Simulator(PUCK, steps=5))
        self.assertEqual((run.out, run.err), ("5\n", ""))

    def test_a_program_that_goes_on_is_ended_with_all_its_words(self):
        run = self.run_program("""
from controller import Robot
import atexit
atexit.register(print, "and its last")
robot = Robot()
while True:
    robot.step(32)
    print(robot.getTime(), end=" ")
""", Simulator(PUCK, steps=2))
        self.assertEqual(run.out, "0.032 0.064 0.064 and its last\n")

    def test_an_exception_has_its_traceback(self):
        run = self.run_program("""
from controller import Robot
robot = Robot()
led = robot.getDevice("led0")
led.set(1)
print("before", end="")
robot.getDevice("nothing").enable(32)
""", status=1)
        self.assertEqual(run.out, "before")
        self.assertIn("line 7", run.err)
        self.assertIn("AttributeError: 'NoneType'", run.err)
        self.assertEqual(run.of("LED"), [(7, 1)])  # what it had said was said

    def test_lines_are_there_when_they_are_printed(self):
        seen = []
        simulator = Simulator(PUCK)
        simulator.samples = lambda step: seen.append(simulator.printed()) or b""
        self.run_program("""
from controller import Robot
robot = Robot()
for i in range(3):
    print("line", i)
    robot.step(32)
""", simulator)
        self.assertEqual(seen, ["line 0\n", "line 0\nline 1\n", "line 0\nline 1\nline 2\n"])

    def test_threads_of_the_program_may_call_while_it_steps(self):
        run = self.run_program("""
import threading
from controller import Robot
robot = Robot()
sensor, led = robot.getDevice("ps0"), robot.getDevice("led0")
sensor.enable(32)
done, calls = False, 0
def work():
    global calls
    while not done:
        sensor.getValue(), led.set(calls % 2), robot.getTime()
        calls += 1
threads = [threading.Thread(target=work) for _ in range(3)]
for thread in threads:
    thread.start()
steps = 0
while robot.step(32) != -1:
    steps += 1
done = True
for thread in threads:
    thread.join()
print(steps, calls > 20)
""", Simulator(PUCK, lambda step: record("NUMBERS", 1, [step]), steps=20))
        self.assertEqual((run.out, run.err), ("20 True\n", ""))

    def test_half_a_step(self):
        self.assertEqual(self.lines("""
from controller import Robot
robot = Robot()
sensor = robot.getDevice("ps0")
sensor.enable(32)
print(robot.stepBegin(32), robot.stepEnd(), sensor.getValue(), robot.stepBegin(), robot.stepEnd())
""", Simulator(PUCK, lambda step: record("NUMBERS", 1, [step]), steps=1)), ["0 0 1.0 0 -1"])


if __name__ == "__main__":
    unittest.main()
