# SPDX-License-Identifier: MIT
"""java_test.py BUILD: programs in Java with the build's Controller.jar, against a simulator that the test plays."""
import os
import struct
import subprocess
import sys
import tempfile
import unittest

from controller_supervisor_test import World
from controller_test import PUCK
from fake_simulator import Simulator, record

BUILD = os.path.abspath(sys.argv.pop(1))
SMALL = ["-Xmx64m", "-XX:+UseSerialGC", "-XX:TieredStopAtLevel=1", "-XX:ReservedCodeCacheSize=32m"]


class Programs(unittest.TestCase):
    def run_program(self, body, simulator, status=0, extends="Robot", outside=""):
        """`body` is what main() does with `robot`."""
        text = """import com.cyberbotics.webots.controller.*;
import java.util.Arrays;
public class Program extends %s {
%s
  static void say(Object... words) {
    StringBuilder line = new StringBuilder();
    for (Object word : words)
      line.append(line.length() > 0 ? " " : "").append(word instanceof double[] ? Arrays.toString((double[]) word)
        : word instanceof int[] ? Arrays.toString((int[]) word) : String.valueOf(word));
    System.out.println(line);
  }
  public static void main(String[] arguments) throws Exception {
    Program robot = new Program();
    %s
  }
}
""" % (extends, outside, body)
        with tempfile.TemporaryDirectory() as folder:
            with open(folder + "/Program.java", "w", encoding="utf-8") as file:
                file.write(text)
            classes = BUILD + "/Controller.jar"
            made = subprocess.run(["javac", *("-J" + s for s in SMALL), "-encoding", "UTF-8", "-cp", classes, "Program.java"],
                                  cwd=folder, capture_output=True, text=True)
            self.assertEqual(made.returncode, 0, made.stderr)
            run = simulator.run(["java", *SMALL, "-Dfile.encoding=UTF-8", "-cp", ".:" + classes, "-Djava.library.path=" + BUILD, "Program"], folder)
        self.assertEqual(run.status, status, run.out + run.err)
        return run

    def test_a_robot(self):
        def samples(step):
            return (record("NUMBERS", 1, [step * 10]) + record("NUMBERS", 11, [1, 2, 3, 3, 4, 0]) + record("NUMBERS", 13, [0, 0, 0.5]) +
                    record("NUMBERS", 16, [4000]) + record("KEYS", [315]) +
                    record("PICTURE", 8, 3, 2, 0, bytes(range(24))))
        run = self.run_program("""
    DistanceSensor sensor = robot.getDistanceSensor("ps0");
    say(sensor.getValue(), robot.getMotor("left wheel motor") == robot.getDevice("left wheel motor"), robot.getName(), robot.getBasicTimeStep());
    Motor left = robot.getMotor("left wheel motor");
    GPS gps = robot.getGPS("gps");
    Camera camera = robot.getCamera("camera");
    InertialUnit unit = robot.getInertialUnit("inertial unit");
    LightSensor light = robot.getLightSensor("ls0");
    say(gps.getValues(), camera.getImage(), left.getPositionSensor().getMotor() == left, robot.getLidar("lidar"));
    sensor.enable(32); gps.enable(32); camera.enable(32); unit.enable(32); light.enable(32); robot.getKeyboard().enable(32);
    left.setPosition(Double.POSITIVE_INFINITY);
    left.setVelocity(2.5);
    robot.getLED("led0").set(1);
    int steps = 0;
    while (robot.step(32) != -1) {
      if (steps++ > 0) continue;
      int[] image = camera.getImage();
      say(sensor.getValue(), gps.getValues(), gps.getSpeed(), unit.getRollPitchYaw(), light.getValue(), robot.getTime());
      say(image.length, Camera.imageGetRed(image, 3, 1, 1), Camera.pixelGetBlue(image[0]), Camera.imageGetGray(image, 3, 1, 1), camera.getWidth(), camera.getHeight());
      say(robot.getKeyboard().getKey() == Keyboard.UP, robot.getKeyboard().getKey());
    }
    say(steps, sensor.getValue());
    robot.step(32);
    say("never");
""", Simulator(PUCK, samples))
        self.assertEqual(run.out.splitlines(), [
            "NaN true puck 32.0", "[NaN, NaN, NaN] null true null",
            "10.0 [1.0, 2.0, 3.0] 5.0 [0.0, 0.0, 0.5] 4000.0 0.032", "6 18 0 17 3 2", "true -1", "3 30.0"])
        self.assertEqual(run.of("HELLO"), [(2, 3, b"Program")])
        self.assertEqual((run.of("POSITION"), run.of("LED")), ([(3, float("inf"))], [(7, 1)]))
        self.assertIn((3, 2.5), run.of("VELOCITY"))
        self.assertIn("lidar", run.err)

    def test_radio_and_recognition(self):
        def samples(step):
            return (record("PACKET", 9, 1, "grüße\0", 4.0, 0.6, 0.8, 0) + record("PACKET", 9, 1, struct.pack("<2i", 1, -2), 1, 1, 0, 0) +
                    record("RECOGNITION", 8, 1) + record("RECOGNISED", 8, 77, "red ball", [
                        0.3, 0.1, 0, 0, 0, 1, 0.5, 0.06, 0.05, 26, 19, 10, 8], [1, 0, 0.5]) if step == 1 else b"")
        run = self.run_program("""
    Receiver receiver = robot.getReceiver("receiver");
    Emitter emitter = robot.getEmitter("emitter");
    Camera camera = robot.getCamera("camera");
    receiver.enable(32);
    camera.recognitionEnable(32);
    say(receiver.getQueueLength(), receiver.getData().length, camera.getRecognitionObjects().length);
    emitter.send("grüße");
    emitter.send(new byte[] {1, 0, -1});
    robot.step(32);
    say(receiver.getQueueLength(), receiver.getString(), receiver.getDataSize(), receiver.getEmitterDirection(), receiver.getSignalStrength());
    receiver.nextPacket();
    say(java.nio.ByteBuffer.wrap(receiver.getData()).order(java.nio.ByteOrder.LITTLE_ENDIAN).getInt(4));
    CameraRecognitionObject ball = camera.getRecognitionObjects()[0];
    say(ball.getId(), ball.getModel(), ball.getPosition(), ball.getPositionOnImage(), ball.getSizeOnImage(), ball.getColors());
""", Simulator(PUCK, samples))
        self.assertEqual(run.out.splitlines(), [
            "0 0 0", "2 grüße 8 [0.6, 0.8, 0.0] 4.0", "-2",
            "77 red ball [0.3, 0.1, 0.0] [26, 19] [10, 8] [1.0, 0.0, 0.5]"])
        self.assertEqual([data for _, data in run.of("SEND")], ["grüße".encode(), b"\x01\x00\xff"])

    def test_a_supervisor(self):
        world = World()
        run = self.run_program("""
    Node ball = robot.getFromDef("BALL"), puck = robot.getSelf();
    say(ball, ball.getId(), ball.getType() == Node.SOLID, robot.getFromDef("NOBODY"), ball.getParentNode().equals(robot.getRoot()));
    say(puck.getField("translation").getSFVec3f(), puck.getField("name").getSFString(), ball.getField("weights").getMFFloat(1));
    say(ball.getPosition(), ball.getVelocity(), ball.getContactPoints()[1].getPoint(), ball.getField("child").getSFNode().equals(puck));
    puck.getField("translation").setSFVec3f(new double[] {1, 2, 3});
    puck.getField("name").setSFString("grüße");
    ball.getField("words").insertMFString(-1, "c");
    robot.getRoot().getField("children").importMFNodeFromString(-1, "DEF NEW Solid { }");
    say(robot.getRoot().getField("children").getCount(), robot.getFromDef("NEW").getTypeName());
    try {
      puck.getField("rotation").setSFRotation(new double[] {1, 2});
    } catch (IllegalArgumentException error) {
      say(error.getMessage());
    }
    ball.resetPhysics();
    robot.step(32);
    robot.simulationQuit(1);
""", world, extends="Supervisor")
        self.assertEqual(run.out.splitlines(), [
            "Solid BALL 3 true null true", "[0.5, -0.25, 0.0] puck 2.0",
            "[1.0, 2.0, 3.0] [0.1, 0.0, 0.0, 0.0, 0.0, 2.0] [0.0, 0.0, 1.0] true", "3 Solid",
            "Field.setSFRotation: got 2 numbers, expected 4"])
        self.assertEqual([f[2] for f in world.nodes[2][5]][:3], [[1, 2, 3], [0, 0, 1, 1.5], "grüße"])
        self.assertEqual(world.nodes[3][5][7][2], ["a", "b", "c"])
        self.assertEqual(run.of("DO_NODE"), [(3, 1, [], b"")])
        self.assertEqual(run.of("DO_WORLD"), [(0, [1], b"")])

    def test_an_exception_has_its_trace(self):
        run = self.run_program("robot.getDistanceSensor(\"nothing\").getValue();", Simulator(PUCK), status=1)
        self.assertIn("NullPointerException", run.err)
        self.assertIn("Program.java", run.err)

    def test_differential_wheels(self):
        run = self.run_program("""
    robot.enableEncoders(32);
    robot.setSpeed(500, -250);
    robot.step(32);
    say(robot.getLeftSpeed(), Math.round(robot.getLeftEncoder()));
""", Simulator(PUCK, lambda step: record("NUMBERS", 5, [6.283185307]) + record("NUMBERS", 6, [0])), extends="DifferentialWheels")
        self.assertEqual(run.out, "500.0 1000\n")


if __name__ == "__main__":
    unittest.main()
