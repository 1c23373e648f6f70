# SPDX-License-Identifier: MIT
"""Drives with the weights that evolve.py sends, and answers how well that went; alone it drives with the best ones."""
import os
from multiprocessing.connection import Client

import numpy
from controller import Supervisor

TIME_STEP = 64   # ms
TRIAL = 20.0     # s
MOST = 6.28      # rad/s of a wheel
NEAR = 1000.0    # counts of a sensor close to a wall

robot = Supervisor()
wheels = [robot.getDevice(side + " wheel motor") for side in ("left", "right")]
sensors = [robot.getDevice("ps%d" % i) for i in range(8)]


def begin():
    """The devices, as a world that begins has them not."""
    for sensor in sensors:
        sensor.enable(TIME_STEP)
    for wheel in wheels:
        wheel.setPosition(float("inf"))
        wheel.setVelocity(0)


def fitness(speeds, near):
    """0 to 1 of a step: fast, straight, far from walls."""
    forward, turn = speeds.mean() / MOST, abs(speeds[0] - speeds[1]) / (2 * MOST)
    return max(forward, 0) * (1 - numpy.sqrt(turn)) * (1 - near.max())


def drive(weights, seconds):
    """The mean fitness of so long a drive."""
    total, steps = 0.0, 0
    until = robot.getTime() + seconds
    while robot.getTime() < until and robot.step(TIME_STEP) != -1:
        near = numpy.nan_to_num([sensor.getValue() for sensor in sensors]).clip(0, NEAR) / NEAR
        speeds = MOST * numpy.tanh(weights @ numpy.append(near, 1))  # two wheels, eight sensors and a bias
        for wheel, speed in zip(wheels, speeds):
            wheel.setVelocity(speed)
        total, steps = total + fitness(speeds, near), steps + 1
    return total / max(steps, 1)


begin()
if "EVOLVE" in os.environ:
    line = Client(os.environ["EVOLVE"], authkey=None)
    while True:
        try:
            weights = line.recv()
        except EOFError:
            break
        robot.simulationReset()
        robot.step(TIME_STEP)
        begin()
        line.send(drive(weights.reshape(2, 9), TRIAL))
    robot.simulationQuit(0)
    robot.step(TIME_STEP)
else:
    best = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "best.npy")
    weights = numpy.load(best) if os.path.exists(best) else numpy.zeros((2, 9))
    print("fitness %.3f" % drive(weights.reshape(2, 9), float("inf")))
