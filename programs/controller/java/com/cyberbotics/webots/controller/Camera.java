// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/** The camera: 52 x 39 pixels on the e-puck, unless the world says otherwise. */
public class Camera extends Device {
  Camera(int tag) {
    super(tag);
  }

  /** By its name. */
  public Camera(String name) {
    super(name);
  }

  /** Takes a sample every {@code samplingPeriod} ms, at ends of steps; 0: no more. Nothing before the first is over. */
  public void enable(int samplingPeriod) {
    Native.camera_enable(tag, samplingPeriod);
  }

  /** Takes no more samples. */
  public void disable() {
    Native.camera_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getSamplingPeriod() {
    return Native.camera_get_sampling_period(tag);
  }

  /** Rows from the top; a pixel is 0xFFRRGGBB. Black before the first; null: not enabled. */
  public int[] getImage() {
    return Memory.ints(Native.camera_get_image(tag), getWidth() * getHeight());
  }

  /** 0 to 255, of the pixel in column x and row y of getImage(). */
  public static int imageGetRed(int[] image, int width, int x, int y) {
    return pixelGetRed(image[y * width + x]);
  }

  /** 0 to 255, of the pixel in column x and row y of getImage(). */
  public static int imageGetGreen(int[] image, int width, int x, int y) {
    return pixelGetGreen(image[y * width + x]);
  }

  /** 0 to 255, of the pixel in column x and row y of getImage(). */
  public static int imageGetBlue(int[] image, int width, int x, int y) {
    return pixelGetBlue(image[y * width + x]);
  }

  /** The mean of red, green and blue, 0 to 255. */
  public static int imageGetGray(int[] image, int width, int x, int y) {
    return pixelGetGray(image[y * width + x]);
  }

  /** The mean of red, green and blue, 0 to 255. */
  public static int imageGetGrey(int[] image, int width, int x, int y) {
    return pixelGetGray(image[y * width + x]);
  }

  /** 0 to 255. */
  public static int pixelGetRed(int pixel) {
    return pixel >> 16 & 0xff;
  }

  /** 0 to 255. */
  public static int pixelGetGreen(int pixel) {
    return pixel >> 8 & 0xff;
  }

  /** 0 to 255. */
  public static int pixelGetBlue(int pixel) {
    return pixel & 0xff;
  }

  /** The mean of red, green and blue, 0 to 255. */
  public static int pixelGetGray(int pixel) {
    return (pixelGetRed(pixel) + pixelGetGreen(pixel) + pixelGetBlue(pixel)) / 3;
  }

  /** The mean of red, green and blue, 0 to 255. */
  public static int pixelGetGrey(int pixel) {
    return pixelGetGray(pixel);
  }

  /** Columns. */
  public int getWidth() {
    return Native.camera_get_width(tag);
  }

  /** Rows. */
  public int getHeight() {
    return Native.camera_get_height(tag);
  }

  /** How wide it sees, rad, from the left to the right. */
  public double getFov() {
    return Native.camera_get_fov(tag);
  }

  /** rad: what setFov() takes at least. */
  public double getMinFov() {
    return Native.camera_get_min_fov(tag);
  }

  /** rad: what setFov() takes at most. */
  public double getMaxFov() {
    return Native.camera_get_max_fov(tag);
  }

  /** The e-puck's camera has no zoom: no effect, a warning. */
  public void setFov(double fov) {
    Native.camera_set_fov(tag, fov);
  }

  /** m: what is nearer is not seen. */
  public double getNear() {
    return Native.camera_get_near(tag);
  }

  /** Writes the picture into a file, in the program's folder; quality 1 to 100 of a JPEG. 0: written; -1: not. */
  public int saveImage(String filename, int quality) {
    return Native.camera_save_image(tag, filename, quality);
  }

  /** Whether the world lets it recognise objects. */
  public boolean hasRecognition() {
    return Native.camera_has_recognition(tag);
  }

  /** Recognises objects every {@code samplingPeriod} ms; 0: no more. */
  public void recognitionEnable(int samplingPeriod) {
    Native.camera_recognition_enable(tag, samplingPeriod);
  }

  /** Recognises no more. */
  public void recognitionDisable() {
    Native.camera_recognition_disable(tag);
  }

  /** ms; 0: not enabled. */
  public int getRecognitionSamplingPeriod() {
    return Native.camera_recognition_get_sampling_period(tag);
  }

  /** How many getRecognitionObjects() gives. */
  public int getRecognitionNumberOfObjects() {
    return Native.camera_recognition_get_number_of_objects(tag);
  }

  /** The objects on the picture whose nodes have recognitionColors. */
  public CameraRecognitionObject[] getRecognitionObjects() {
    long address = Native.camera_recognition_get_objects(tag);
    int count = address == 0 ? 0 : getRecognitionNumberOfObjects();
    CameraRecognitionObject[] objects = new CameraRecognitionObject[count];
    for (int i = 0; i < count; i++)
      objects[i] = new CameraRecognitionObject(Memory.recognised(address, i), Memory.recognisedModel(address, i));
    return objects;
  }
}
