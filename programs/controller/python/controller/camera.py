# SPDX-License-Identifier: MIT
"""Camera, and what it recognises."""
import ctypes
from typing import List, Optional

from . import library
from .device import Sensor
from .library import c


class _Recognised(ctypes.Structure):
    """WbCameraRecognitionObject of webots/camera.h."""

    _fields_ = [("id", ctypes.c_int), ("position", ctypes.c_double * 3), ("orientation", ctypes.c_double * 4),
                ("size", ctypes.c_double * 2), ("position_on_image", ctypes.c_int * 2),
                ("size_on_image", ctypes.c_int * 2), ("number_of_colors", ctypes.c_int),
                ("colors", ctypes.POINTER(ctypes.c_double)), ("model", ctypes.c_char_p)]


class CameraRecognitionObject:
    """An object on the picture. It stays as it was seen, also after the next step."""

    def __init__(self, seen=None):
        seen = _Recognised() if seen is None else seen
        self.id: int = seen.id
        self.position: List[float] = seen.position[:]
        self.orientation: List[float] = seen.orientation[:]
        self.size: List[float] = seen.size[:]
        self.position_on_image: List[int] = seen.position_on_image[:]
        self.size_on_image: List[int] = seen.size_on_image[:]
        self.number_of_colors: int = seen.number_of_colors
        self.colors: List[float] = seen.colors[:3 * seen.number_of_colors] if seen.number_of_colors else []
        self.model: str = (seen.model or b"").decode(errors="replace")

    def getId(self) -> int:
        """The number of its node: supervisor.getFromId()."""
        return self.id

    def getPosition(self) -> List[float]:
        """x, y, z in m, seen from the camera in the camera's axes."""
        return self.position

    def getOrientation(self) -> List[float]:
        """Axis x, y, z and angle in rad, seen from the camera."""
        return self.orientation

    def getSize(self) -> List[float]:
        """Width and height in m."""
        return self.size

    def getPositionOnImage(self) -> List[int]:
        """Column and row of its middle, pixels from the upper left corner."""
        return self.position_on_image

    def getSizeOnImage(self) -> List[int]:
        """Columns and rows, pixels."""
        return self.size_on_image

    def getNumberOfColors(self) -> int:
        """How many colours its node's recognitionColors has."""
        return self.number_of_colors

    def getColors(self) -> List[float]:
        """Red, green, blue of each colour, 0 to 1, one after the other."""
        return self.colors

    def getModel(self) -> str:
        """Its node's model."""
        return self.model

    def get_model(self) -> bytes:
        """As versions up to R2022 had it: bytes."""
        return self.model.encode()

    get_id = getId
    get_position = getPosition
    get_orientation = getOrientation
    get_size = getSize
    get_position_on_image = getPositionOnImage
    get_size_on_image = getSizeOnImage
    get_number_of_colors = getNumberOfColors
    get_colors = getColors

    def __repr__(self):
        return "<CameraRecognitionObject %d %r at column %d, row %d>" % ((self.id, self.model) + tuple(self.position_on_image))


def _rgb_columns(image, width, height):
    """array[x][y] is [red, green, blue]."""
    if image is None:
        return None
    return [[[image[i + 2], image[i + 1], image[i]] for i in range(4 * x, 4 * width * height, 4 * width)]
            for x in range(width)]


