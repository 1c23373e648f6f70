// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/**
 * A robot's program, or one of its own, with the right to see and change the world. Without that right the functions
 * here warn and do nothing. Places are m, angles rad, in the world's axes.
 */
public class Supervisor extends Robot {
  public static final int SIMULATION_MODE_PAUSE = 0;
  public static final int SIMULATION_MODE_REAL_TIME = 1;
  public static final int SIMULATION_MODE_FAST = 2;
  public static final int SIMULATION_MODE_RUN = SIMULATION_MODE_FAST;

  /** The node that holds all others, in its field "children". */
  public Node getRoot() {
    return Node.of(Native.supervisor_node_get_root());
  }

  /** The node of the program's own robot. */
  public Node getSelf() {
    return Node.of(Native.supervisor_node_get_self());
  }

  /** The node of that DEF, or else of that name; of one inside another: "OUTER.INNER". null: there is none. */
  public Node getFromDef(String def) {
    return Node.of(Native.supervisor_node_get_from_def(def));
  }

  /** The node of that number; null: there is none. */
  public Node getFromId(int id) {
    return Node.of(Native.supervisor_node_get_from_id(id));
  }

  /** The node of a device of the program's own robot. */
  public Node getFromDevice(Device device) {
    return Node.of(Native.supervisor_node_get_from_device(device.tag));
  }

  /** The node that somebody has selected in the view; null: there is none. */
  public Node getSelected() {
    return Node.of(Native.supervisor_node_get_selected());
  }

  /** The run ends with this status, with the next step: 0 passed, else failed. */
  public void simulationQuit(int status) {
    Native.supervisor_simulation_quit(status);
  }

  /** The world begins again, with the next step: all robots, objects and programs but this one. */
  public void simulationReset() {
    Native.supervisor_simulation_reset();
  }

  /** All come to rest. */
  public void simulationResetPhysics() {
    Native.supervisor_simulation_reset_physics();
  }

  /** The same as worldReload(), as old versions have it. */
  public void simulationRevert() {
    Native.supervisor_world_reload();
  }

  /** SIMULATION_MODE_FAST. */
  public int simulationGetMode() {
    return Native.supervisor_simulation_get_mode();
  }

  /** Accepted; how fast a run goes is the command's --speed. */
  public void simulationSetMode(int mode) {
    Native.supervisor_simulation_set_mode(mode);
  }

  /** The world begins again, this program too. */
  public void worldReload() {
    Native.supervisor_world_reload();
  }

  /** Another world: not in a run, a warning. */
  public void worldLoad(String filename) {
    Native.supervisor_world_load(filename);
  }

  /** Writes the world into a file: not in a run, a warning, false. */
  public boolean worldSave(String filename) {
    return Native.supervisor_world_save(filename);
  }

  /**
   * Text on the picture of the world: x, y from the upper left corner, 0 to 1; size 0 to 1 of the picture's height;
   * color 0xRRGGBB; transparency 0 to 1. A label of the same id is replaced.
   */
  public void setLabel(int id, String label, double x, double y, double size, int color, double transparency, String font) {
    Native.supervisor_set_label(id, label, x, y, size, color, transparency, font);
  }

  /** The same in Arial. */
  public void setLabel(int id, String label, double x, double y, double size, int color, double transparency) {
    setLabel(id, label, x, y, size, color, transparency, "Arial");
  }

  /** A picture of the world, from above: PNG or SVG. */
  public void exportImage(String filename, int quality) {
    Native.supervisor_export_image(filename, quality);
  }

  /** Films are made by {@code twinpuck run --film}: a warning. */
  public void movieStartRecording(
      String filename, int width, int height, int codec, int quality, int acceleration, boolean caption) {
    Native.supervisor_movie_start_recording(filename, width, height, codec, quality, acceleration, caption);
  }

  /** Accepted. */
  public void movieStopRecording() {
    Native.supervisor_movie_stop_recording();
  }

  /** Whether a film is written. */
  public boolean movieIsReady() {
    return Native.supervisor_movie_is_ready();
  }

  /** Whether a film could not be written. */
  public boolean movieFailed() {
    return Native.supervisor_movie_failed();
  }

  /** A page of the run is made by {@code twinpuck run --report}: false. */
  public boolean animationStartRecording(String filename) {
    return Native.supervisor_animation_start_recording(filename);
  }

  /** Accepted. */
  public boolean animationStopRecording() {
    return Native.supervisor_animation_stop_recording();
  }
}
