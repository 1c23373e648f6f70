# SPDX-License-Identifier: MIT
"""Lidar and RangeFinder: pictures of distances, of `[[robot.device]]`."""
import ctypes
import math
from typing import List, Optional

from .device import Sensor
from .library import c


class LidarPoint(ctypes.Structure):
    """A point that a lidar sees: x, y, z in m in the lidar's axes, infinite where nothing is; its layer; its time in s."""

    _fields_ = [("x", ctypes.c_float), ("y", ctypes.c_float), ("z", ctypes.c_float), ("layer_id", ctypes.c_int),
                ("time", ctypes.c_float)]


class _Ranges(Sensor):
    """What both have in common."""

    def _floats(self, address, count):
        return list((ctypes.c_float * count).from_address(address)) if address else None

    def _image(self, width, height, data_type):
        address = getattr(c, self._kind + "_get_range_image")(self._tag)
        if data_type == "buffer":
            return ctypes.string_at(address, 4 * width * height) if address else None
        return self._floats(address, width * height)

    @staticmethod
    def _rows(image, width):
        return None if image is None else [image[i:i + width] for i in range(0, len(image), width)]

    def getFov(self) -> float:
        """How wide it sees, rad, from the left to the right."""
        return getattr(c, self._kind + "_get_fov")(self._tag)

    def getMinRange(self) -> float:
        """m: what is nearer is infinitely far."""
        return getattr(c, self._kind + "_get_min_range")(self._tag)

    def getMaxRange(self) -> float:
        """m: what is farther is infinitely far."""
        return getattr(c, self._kind + "_get_max_range")(self._tag)

    fov = property(getFov)
    min_range = property(getMinRange)
    max_range = property(getMaxRange)


class Lidar(_Ranges):
    """Distances from the left to the right, in one layer or several. Real e-puck have none: `[[robot.device]]` of kind
    "lidar" gives one."""

    _kind = "lidar"

    def getRangeImage(self, data_type: str = "list") -> Optional[List[float]]:
        """m, layer by layer; infinite: nothing is there, or no sample yet. None: not enabled. "buffer": bytes of floats."""
        return self._image(self.getHorizontalResolution(), self.getNumberOfLayers(), data_type)

    def getRangeImageArray(self) -> Optional[List[List[float]]]:
        """The same, as a list for each column."""
        rows = self._rows(self.getRangeImage(), self.getHorizontalResolution())
        return None if rows is None else [list(column) for column in zip(*rows)]

    def getLayerRangeImage(self, layer: int) -> Optional[List[float]]:
        """m, of one layer, 0 is the uppermost."""
        return self._floats(c.lidar_get_layer_range_image(self._tag, layer), self.getHorizontalResolution())

    def enablePointCloud(self) -> None:
        """getPointCloud() gives points from now on."""
        c.lidar_enable_point_cloud(self._tag)

    def disablePointCloud(self) -> None:
        """No more points."""
        c.lidar_disable_point_cloud(self._tag)

    def isPointCloudEnabled(self) -> bool:
        """Whether getPointCloud() gives points."""
        return c.lidar_is_point_cloud_enabled(self._tag)

    def _points(self, address, count, data_type):
        if not address:
            return None
        if data_type == "buffer":
            return ctypes.string_at(address, ctypes.sizeof(LidarPoint) * count)
        size = ctypes.sizeof(LidarPoint)
        return [LidarPoint.from_buffer_copy(ctypes.string_at(address + size * i, size)) for i in range(count)]

    def getPointCloud(self, data_type: str = "list") -> Optional[List[LidarPoint]]:
        """A point for each distance; None: enablePointCloud() before."""
        return self._points(c.lidar_get_point_cloud(self._tag), self.getNumberOfPoints(), data_type)

    def getLayerPointCloud(self, layer: int, data_type: str = "list") -> Optional[List[LidarPoint]]:
        """The points of one layer."""
        return self._points(c.lidar_get_layer_point_cloud(self._tag, layer), self.getHorizontalResolution(), data_type)

    def getNumberOfPoints(self) -> int:
        """Of all layers."""
        return c.lidar_get_number_of_points(self._tag)

    def getHorizontalResolution(self) -> int:
        """Distances of a layer."""
        return c.lidar_get_horizontal_resolution(self._tag)

    def getNumberOfLayers(self) -> int:
        """Layers, one above the other."""
        return c.lidar_get_number_of_layers(self._tag)

    def getVerticalFov(self) -> float:
        """rad, from the uppermost layer to the lowest."""
        return c.lidar_get_vertical_fov(self._tag)

    def getFrequency(self) -> float:
        """Hz. All its points are of one instant, whatever it is."""
        return c.lidar_get_frequency(self._tag)

    def setFrequency(self, frequency: float) -> None:
        """No effect."""
        c.lidar_set_frequency(self._tag, frequency)

    def getMinFrequency(self) -> float:
        """Hz."""
        return c.lidar_get_min_frequency(self._tag)

    def getMaxFrequency(self) -> float:
        """Hz."""
        return c.lidar_get_max_frequency(self._tag)

    horizontal_resolution = property(getHorizontalResolution)
    number_of_layers = property(getNumberOfLayers)
    number_of_points = property(getNumberOfPoints)
    vertical_fov = property(getVerticalFov)
    frequency = property(getFrequency, setFrequency)
    point_cloud = property(getPointCloud)


class RangeFinder(_Ranges):
    """A picture of distances along its line of sight. Real e-pucks have none: `[[robot.device]]` of kind "range-finder"."""

    _kind = "range_finder"

    def getRangeImage(self, data_type: str = "list") -> Optional[List[float]]:
        """m, rows from the top; infinite: nothing is there, or no sample yet. None: not enabled. "buffer": bytes of floats."""
        return self._image(self.getWidth(), self.getHeight(), data_type)

    def getRangeImageArray(self) -> Optional[List[List[float]]]:
        """The same: array[x][y]."""
        rows = self._rows(self.getRangeImage(), self.getWidth())
        return None if rows is None else [list(column) for column in zip(*rows)]

    @staticmethod
    def rangeImageGetDepth(image: List[float], width: int, x: int, y: int) -> float:
        """m, of a pixel of getRangeImage()."""
        return image[y * width + x] if image else math.nan

    def getWidth(self) -> int:
        """Columns."""
        return c.range_finder_get_width(self._tag)

    def getHeight(self) -> int:
        """Rows."""
        return c.range_finder_get_height(self._tag)

    def saveImage(self, filename: str, quality: int = 100) -> int:
        """Writes a grey picture into a file, in the program's folder: black is near. 0: written; -1: not."""
        return c.range_finder_save_image(self._tag, filename, quality)

    width = property(getWidth)
    height = property(getHeight)