class Camera(Sensor):
    """The camera: 52 x 39 pixels on the e-puck, unless the world says otherwise.

    `enable(period_ms)`; after the first period `getImage()` is the newest picture. With NumPy:

        picture = numpy.frombuffer(camera.getImage(), numpy.uint8).reshape(camera.height, camera.width, 4)
        picture = numpy.asarray(camera)   # the same without any copy; its pixels change with the next picture

    Both are blue, green, red, 255.
    """

    _kind = "camera"
    _image, _image_step = None, -1

    def getImage(self) -> Optional[bytes]:
        """Rows from the top, 4 bytes a pixel: blue, green, red, 255. Black before the first; None: not enabled."""
        if self._image_step != library.steps:
            self._image_step = library.steps
            address = c.camera_get_image(self._tag)
            self._image = ctypes.string_at(address, 4 * self.getWidth() * self.getHeight()) if address else None
        return self._image

    @property
    def __array_interface__(self) -> dict:
        """For NumPy: rows x columns x 4 bytes, where the library keeps them; no rows when there is no picture."""
        address = c.camera_get_image(self._tag)
        rows = self.getHeight() if address else 0
        return {"version": 3, "shape": (rows, self.getWidth(), 4), "typestr": "|u1",
                "data": (address or ctypes.addressof(_NO_PICTURE), True)}

    def getImageArray(self) -> Optional[List[List[List[int]]]]:
        """array[x][y] is [red, green, blue], 0 to 255; x from the left, y from the top. Slow: see numpy.asarray(camera)."""
        return _rgb_columns(self.getImage(), self.getWidth(), self.getHeight())

    @staticmethod
    def imageGetRed(image: bytes, width: int, x: int, y: int) -> int:
        """0 to 255, of the pixel in column x and row y of getImage()."""
        return image[4 * (y * width + x) + 2]

    @staticmethod
    def imageGetGreen(image: bytes, width: int, x: int, y: int) -> int:
        """0 to 255, of the pixel in column x and row y of getImage()."""
        return image[4 * (y * width + x) + 1]

    @staticmethod
    def imageGetBlue(image: bytes, width: int, x: int, y: int) -> int:
        """0 to 255, of the pixel in column x and row y of getImage()."""
        return image[4 * (y * width + x)]

    @staticmethod
    def imageGetGray(image: bytes, width: int, x: int, y: int) -> float:
        """The mean of red, green and blue, 0 to 255."""
        at = 4 * (y * width + x)
        return (int(image[at]) + int(image[at + 1]) + int(image[at + 2])) / 3

    imageGetGrey = imageGetGray

    def getWidth(self) -> int:
        """Columns."""
        return c.camera_get_width(self._tag)

    def getHeight(self) -> int:
        """Rows."""
        return c.camera_get_height(self._tag)

    def getFov(self) -> float:
        """How wide it sees, rad, from the left to the right."""
        return c.camera_get_fov(self._tag)

    def getMinFov(self) -> float:
        """rad: what setFov() takes at least."""
        return c.camera_get_min_fov(self._tag)

    def getMaxFov(self) -> float:
        """rad: what setFov() takes at most."""
        return c.camera_get_max_fov(self._tag)

    def setFov(self, fov: float) -> None:
        """The e-puck's camera has no zoom: no effect, a warning."""
        c.camera_set_fov(self._tag, fov)

    def getNear(self) -> float:
        """m: what is nearer is not seen."""
        return c.camera_get_near(self._tag)

    def getExposure(self) -> float:
        """J/m2."""
        return c.camera_get_exposure(self._tag)

    def setExposure(self, exposure: float) -> None:
        """No effect: the camera exposes by itself."""
        c.camera_set_exposure(self._tag, exposure)

    def getFocalLength(self) -> float:
        """m."""
        return c.camera_get_focal_length(self._tag)

    def getFocalDistance(self) -> float:
        """m."""
        return c.camera_get_focal_distance(self._tag)

    def getMinFocalDistance(self) -> float:
        """m."""
        return c.camera_get_min_focal_distance(self._tag)

    def getMaxFocalDistance(self) -> float:
        """m."""
        return c.camera_get_max_focal_distance(self._tag)

    def setFocalDistance(self, distance: float) -> None:
        """No effect: a fixed lens."""
        c.camera_set_focal_distance(self._tag, distance)

    def saveImage(self, filename: str, quality: int = 100) -> int:
        """Writes the picture into a file, in the program's folder. 0: written; -1: not."""
        return c.camera_save_image(self._tag, filename, quality)

    # --- recognition

    def hasRecognition(self) -> bool:
        """Whether the world lets it recognise objects."""
        return c.camera_has_recognition(self._tag)

    def recognitionEnable(self, sampling_period: int) -> None:
        """Recognises objects every `sampling_period` ms; 0: no more."""
        c.camera_recognition_enable(self._tag, int(sampling_period))

    def recognitionDisable(self) -> None:
        """Recognises no more."""
        c.camera_recognition_disable(self._tag)

    def getRecognitionSamplingPeriod(self) -> int:
        """ms; 0: not enabled."""
        return c.camera_recognition_get_sampling_period(self._tag)

    def getRecognitionNumberOfObjects(self) -> int:
        """How many getRecognitionObjects() gives."""
        return c.camera_recognition_get_number_of_objects(self._tag)

    def getRecognitionObjects(self) -> List[CameraRecognitionObject]:
        """The objects on the picture whose nodes have recognitionColors."""
        count = c.camera_recognition_get_number_of_objects(self._tag)
        address = c.camera_recognition_get_objects(self._tag) if count > 0 else None
        return [CameraRecognitionObject(seen) for seen in (_Recognised * count).from_address(address)] if address else []

    def hasRecognitionSegmentation(self) -> bool:
        """Whether there are pictures of objects in their colours."""
        return c.camera_recognition_has_segmentation(self._tag)

    def enableRecognitionSegmentation(self) -> None:
        """Takes pictures of objects in their colours."""
        c.camera_recognition_enable_segmentation(self._tag)

    def disableRecognitionSegmentation(self) -> None:
        """Takes no more pictures of objects in their colours."""
        c.camera_recognition_disable_segmentation(self._tag)

    def isRecognitionSegmentationEnabled(self) -> bool:
        """Whether it takes pictures of objects in their colours."""
        return c.camera_recognition_is_segmentation_enabled(self._tag)

    def getRecognitionSegmentationImage(self) -> Optional[bytes]:
        """As getImage(); None: there is none."""
        address = c.camera_recognition_get_segmentation_image(self._tag)
        return ctypes.string_at(address, 4 * self.getWidth() * self.getHeight()) if address else None

    def getRecognitionSegmentationImageArray(self) -> Optional[List[List[List[int]]]]:
        """As getImageArray(); None: there is none."""
        return _rgb_columns(self.getRecognitionSegmentationImage(), self.getWidth(), self.getHeight())

    def saveRecognitionSegmentationImage(self, filename: str, quality: int = 100) -> int:
        """0: written; -1: not."""
        return c.camera_recognition_save_segmentation_image(self._tag, filename, quality)

    image = property(getImage)
    segmentation_image = property(getRecognitionSegmentationImage)
    width = property(getWidth)
    height = property(getHeight)
    fov = property(getFov, setFov)
    min_fov = property(getMinFov)
    max_fov = property(getMaxFov)
    near = property(getNear)
    exposure = property(getExposure, setExposure)
    focal_length = property(getFocalLength)
    focal_distance = property(getFocalDistance, setFocalDistance)
    min_focal_distance = property(getMinFocalDistance)
    max_focal_distance = property(getMaxFocalDistance)


_NO_PICTURE = ctypes.c_ubyte()
