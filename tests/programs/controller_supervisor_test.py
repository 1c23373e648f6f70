# SPDX-License-Identifier: MIT
"""Supervisors in Python, against a simulator that the test plays with a small world."""
import unittest

from controller_test import PUCK, Programs
from fake_simulator import Simulator, record

BOOL, INT32, FLOAT, VEC2F, VEC3F, ROTATION, COLOR, STRING, NODE, MF = 1, 2, 3, 4, 5, 6, 7, 8, 9, 16
GROUP, ROBOT, SOLID = 14, 34, 80


class World(Simulator):
    """Nodes: number -> parent, kind, DEF, type, base type, fields; a field: name, type, value. Commands change it."""

    def __init__(self, **more):
        self.nodes = {1: [0, GROUP, "", "Group", "Group", [["children", MF | NODE, [2, 3]]]],
                      2: [1, ROBOT, "PUCK", "E-puck", "Robot", [
                          ["translation", VEC3F, [0.5, -0.25, 0]], ["rotation", ROTATION, [0, 0, 1, 1.5]],
                          ["name", STRING, "puck"], ["supervisor", BOOL, [1]]]],
                      3: [1, SOLID, "BALL", "Solid", "Solid", [
                          ["translation", VEC3F, [0, 0, 0.02]], ["radius", FLOAT, [0.02]], ["number", INT32, [7]],
                          ["size", VEC2F, [1, 2]], ["baseColor", COLOR, [1, 0.5, 0]], ["child", NODE, 2],
                          ["colors", MF | COLOR, [[1, 0, 0], [0, 1, 0]]], ["words", MF | STRING, ["a", "b"]],
                          ["weights", MF | FLOAT, [[1], [2], [3]]]]]}
        self.fields = [None] + [(n, f) for n in self.nodes for f in self.nodes[n][5]]
        answers = {"FIND_NODE": self.find_node, "FIND_FIELD": self.find_field, "GET": self.get, "SET": self.set,
                   "INSERT": self.insert, "REMOVE": self.remove, "IMPORT": self.imported, "ASK_NODE": self.ask}
        super().__init__(PUCK, answers=answers, **{"supervisor": True, **more})

    def node(self, number):
        parent, kind, DEF, type_, base, _ = self.nodes[number]
        return record("NODE", number, parent, kind, DEF, type_, base)

    def find_node(self, by, number, DEF):
        found = {0: 1, 1: 2, 2: next((n for n in self.nodes if self.nodes[n][2] == DEF.decode()), 0), 3: number,
                 4: 2, 5: 0}[by]
        return self.node(found) if found in self.nodes else record("NOTHING", "no such node")

    def find_field(self, node, index, name):
        fields = self.nodes[node][5]
        for i, field in enumerate(fields):
            if i == index or index < 0 and field[0] == name.decode():
                number = next(n for n, f in enumerate(self.fields) if f and f[1] is field)
                return record("FIELD", number, field[1], len(field[2]) if field[1] & MF else -1, field[0])
        return record("NOTHING", "there is no field " + name.decode())

    def get(self, number, index):
        _, kind, value = self.fields[number][1]
        count = len(value) if kind & MF else -1
        value = value[index] if kind & MF and value else value
        kind &= ~MF
        return record("VALUE", count, value if kind == NODE else 0, value if kind not in (NODE, STRING) else [],
                      value if kind == STRING else "")

    def value_of(self, kind, numbers, text):
        return text.decode() if kind & ~MF == STRING else numbers

    def set(self, number, index, node, numbers, text):
        field = self.fields[number][1]
        if field[1] & MF:
            field[2][index] = self.value_of(field[1], numbers, text)
        else:
            field[2] = self.value_of(field[1], numbers, text)
        return b""

    def insert(self, number, index, numbers, text):
        field = self.fields[number][1]
        field[2].insert(len(field[2]) + 1 + index if index < 0 else index, self.value_of(field[1], numbers, text))
        return b""

    def remove(self, number, index):
        del self.fields[number][1][2][index]
        return b""

    def imported(self, number, index, text):
        self.nodes[9] = [1, SOLID, "NEW", "Solid", "Solid", []]
        field = self.fields[number][1]
        field[2].insert(len(field[2]) + 1 + index if index < 0 else index, 9)
        return record("FIELD", number, field[1], len(field[2]), field[0])

    def ask(self, node, what):
        numbers = [[1, 2, 3], [0, -1, 0, 1, 0, 0, 0, 0, 1], [0.1, 0, 0, 0, 0, 2], [1, 2, 4], [0, 0, 0, 0, 0, 1],
                   [1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1], [1], [len(self.nodes[node][5])]][what]
        return record("VALUE", -1, 0, numbers, "")


