// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** A picture that the program draws. Places are pixels from the upper left corner; what lies outside is not drawn. */
public class Display extends Device {
  public static final int RGB = 3;
  public static final int RGBA = 4;
  public static final int ARGB = 5;
  public static final int BGRA = 6;
  public static final int ABGR = 7;

  Display(int tag) {
    super(tag);
  }

  /** By its name. */
  public Display(String name) {
    super(name);
  }

  /** Columns. */
  public int getWidth() {
    return Native.display_get_width(tag);
  }

  /** Rows. */
  public int getHeight() {
    return Native.display_get_height(tag);
  }

  /** 0xRRGGBB of what is drawn from now on; white at the beginning. */
  public void setColor(int color) {
    Native.display_set_color(tag, color);
  }

  /** 0 transparent to 1, of what is drawn from now on. */
  public void setAlpha(double alpha) {
    Native.display_set_alpha(tag, alpha);
  }

  /** 0: what is there stays, to 1: what is drawn replaces it. */
  public void setOpacity(double opacity) {
    Native.display_set_opacity(tag, opacity);
  }

  /** Of drawText(). */
  public void setFont(String font, int size, boolean antiAliasing) {
    Native.display_set_font(tag, font, size, antiAliasing);
  }

  /** Shows a camera's pictures beneath. */
  public void attachCamera(Camera camera) {
    Native.display_attach_camera(tag, camera.tag);
  }

  /** Shows them no more. */
  public void detachCamera() {
    Native.display_detach_camera(tag);
  }

  /** One pixel. */
  public void drawPixel(int x, int y) {
    Native.display_draw_pixel(tag, x, y);
  }

  /** From one pixel to another, both included. */
  public void drawLine(int x1, int y1, int x2, int y2) {
    Native.display_draw_line(tag, x1, y1, x2, y2);
  }

  /** The outline; x, y its upper left corner. */
  public void drawRectangle(int x, int y, int width, int height) {
    Native.display_draw_rectangle(tag, x, y, width, height);
  }

  /** The outline around a middle, a and b the half axes. */
  public void drawOval(int cx, int cy, int a, int b) {
    Native.display_draw_oval(tag, cx, cy, a, b);
  }

  /** The outline through these corners. */
  public void drawPolygon(int[] x, int[] y) {
    Native.display_draw_polygon(tag, x, y, Math.min(x.length, y.length));
  }

  /** x, y the text's upper left corner. */
  public void drawText(String text, int x, int y) {
    Native.display_draw_text(tag, text, x, y);
  }

  /** As drawRectangle(), filled. */
  public void fillRectangle(int x, int y, int width, int height) {
    Native.display_fill_rectangle(tag, x, y, width, height);
  }

  /** As drawOval(), filled. */
  public void fillOval(int cx, int cy, int a, int b) {
    Native.display_fill_oval(tag, cx, cy, a, b);
  }

  /** As drawPolygon(), filled. */
  public void fillPolygon(int[] x, int[] y) {
    Native.display_fill_polygon(tag, x, y, Math.min(x.length, y.length));
  }

  /** A picture of these pixels, 0xAARRGGBB, rows from the top. It is to be pasted, then deleted. */
  public ImageRef imageNew(int width, int height, int[] data, int format) {
    java.nio.ByteBuffer bytes =
        java.nio.ByteBuffer.allocate(4 * data.length).order(java.nio.ByteOrder.LITTLE_ENDIAN);
    bytes.asIntBuffer().put(data);
    return imageNew(width, height, bytes.array(), format);
  }

  /** A picture of these pixels, in the format RGB, RGBA ..., rows from the top. It is to be pasted, then deleted. */
  public ImageRef imageNew(int width, int height, byte[] data, int format) {
    int size = (format == RGB ? 3 : 4) * width * height;
    if (data.length < size)
      throw new IllegalArgumentException("Display.imageNew: got " + data.length + " bytes, expected " + size);
    return ImageRef.of(Native.display_image_new(tag, width, height, data, format));
  }

  /** A picture of a part of the display. It is to be pasted or saved, then deleted. */
  public ImageRef imageCopy(int x, int y, int width, int height) {
    return ImageRef.of(Native.display_image_copy(tag, x, y, width, height));
  }

  /** A picture of a file; null: it cannot be read. */
  public ImageRef imageLoad(String filename) {
    return ImageRef.of(Native.display_image_load(tag, filename));
  }

  /** Puts a picture on the display; x, y its upper left corner. */
  public void imagePaste(ImageRef image, int x, int y) {
    imagePaste(image, x, y, false);
  }

  /** Puts a picture on the display; x, y its upper left corner; blend: what is transparent in it stays. */
  public void imagePaste(ImageRef image, int x, int y, boolean blend) {
    Native.display_image_paste(tag, image.address, x, y, blend);
  }

  /** Writes a picture, or with null the whole display, as PNG into the program's folder. */
  public void imageSave(ImageRef image, String filename) {
    Native.display_image_save(tag, image == null ? 0 : image.address, filename);
  }

  /** Forgets a picture. */
  public void imageDelete(ImageRef image) {
    Native.display_image_delete(tag, image.address);
  }
}
