// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/**
 * A thing of the world: a robot, an object, a lamp, or a part of one. {@link Supervisor#getFromDef} finds it. Places are
 * m, angles rad, in the world's axes.
 */
public class Node implements Kinds {
  final long address;

  private Node(long address) {
    this.address = address;
  }

  static Node of(long address) {
    return address == 0 ? null : new Node(address);
  }

  @Override
  public boolean equals(Object other) {
    return other instanceof Node && ((Node) other).address == address;
  }

  @Override
  public int hashCode() {
    return Long.hashCode(address);
  }

  @Override
  public String toString() {
    return getTypeName() + " " + getDef();
  }

  /** Its DEF; empty: none. */
  public String getDef() {
    return Native.supervisor_node_get_def(address);
  }

  /** Its number, from 1 on, as long as the world runs. */
  public int getId() {
    return Native.supervisor_node_get_id(address);
  }

  /** Its kind: Node.ROBOT, Node.SOLID ... */
  public int getType() {
    return Native.supervisor_node_get_type(address);
  }

  /** The word in the world file: "E-puck", "Solid" ... */
  public String getTypeName() {
    return Native.supervisor_node_get_type_name(address);
  }

  /** What it is at bottom: of an "E-puck" a "Robot". */
  public String getBaseTypeName() {
    return Native.supervisor_node_get_base_type_name(address);
  }

  /** Whether it was written as a PROTO. */
  public boolean isProto() {
    return Native.supervisor_node_is_proto(address);
  }

  /** The node whose child it is; null: it is the root. */
  public Node getParentNode() {
    return of(Native.supervisor_node_get_parent_node(address));
  }

  /** A node inside of it. */
  public Node getFromProtoDef(String def) {
    return of(Native.supervisor_node_get_from_proto_def(address, def));
  }

  /** Its text, as in a world file. */
  public String exportString() {
    return Native.supervisor_node_export_string(address);
  }

  /** The field of that name; null: it has none, and a warning says so. */
  public Field getField(String name) {
    return Field.of(Native.supervisor_node_get_field(address, name));
  }

  /** A field by its place, from 0 on. */
  public Field getFieldByIndex(int index) {
    return Field.of(Native.supervisor_node_get_field_by_index(address, index));
  }

  /** How many fields there are. */
  public int getNumberOfFields() {
    return Native.supervisor_node_get_number_of_fields(address);
  }

  /** A field inside of a PROTO. */
  public Field getProtoField(String name) {
    return Field.of(Native.supervisor_node_get_proto_field(address, name));
  }

  /** A field inside of a PROTO. */
  public Field getBaseNodeField(String name) {
    return getProtoField(name);
  }

  /** x, y, z. */
  public double[] getPosition() {
    return Memory.values(Native.supervisor_node_get_position(address), 3);
  }

  /** Its rotation, 3 x 3, row by row. */
  public double[] getOrientation() {
    return Memory.values(Native.supervisor_node_get_orientation(address), 9);
  }

  /** Place and rotation, 4 x 4, row by row, in the world. */
  public double[] getPose() {
    return getPose(null);
  }

  /** Place and rotation, 4 x 4, row by row, seen from another node; null: in the world. */
  public double[] getPose(Node from) {
    return Memory.values(Native.supervisor_node_get_pose(address, from == null ? 0 : from.address), 16);
  }

  /** x, y, z, in the world's axes. */
  public double[] getCenterOfMass() {
    return Memory.values(Native.supervisor_node_get_center_of_mass(address), 3);
  }

  /** Where it touches others. */
  public ContactPoint[] getContactPoints() {
    return getContactPoints(false);
  }

  /** Where it touches others; with descendants: also where its children do. */
  public ContactPoint[] getContactPoints(boolean includeDescendants) {
    double[] four = Memory.contacts(address, includeDescendants);
    ContactPoint[] points = new ContactPoint[four.length / 4];
    for (int i = 0; i < points.length; i++)
      points[i] = new ContactPoint(four[4 * i], four[4 * i + 1], four[4 * i + 2], (int) four[4 * i + 3]);
    return points;
  }

  /** How many getContactPoints() gives. */
  public int getNumberOfContactPoints() {
    return getContactPoints().length;
  }

  /** x, y, z of one of them. */
  public double[] getContactPoint(int index) {
    return getContactPoints()[index].getPoint();
  }

  /** Whether it would stand. */
  public boolean getStaticBalance() {
    return Native.supervisor_node_get_static_balance(address);
  }

  /** x, y, z in m/s, then about x, y, z in rad/s. */
  public double[] getVelocity() {
    return Memory.values(Native.supervisor_node_get_velocity(address), 6);
  }

  /** Six numbers, as getVelocity() gives them. */
  public void setVelocity(double[] velocity) {
    Native.supervisor_node_set_velocity(address, Memory.of(velocity, 6, "Node.setVelocity"));
  }

  /** It comes to rest. */
  public void resetPhysics() {
    Native.supervisor_node_reset_physics(address);
  }

  /** A robot's program begins anew. */
  public void restartController() {
    Native.supervisor_node_restart_controller(address);
  }

  /** It goes from the world. */
  public void remove() {
    Native.supervisor_node_remove(address);
  }

  /** Keeps where it is and what it does under a name, for loadState(). */
  public void saveState(String name) {
    Native.supervisor_node_save_state(address, name);
  }

  /** Puts it back as it was at saveState(); "__init__": as the run began. */
  public void loadState(String name) {
    Native.supervisor_node_load_state(address, name);
  }

  /** N for one step, at its centre of mass; relative: in its own axes. */
  public void addForce(double[] force, boolean relative) {
    Native.supervisor_node_add_force(address, Memory.of(force, 3, "Node.addForce"), relative);
  }

  /** N for one step, m from its centre of mass; relative: in its own axes. */
  public void addForceWithOffset(double[] force, double[] offset, boolean relative) {
    Native.supervisor_node_add_force_with_offset(address, Memory.of(force, 3, "Node.addForceWithOffset"),
        Memory.of(offset, 3, "Node.addForceWithOffset"), relative);
  }

  /** Nm for one step; relative: in its own axes. */
  public void addTorque(double[] torque, boolean relative) {
    Native.supervisor_node_add_torque(address, Memory.of(torque, 3, "Node.addTorque"), relative);
  }

  /** The window would look at it. */
  public void moveViewpoint() {
    Native.supervisor_node_move_viewpoint(address);
  }

  /** Whether a camera sees it. */
  public void setVisibility(Node from, boolean visible) {
    Native.supervisor_node_set_visibility(address, from.address, visible);
  }
}
