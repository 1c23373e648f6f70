# SPDX-License-Identifier: MIT
"""Node, ContactPoint: things of the world, for supervisors."""
import ctypes
from typing import List, Optional, Sequence

from .device import numbers
from .field import Field
from .library import c


class _Contact(ctypes.Structure):
    """WbContactPoint of webots/contact_point.h."""

    _fields_ = [("point", ctypes.c_double * 3), ("node_id", ctypes.c_int)]


class ContactPoint:
    """Where a node touches something."""

    def __init__(self, contact):
        self.point: List[float] = contact.point[:]
        self.node_id: int = contact.node_id

    def getPoint(self) -> List[float]:
        """x, y, z in m, in the world's axes."""
        return self.point

    def getNodeId(self) -> int:
        """The number of the node that touches: the node asked about, or one in it."""
        return self.node_id


class Node:
    """A thing of the world: a robot, an object, a lamp, or a part of one. `supervisor.getFromDef("BALL")` finds it.

    Places are m, angles rad, in the world's axes.
    """

    def __init__(self, DEF: Optional[str] = None, tag: Optional[int] = None, id: Optional[int] = None,
                 selected: Optional[bool] = None, ref: Optional[int] = None):
        if ref is None:
            if id is not None:
                ref = c.supervisor_node_get_from_id(id)
            elif tag is not None:
                ref = c.supervisor_node_get_from_device(tag) if tag else c.supervisor_node_get_self()
            elif DEF is not None:
                ref = c.supervisor_node_get_from_def(DEF)
            elif selected is not None:
                ref = c.supervisor_node_get_selected()
            else:
                ref = c.supervisor_node_get_root()
        self._ref = ref

    def __eq__(self, other):
        return self._ref == other._ref if isinstance(other, Node) else NotImplemented

    def __hash__(self):
        return hash(self._ref)

    def __repr__(self):
        return "<Node %s %s>" % (self.getTypeName(), self.getDef() or self.getId())

    # --- what it is

    def getDef(self) -> str:
        """Its DEF; empty: none."""
        return c.supervisor_node_get_def(self._ref) or ""

    def getId(self) -> int:
        """Its number, from 1 on, as long as the world runs."""
        return c.supervisor_node_get_id(self._ref)

    def getType(self) -> int:
        """Its kind: Node.ROBOT, Node.SOLID ..."""
        return c.supervisor_node_get_type(self._ref)

    def getTypeName(self) -> str:
        """The word in the world file: "E-puck", "Solid" ..."""
        return c.supervisor_node_get_type_name(self._ref) or ""

    def getBaseTypeName(self) -> str:
        """What it is at bottom: of an "E-puck" a "Robot"."""
        return c.supervisor_node_get_base_type_name(self._ref) or ""

    def isProto(self) -> bool:
        """Whether it was written as a PROTO."""
        return c.supervisor_node_is_proto(self._ref)

    def getParentNode(self) -> "Optional[Node]":
        """The node whose child it is; None: it is the root."""
        return node_or_none(c.supervisor_node_get_parent_node(self._ref))

    def getFromProtoDef(self, DEF: str) -> "Optional[Node]":
        """A node inside of it."""
        return node_or_none(c.supervisor_node_get_from_proto_def(self._ref, DEF))

    def exportString(self) -> str:
        """Its text, as in a world file."""
        return c.supervisor_node_export_string(self._ref) or ""

    # --- its fields

    def getField(self, name: str) -> Optional[Field]:
        """The field of that name; None: it has none, and a warning says so."""
        return _field_or_none(c.supervisor_node_get_field(self._ref, name))

    def getFieldByIndex(self, index: int) -> Optional[Field]:
        """A field by its place, from 0 on."""
        return _field_or_none(c.supervisor_node_get_field_by_index(self._ref, index))

    def getNumberOfFields(self) -> int:
        """How many there are."""
        return c.supervisor_node_get_number_of_fields(self._ref)

    def getProtoField(self, name: str) -> Optional[Field]:
        """A field inside of a PROTO."""
        return _field_or_none(c.supervisor_node_get_proto_field(self._ref, name))

    def getProtoFieldByIndex(self, index: int) -> Optional[Field]:
        """A field inside of a PROTO, by its place."""
        return _field_or_none(c.supervisor_node_get_proto_field_by_index(self._ref, index))

    def getProtoNumberOfFields(self) -> int:
        """How many fields are inside of a PROTO."""
        return c.supervisor_node_get_proto_number_of_fields(self._ref)

    getBaseNodeField = getProtoField
    getBaseNodeFieldByIndex = getProtoFieldByIndex
    getNumberOfBaseNodeFields = getProtoNumberOfFields

    # --- where it is and what it does

    def getPosition(self) -> List[float]:
        """x, y, z."""
        return numbers(c.supervisor_node_get_position(self._ref), 3)

    def getOrientation(self) -> List[float]:
        """Its rotation, 3 x 3, row by row."""
        return numbers(c.supervisor_node_get_orientation(self._ref), 9)

    def getPose(self, from_node: "Optional[Node]" = None) -> List[float]:
        """Place and rotation, 4 x 4, row by row; seen from another node, or in the world."""
        return numbers(c.supervisor_node_get_pose(self._ref, from_node._ref if from_node else None), 16)

    def getCenterOfMass(self) -> List[float]:
        """x, y, z, in the world's axes."""
        return numbers(c.supervisor_node_get_center_of_mass(self._ref), 3)

    def getContactPoints(self, include_descendants: bool = False) -> List[ContactPoint]:
        """Where it touches others; with descendants: also where its children do."""
        count = ctypes.c_int()
        address = c.supervisor_node_get_contact_points(self._ref, bool(include_descendants), ctypes.addressof(count))
        return [ContactPoint(p) for p in (_Contact * count.value).from_address(address)] if address and count.value > 0 else []

    def getNumberOfContactPoints(self, include_descendants: bool = False) -> int:
        """How many getContactPoints() gives."""
        return len(self.getContactPoints(include_descendants))

    def getContactPoint(self, index: int) -> List[float]:
        """x, y, z of one of them."""
        return self.getContactPoints()[index].point

    def getStaticBalance(self) -> bool:
        """Whether it would stand."""
        return c.supervisor_node_get_static_balance(self._ref)

    def getVelocity(self) -> List[float]:
        """x, y, z in m/s, then about x, y, z in rad/s."""
        return numbers(c.supervisor_node_get_velocity(self._ref), 6)

    def setVelocity(self, velocity: Sequence[float]) -> None:
        """Six numbers, as getVelocity() gives them."""
        if len(velocity) != 6:
            raise ValueError("Node.setVelocity: got %d numbers, expected 6 (m/s, rad/s)" % len(velocity))
        c.supervisor_node_set_velocity(self._ref, velocity)

    def resetPhysics(self) -> None:
        """It comes to rest."""
        c.supervisor_node_reset_physics(self._ref)

    def restartController(self) -> None:
        """A robot's program begins anew."""
        c.supervisor_node_restart_controller(self._ref)

    def remove(self) -> None:
        """It goes from the world."""
        c.supervisor_node_remove(self._ref)

    def saveState(self, name: str) -> None:
        """Keeps where it is and what it does under a name, for loadState()."""
        c.supervisor_node_save_state(self._ref, name)

    def loadState(self, name: str) -> None:
        """Puts it back as it was at saveState(); "__init__": as the run began."""
        c.supervisor_node_load_state(self._ref, name)

    def setJointPosition(self, position: float, index: int = 1) -> None:
        """rad, of a joint."""
        c.supervisor_node_set_joint_position(self._ref, position, index)

    def addForce(self, force: Sequence[float], relative: bool) -> None:
        """N for one step, at its centre of mass; relative: in its own axes."""
        c.supervisor_node_add_force(self._ref, _three(force, "addForce", "N"), bool(relative))

    def addForceWithOffset(self, force: Sequence[float], offset: Sequence[float], relative: bool) -> None:
        """N for one step, m from its centre of mass; relative: in its own axes."""
        c.supervisor_node_add_force_with_offset(self._ref, _three(force, "addForceWithOffset", "N"),
                                                _three(offset, "addForceWithOffset", "m"), bool(relative))

    def addTorque(self, torque: Sequence[float], relative: bool) -> None:
        """Nm for one step; relative: in its own axes."""
        c.supervisor_node_add_torque(self._ref, _three(torque, "addTorque", "Nm"), bool(relative))

    # --- what only a window would show or make quicker

    def enablePoseTracking(self, sampling_period: int, from_node: "Optional[Node]" = None) -> None:
        """Accepted: getPose() is always as of the last step."""

    def disablePoseTracking(self, from_node: "Optional[Node]" = None) -> None:
        """Accepted."""

    def enableContactPointsTracking(self, sampling_period: int, include_descendants: bool = False) -> None:
        """Accepted: getContactPoints() is always as of the last step."""

    def disableContactPointsTracking(self, include_descendants: bool = False) -> None:
        """Accepted."""

    enableContactPointTracking = enableContactPointsTracking
    disableContactPointTracking = disableContactPointsTracking

    def moveViewpoint(self) -> None:
        """The window would look at it."""
        c.supervisor_node_move_viewpoint(self._ref)

    def setVisibility(self, from_node: "Node", visible: bool) -> None:
        """Whether a camera sees it."""
        c.supervisor_node_set_visibility(self._ref, from_node._ref, bool(visible))

    DEF = property(getDef)
    id = property(getId)
    type = property(getType)
    type_name = property(getTypeName)
    base_type_name = property(getBaseTypeName)
    number_of_fields = property(getNumberOfFields)
    number_of_base_node_fields = property(getProtoNumberOfFields)

    # kinds, numbered as in webots/nodes.h
    (NO_NODE, APPEARANCE, BACKGROUND, BILLBOARD, BOX, CAD_SHAPE, CAPSULE, COLOR, CONE, COORDINATE, CYLINDER,
     DIRECTIONAL_LIGHT, ELEVATION_GRID, FOG, GROUP, IMAGE_TEXTURE, INDEXED_FACE_SET, INDEXED_LINE_SET, MATERIAL, MESH,
     MUSCLE, NORMAL, PBR_APPEARANCE, PLANE, POINT_LIGHT, POINT_SET, POSE, SHAPE, SPHERE, SPOT_LIGHT, TEXTURE_COORDINATE,
     TEXTURE_TRANSFORM, TRANSFORM, VIEWPOINT, ROBOT, ACCELEROMETER, ALTIMETER, BRAKE, CAMERA, COMPASS, CONNECTOR, DISPLAY,
     DISTANCE_SENSOR, EMITTER, GPS, GYRO, INERTIAL_UNIT, LED, LIDAR, LIGHT_SENSOR, LINEAR_MOTOR, PEN, POSITION_SENSOR,
     PROPELLER, RADAR, RANGE_FINDER, RECEIVER, ROTATIONAL_MOTOR, SKIN, SPEAKER, TOUCH_SENSOR, VACUUM_GRIPPER, BALL_JOINT,
     BALL_JOINT_PARAMETERS, CHARGER, CONTACT_PROPERTIES, DAMPING, FLUID, FOCUS, HINGE_JOINT, HINGE_JOINT_PARAMETERS,
     HINGE_2_JOINT, IMMERSION_PROPERTIES, JOINT_PARAMETERS, LENS, LENS_FLARE, PHYSICS, RECOGNITION, SLIDER_JOINT, SLOT,
     SOLID, SOLID_REFERENCE, TRACK, TRACK_WHEEL, WORLD_INFO, ZOOM, MICROPHONE, RADIO) = range(88)
    DIFFERENTIAL_WHEELS = ROBOT


def node_or_none(ref) -> Optional[Node]:
    """The node at an address of C's."""
    return Node(ref=ref) if ref else None


def _field_or_none(ref) -> Optional[Field]:
    return Field(ref) if ref else None


def _three(values, what, unit):
    if len(values) != 3:
        raise ValueError("Node.%s: got %d numbers, expected 3 (%s)" % (what, len(values), unit))
    return values
