# SPDX-License-Identifier: MIT
"""@NAME@: ends the run once every robot has driven half a metre, or as failed when one has touched something. A start
for your own supervisor; docs/connecting.md is the guide."""
import sys

from controller import Supervisor

world = Supervisor()
children = world.getRoot().getField("children")
nodes = [children.getMFNode(i) for i in range(children.getCount())]
robots = [node for node in nodes if node.getTypeName() == "E-puck"]

while world.step(100) != -1:
    for robot in robots:
        if robot.getField("collisions").getSFInt32() > 0:
            print(robot.getField("name").getSFString(), "touched something")
            world.simulationQuit(1)
            sys.exit()
    if all(robot.getField("distance").getSFFloat() > 0.5 for robot in robots):
        print(f"all there after {world.getTime():.1f} s")
        world.simulationQuit(0)
        sys.exit()
