# SPDX-License-Identifier: MIT
"""Field: what a node of the world says, for supervisors."""
from typing import TYPE_CHECKING, Any, List, Optional, Sequence

from .device import numbers
from .library import c, warn

if TYPE_CHECKING:
    from .node import Node


class Field:
    """A field of a node: `node.getField("translation")`.

    One value (SF) or a list of values (MF). `field.value` reads and sets either; getSFVec3f() and the like say what they
    expect. An index counts from 0; -1 is the last member.
    """

    (SF_BOOL, SF_INT32, SF_FLOAT, SF_VEC2F, SF_VEC3F, SF_ROTATION, SF_COLOR, SF_STRING, SF_NODE) = range(0x01, 0x0a)
    MF = 0x10
    (MF_BOOL, MF_INT32, MF_FLOAT, MF_VEC2F, MF_VEC3F, MF_ROTATION, MF_COLOR, MF_STRING, MF_NODE) = range(0x11, 0x1a)

    def __init__(self, ref: int):
        self._ref = ref
        self.type: int = c.supervisor_field_get_type(ref)

    def __repr__(self):
        return "<Field %s %s>" % (self.getTypeName(), self.getName())

    def getName(self) -> str:
        """As in the world file."""
        return c.supervisor_field_get_name(self._ref) or ""

    def getType(self) -> int:
        """Field.SF_VEC3F ..."""
        return self.type

    def getTypeName(self) -> str:
        """"SFVec3f" ..."""
        return c.supervisor_field_get_type_name(self._ref) or ""

    def getCount(self) -> int:
        """Members of a list; -1 of what is no list."""
        return c.supervisor_field_get_count(self._ref)

    def getActualField(self) -> "Field":
        """Itself."""
        return self

    # --- one value

    def _get(self) -> Any:
        """The value, of whatever type it is."""
        if self.type & Field.MF:
            return [self._member(i) for i in range(self.getCount())]
        word, size = _KINDS.get(self.type, ("", 0))
        if self.type == Field.SF_NODE:
            return _node(c.supervisor_field_get_sf_node(self._ref))
        value = getattr(c, "supervisor_field_get_sf_" + word)(self._ref) if word else None
        return numbers(value, size) if size else value

    def _set(self, value: Any) -> None:
        """Sets the value, of whatever type it is."""
        if self.type & Field.MF:
            self._set_list(value)
            return
        value = self._fitting(value)
        if value is not None:
            getattr(c, "supervisor_field_set_sf_" + _KINDS[self.type][0])(self._ref, value)

    value = property(_get, _set, doc="The value: a bool, int, float, str, Node, a list of numbers, or a list of these.")

    def _fitting(self, value):
        """The value as C takes it; None after a warning: it is of another type."""
        word, size = _KINDS[self.type & ~Field.MF]
        try:
            if word == "string":
                return value if isinstance(value, str) else self._refuse(value, "text")
            if word == "bool":
                return bool(value)
            if word == "int32":
                return int(value)
            if word == "float":
                return float(value)
            values = [float(v) for v in value] if size else []
        except (TypeError, ValueError):
            values = None
        if not size or values is None or len(values) != size:
            return self._refuse(value, "%d numbers" % size if size > 1 else "one number" if word != "node" else "importSFNodeFromString()")
        return values

    def _refuse(self, value, expected):
        warn("Field %s: got %r, expected %s; it stays as it was" % (self.getName(), value, expected))

    def getSFBool(self) -> bool:
        """Of an SFBool."""
        return self._get()

    def getSFInt32(self) -> int:
        """Of an SFInt32."""
        return self._get()

    def getSFFloat(self) -> float:
        """Of an SFFloat."""
        return self._get()

    def getSFVec2f(self) -> List[float]:
        """Two numbers."""
        return self._get()

    def getSFVec3f(self) -> List[float]:
        """Three numbers; of `translation` x, y, z in m."""
        return self._get()

    def getSFRotation(self) -> List[float]:
        """An axis x, y, z and an angle in rad."""
        return self._get()

    def getSFColor(self) -> List[float]:
        """Red, green, blue, 0 to 1."""
        return self._get()

    def getSFString(self) -> str:
        """Text."""
        return self._get()

    def getSFNode(self) -> "Optional[Node]":
        """A node; None: there is none in it."""
        return self._get()

    def setSFBool(self, value: bool) -> None:
        """Of an SFBool."""
        self._set(value)

    def setSFInt32(self, value: int) -> None:
        """Of an SFInt32."""
        self._set(value)

    def setSFFloat(self, value: float) -> None:
        """Of an SFFloat."""
        self._set(value)

    def setSFVec2f(self, value: Sequence[float]) -> None:
        """Two numbers."""
        self._set(value)

    def setSFVec3f(self, value: Sequence[float]) -> None:
        """Three numbers; of `translation` x, y, z in m."""
        self._set(value)

    def setSFRotation(self, value: Sequence[float]) -> None:
        """An axis x, y, z and an angle in rad."""
        self._set(value)

    def setSFColor(self, value: Sequence[float]) -> None:
        """Red, green, blue, 0 to 1."""
        self._set(value)

    def setSFString(self, value: str) -> None:
        """Text."""
        self._set(value)

    # --- members of a list

    def _member(self, index: int) -> Any:
        word, size = _KINDS.get(self.type & ~Field.MF, ("", 0))
        value = getattr(c, "supervisor_field_get_mf_" + word)(self._ref, int(index)) if word else None
        return _node(value) if word == "node" else numbers(value, size) if size else value

    def _set_member(self, index: int, value: Any, do: str = "set") -> None:
        value = self._fitting(value)
        if value is not None:
            getattr(c, "supervisor_field_%s_mf_%s" % (do, _KINDS[self.type & ~Field.MF][0]))(self._ref, int(index), value)

    def _set_list(self, values) -> None:
        if self.type == Field.MF_NODE:
            self._refuse(values, "importMFNodeFromString()")
            return
        values, count = list(values), self.getCount()
        for index, value in enumerate(values[:count]):
            self._set_member(index, value)
        for index, value in enumerate(values[count:], count):
            self._set_member(index, value, "insert")
        for index in range(count - 1, len(values) - 1, -1):
            self.removeMF(index)

    def getMFBool(self, index: int) -> bool:
        """A member of an MFBool."""
        return self._member(index)

    def getMFInt32(self, index: int) -> int:
        """A member of an MFInt32."""
        return self._member(index)

    def getMFFloat(self, index: int) -> float:
        """A member of an MFFloat."""
        return self._member(index)

    def getMFVec2f(self, index: int) -> List[float]:
        """A member of an MFVec2f."""
        return self._member(index)

    def getMFVec3f(self, index: int) -> List[float]:
        """A member of an MFVec3f."""
        return self._member(index)

    def getMFRotation(self, index: int) -> List[float]:
        """A member of an MFRotation."""
        return self._member(index)

    def getMFColor(self, index: int) -> List[float]:
        """A member of an MFColor."""
        return self._member(index)

    def getMFString(self, index: int) -> str:
        """A member of an MFString."""
        return self._member(index)

    def getMFNode(self, index: int) -> "Optional[Node]":
        """A member of an MFNode, as of the root's `children`."""
        return self._member(index)

    def setMFBool(self, index: int, value: bool) -> None:
        """A member of an MFBool."""
        self._set_member(index, value)

    def setMFInt32(self, index: int, value: int) -> None:
        """A member of an MFInt32."""
        self._set_member(index, value)

    def setMFFloat(self, index: int, value: float) -> None:
        """A member of an MFFloat."""
        self._set_member(index, value)

    def setMFVec2f(self, index: int, value: Sequence[float]) -> None:
        """A member of an MFVec2f."""
        self._set_member(index, value)

    def setMFVec3f(self, index: int, value: Sequence[float]) -> None:
        """A member of an MFVec3f."""
        self._set_member(index, value)

    def setMFRotation(self, index: int, value: Sequence[float]) -> None:
        """A member of an MFRotation."""
        self._set_member(index, value)

    def setMFColor(self, index: int, value: Sequence[float]) -> None:
        """A member of an MFColor."""
        self._set_member(index, value)

    def setMFString(self, index: int, value: str) -> None:
        """A member of an MFString."""
        self._set_member(index, value)

    def insertMFBool(self, index: int, value: bool) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def insertMFInt32(self, index: int, value: int) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def insertMFFloat(self, index: int, value: float) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def insertMFVec2f(self, index: int, value: Sequence[float]) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def insertMFVec3f(self, index: int, value: Sequence[float]) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def insertMFRotation(self, index: int, value: Sequence[float]) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def insertMFColor(self, index: int, value: Sequence[float]) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def insertMFString(self, index: int, value: str) -> None:
        """A new member before another; -1: at the end."""
        self._set_member(index, value, "insert")

    def removeMF(self, index: int) -> None:
        """A member goes; of an MFNode its node goes from the world."""
        c.supervisor_field_remove_mf(self._ref, int(index))

    def removeMFItem(self, index: int) -> None:
        """The same as removeMF()."""
        self.removeMF(index)

    def removeMFNode(self, index: int) -> None:
        """The same as removeMF()."""
        self.removeMF(index)

    def removeSF(self) -> None:
        """The node of an SFNode goes."""
        c.supervisor_field_remove_sf(self._ref)

    # --- new nodes

    def importMFNodeFromString(self, position: int, node_string: str) -> None:
        """Adds a node, written as in a world file of Webots, before the member `position`; -1: at the end."""
        c.supervisor_field_import_mf_node_from_string(self._ref, int(position), node_string)

    def importMFNode(self, position: int, filename: str) -> None:
        """Adds the nodes of a file (.wbo), as importMFNodeFromString()."""
        with open(filename, encoding="utf-8") as file:
            self.importMFNodeFromString(position, file.read())

    def importSFNodeFromString(self, node_string: str) -> None:
        """Puts a node, written as in a world file of Webots, into an empty SFNode."""
        c.supervisor_field_import_sf_node_from_string(self._ref, node_string)

    def importSFNode(self, filename: str) -> None:
        """Puts the node of a file (.wbo) into an empty SFNode."""
        with open(filename, encoding="utf-8") as file:
            self.importSFNodeFromString(file.read())

    def enableSFTracking(self, sampling_period: int) -> None:
        """Accepted: values are always as of the last step."""

    def disableSFTracking(self) -> None:
        """Accepted."""

    name = property(getName)
    type_name = property(getTypeName)
    count = property(getCount)


# of a type: its word in C, and how many numbers it has where these are an array
_KINDS = {Field.SF_BOOL: ("bool", 0), Field.SF_INT32: ("int32", 0), Field.SF_FLOAT: ("float", 0),
          Field.SF_VEC2F: ("vec2f", 2), Field.SF_VEC3F: ("vec3f", 3), Field.SF_ROTATION: ("rotation", 4),
          Field.SF_COLOR: ("color", 3), Field.SF_STRING: ("string", 0), Field.SF_NODE: ("node", 0)}


def _node(ref):
    from .node import node_or_none
    return node_or_none(ref)
