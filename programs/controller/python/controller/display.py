# SPDX-License-Identifier: MIT
"""Display: a picture that the program draws."""
from typing import Optional, Sequence

from .camera import Camera
from .device import Device
from .library import c


class Display(Device):
    """A picture of the program's. Nobody sees it during the run; imageSave() writes it as PNG.

    Places are pixels from the upper left corner; what lies outside is not drawn.
    """

    RGB, RGBA, ARGB, BGRA, ABGR = range(3, 8)

    def getWidth(self) -> int:
        """Columns."""
        return c.display_get_width(self._tag)

    def getHeight(self) -> int:
        """Rows."""
        return c.display_get_height(self._tag)

    def setColor(self, color: int) -> None:
        """0xRRGGBB of what is drawn from now on; white at the beginning."""
        c.display_set_color(self._tag, int(color))

    def setAlpha(self, alpha: float) -> None:
        """0 transparent to 1, of what is drawn from now on."""
        c.display_set_alpha(self._tag, alpha)

    def setOpacity(self, opacity: float) -> None:
        """0: what is there stays, to 1: what is drawn replaces it."""
        c.display_set_opacity(self._tag, opacity)

    def setFont(self, font: str, size: int, anti_aliasing: bool) -> None:
        """Of drawText()."""
        c.display_set_font(self._tag, font, int(size), anti_aliasing)

    def drawPixel(self, x: int, y: int) -> None:
        """One pixel."""
        c.display_draw_pixel(self._tag, int(x), int(y))

    def drawLine(self, x1: int, y1: int, x2: int, y2: int) -> None:
        """From one pixel to another, both included."""
        c.display_draw_line(self._tag, int(x1), int(y1), int(x2), int(y2))

    def drawRectangle(self, x: int, y: int, width: int, height: int) -> None:
        """The outline; x, y its upper left corner."""
        c.display_draw_rectangle(self._tag, int(x), int(y), int(width), int(height))

    def drawOval(self, cx: int, cy: int, a: int, b: int) -> None:
        """The outline around a middle, a and b the half axes."""
        c.display_draw_oval(self._tag, int(cx), int(cy), int(a), int(b))

    def drawPolygon(self, x: Sequence[int], y: Sequence[int]) -> None:
        """The outline through these corners."""
        c.display_draw_polygon(self._tag, x, y, min(len(x), len(y)))

    def drawText(self, text: str, x: int, y: int) -> None:
        """x, y the text's upper left corner."""
        c.display_draw_text(self._tag, text, int(x), int(y))

    def fillRectangle(self, x: int, y: int, width: int, height: int) -> None:
        """As drawRectangle(), filled."""
        c.display_fill_rectangle(self._tag, int(x), int(y), int(width), int(height))

    def fillOval(self, cx: int, cy: int, a: int, b: int) -> None:
        """As drawOval(), filled."""
        c.display_fill_oval(self._tag, int(cx), int(cy), int(a), int(b))

    def fillPolygon(self, x: Sequence[int], y: Sequence[int]) -> None:
        """As drawPolygon(), filled."""
        c.display_fill_polygon(self._tag, x, y, min(len(x), len(y)))

    def attachCamera(self, camera: Camera) -> None:
        """Shows a camera's pictures beneath."""
        c.display_attach_camera(self._tag, camera.tag)

    def detachCamera(self) -> None:
        """Shows them no more."""
        c.display_detach_camera(self._tag)

    def imageNew(self, data, format: int, width: int, height: int) -> Optional[int]:
        """A picture of these pixels: bytes, rows from the top, in the format RGB, RGBA ...; or rows of columns of
        [red, green, blue], as Camera.getImageArray() has columns of rows. It is to be pasted, then deleted."""
        size = (3 if format == self.RGB else 4) * width * height
        data = bytes(data) if isinstance(data, (bytes, bytearray, memoryview)) else _flat(data, width, height)
        if len(data) < size:
            raise ValueError("Display.imageNew: got %d bytes, expected %d" % (len(data), size))
        return c.display_image_new(self._tag, int(width), int(height), data, format)

    def imageCopy(self, x: int, y: int, width: int, height: int) -> Optional[int]:
        """A picture of a part of the display. It is to be pasted or saved, then deleted."""
        return c.display_image_copy(self._tag, int(x), int(y), int(width), int(height))

    def imageLoad(self, filename: str) -> Optional[int]:
        """A picture of a file; None: it cannot be read."""
        return c.display_image_load(self._tag, filename)

    def imagePaste(self, image: int, x: int, y: int, blend: bool = False) -> None:
        """Puts a picture on the display; x, y its upper left corner; blend: what is transparent in it stays."""
        c.display_image_paste(self._tag, image, int(x), int(y), bool(blend))

    def imageSave(self, image: Optional[int], filename: str) -> None:
        """Writes a picture, or with None the whole display, as PNG into the program's folder."""
        c.display_image_save(self._tag, image, filename)

    def imageDelete(self, image: int) -> None:
        """Forgets a picture."""
        c.display_image_delete(self._tag, image)

    width = property(getWidth)
    height = property(getHeight)
    color = property(None, setColor, doc="0xRRGGBB, to set only.")
    alpha = property(None, setAlpha, doc="0 to 1, to set only.")
    opacity = property(None, setOpacity, doc="0 to 1, to set only.")


def _flat(data, width, height):
    """The bytes of an array (NumPy's, or lists in lists: data[x][y] is a pixel)."""
    if hasattr(data, "tobytes"):
        return data.tobytes()
    if data and isinstance(data[0], int):
        return bytes(data)
    return bytes(value for y in range(height) for x in range(width) for value in data[x][y])