class Supervisors(Programs):
    def test_nodes_say_what_they_are(self):
        self.assertEqual(self.lines("""
from controller import Supervisor, Node
supervisor = Supervisor()
ball, root = supervisor.getFromDef("BALL"), supervisor.getRoot()
print(supervisor.getSupervisor(), ball.getId(), ball.id, ball.getDef(), ball.getTypeName(), ball.getBaseTypeName(), ball.type == Node.SOLID)
print(supervisor.getFromDef("NOBODY"), supervisor.getFromId(99), supervisor.getFromId(3) == ball, supervisor.getSelf().getDef())
print(ball.getParentNode() == root, root.getParentNode(), ball.getNumberOfFields(), root.getField("children").getCount())
print(supervisor.getFromDevice(supervisor.getDevice("camera")).DEF, supervisor.getSelected(), {ball: 1}[supervisor.getFromDef("BALL")])
print(ball.getPosition(), ball.getOrientation()[:3], ball.getVelocity(), ball.getCenterOfMass(), ball.getStaticBalance())
print(ball.getPose()[3::4], [p.getPoint() for p in ball.getContactPoints()])
""", World()), ["True 3 3 BALL Solid Solid True", "None None True PUCK", "True None 9 2", "PUCK None 1",
                "[1.0, 2.0, 3.0] [0.0, -1.0, 0.0] [0.1, 0.0, 0.0, 0.0, 0.0, 2.0] [1.0, 2.0, 4.0] True",
                "[5.0, 6.0, 7.0, 1.0] [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]"])

    def test_fields_are_read(self):
        self.assertEqual(self.lines("""
from controller import Supervisor, Field
supervisor = Supervisor()
puck, ball = supervisor.getFromDef("PUCK"), supervisor.getFromDef("BALL")
place = puck.getField("translation")
print(place.getName(), place.getTypeName(), place.type == Field.SF_VEC3F, place.getCount(), place.getSFVec3f(), place.value)
print(puck.getField("rotation").getSFRotation(), puck.getField("name").getSFString(), puck.getField("supervisor").getSFBool())
print(ball.getField("radius").getSFFloat(), ball.getField("number").getSFInt32(), ball.getField("size").getSFVec2f(), ball.getField("baseColor").getSFColor())
print(ball.getField("child").getSFNode() == puck, supervisor.getRoot().getField("children").getMFNode(1) == ball)
print(ball.getField("colors").getMFColor(1), ball.getField("words").getMFString(0), ball.getField("weights").getMFFloat(-1))
print(ball.getField("weights").value, ball.getField("words").value, ball.getFieldByIndex(1).name, supervisor.getRoot().getField("children").value)
""", World()), ["translation SFVec3f True -1 [0.5, -0.25, 0.0] [0.5, -0.25, 0.0]", "[0.0, 0.0, 1.0, 1.5] puck True",
                "0.02 7 [1.0, 2.0] [1.0, 0.5, 0.0]", "True True", "[0.0, 1.0, 0.0] a 3.0",
                "[1.0, 2.0, 3.0] ['a', 'b'] radius [<Node E-puck PUCK>, <Node Solid BALL>]"])

    def test_a_field_that_is_not_there_is_none(self):
        run = self.run_program("""
from controller import Supervisor
print(Supervisor().getFromDef("BALL").getField("colour"))
""", World())
        self.assertEqual(run.out, "None\n")
        self.assertIn("colour", run.err)

    def test_fields_are_set(self):
        world = World()
        self.assertEqual(self.lines("""
from controller import Supervisor
supervisor = Supervisor()
puck, ball = supervisor.getFromDef("PUCK"), supervisor.getFromDef("BALL")
puck.getField("translation").setSFVec3f([1, 2, 3])
puck.getField("rotation").value = (0, 0, 1, -1)
puck.getField("name").setSFString("grüße")
puck.getField("supervisor").setSFBool(False)
ball.getField("radius").setSFFloat(1)
ball.getField("number").value = 8
ball.getField("size").setSFVec2f((3.5, 4))
ball.getField("colors").setMFColor(0, [0, 0, 1])
ball.getField("words").insertMFString(-1, "c")
ball.getField("words").removeMF(0)
ball.getField("weights").value = [5, 6, 7, 8]
print(puck.getField("translation").getSFVec3f(), ball.getField("words").value, ball.getField("weights").getCount())
ball.getField("weights").value = [9]
supervisor.step(32)
""", world), ["[1.0, 2.0, 3.0] ['b', 'c'] 4"])
        puck, ball = world.nodes[2][5], world.nodes[3][5]
        self.assertEqual([f[2] for f in puck], [[1, 2, 3], [0, 0, 1, -1], "grüße", [0]])
        self.assertEqual([f[2] for f in ball][1:4], [[1], [8], [3.5, 4]])
        self.assertEqual([f[2] for f in ball][6:], [[[0, 0, 1], [0, 1, 0]], ["b", "c"], [[9]]])

    def test_a_value_of_another_type_is_told_with_its_line_and_the_program_goes_on(self):
        world = World()
        run = self.run_program("""
from controller import Supervisor
puck = Supervisor().getFromDef("PUCK")
puck.getField("translation").setSFVec3f([1, 2])
puck.getField("name").value = 5
puck.getField("rotation").setSFRotation("east")
print("on")
""", world)
        self.assertEqual(run.out, "on\n")
        self.assertEqual(run.err.splitlines(), [
            "program.py:4: Field translation: got [1, 2], expected 3 numbers; it stays as it was",
            "program.py:5: Field name: got 5, expected text; it stays as it was",
            "program.py:6: Field rotation: got 'east', expected 4 numbers; it stays as it was"])
        self.assertEqual(world.nodes[2][5][0][2], [0.5, -0.25, 0])

    def test_nodes_are_imported_and_removed(self):
        world = World()
        run = self.run_program("""
from controller import Supervisor
supervisor = Supervisor()
children = supervisor.getRoot().getField("children")
children.importMFNodeFromString(-1, 'DEF NEW Solid { name "new" }')
print(children.getCount(), children.getMFNode(2).getDef(), supervisor.getFromDef("NEW").getTypeName())
with open("ball.wbo", "w") as file:
    file.write("#VRML_OBJ R2023b utf8\\nSolid { }")
children.importMFNode(0, "ball.wbo")
supervisor.getFromDef("BALL").remove()
supervisor.step(32)
""", world)
        self.assertEqual(run.out, "3 NEW Solid\n")
        self.assertEqual([(index, text) for _, index, text in run.of("IMPORT")],
                         [(-1, b'DEF NEW Solid { name "new" }'), (0, b"#VRML_OBJ R2023b utf8\nSolid { }")])
        self.assertEqual(run.of("DO_NODE"), [(3, 3, [], b"")])

    def test_nodes_are_moved_and_restarted(self):
        run = self.run_program("""
from controller import Supervisor
supervisor = Supervisor()
puck = supervisor.getSelf()
puck.setVelocity([1, 0, 0, 0, 0, 2])
puck.resetPhysics()
puck.restartController()
puck.addForce([0, 1, 0], False)
puck.addTorque((0, 0, 2), False)
puck.saveState("here")
puck.loadState("here")
try:
    puck.setVelocity([1, 2, 3])
except ValueError as error:
    print(error)
supervisor.step(32)
""", World())
        self.assertEqual(run.out, "Node.setVelocity: got 3 numbers, expected 6 (m/s, rad/s)\n")
        did = run.of("DO_NODE")
        self.assertEqual([(node, what) for node, what, _, _ in did], [(2, 0), (2, 1), (2, 2), (2, 4), (2, 5), (2, 6), (2, 7)])
        self.assertEqual(did[0][2], [1, 0, 0, 0, 0, 2])
        self.assertEqual((did[3][2][:3], did[4][2][:3], did[5][3], did[6][3]), ([0, 1, 0], [0, 0, 2], b"here", b"here"))

    def test_the_run_is_commanded(self):
        run = self.run_program("""
from controller import Supervisor
supervisor = Supervisor()
supervisor.setLabel(1, "goal", 0.1, 0.2, 0.05, 0xff0000, 0.5)
supervisor.exportImage("here.png", 90)
supervisor.simulationResetPhysics()
supervisor.simulationReset()
supervisor.simulation_mode = Supervisor.SIMULATION_MODE_FAST
print(supervisor.simulationGetMode() == Supervisor.SIMULATION_MODE_FAST)
supervisor.step(32)
supervisor.simulationQuit(3)
supervisor.step(32)
""", World())
        self.assertEqual(run.out, "True\n")
        did = run.of("DO_WORLD")
        self.assertEqual([what for what, _, _ in did if what != 6], [4, 5, 3, 1, 0])
        self.assertEqual(did[0], (4, [1, 0.1, 0.2, 0.05, 0xff0000, 0.5], b"goal"))
        self.assertEqual([numbers for what, numbers, _ in did if what == 0], [[3]])

    def test_a_robot_without_the_right_is_told(self):
        run = self.run_program("""
from controller import Supervisor
supervisor = Supervisor()
print(supervisor.getFromDef("BALL"), supervisor.getRoot(), supervisor.getSupervisor())
supervisor.simulationReset()
supervisor.step(32)
""", Simulator(PUCK))
        self.assertEqual(run.out, "None None False\n")
        self.assertIn("supervisor", run.err)
        self.assertEqual(run.of("DO_WORLD"), [])


if __name__ == "__main__":
    unittest.main()
