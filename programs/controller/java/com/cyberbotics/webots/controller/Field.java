// SPDX-License-Identifier: MIT
package com.cyberbotics.webots.controller;

/**
 * A field of a node: {@code node.getField("translation")}. One value (SF) or a list of values (MF). An index counts from
 * 0; -1 is the last member.
 */
public class Field {
  public static final int SF_BOOL = 1;
  public static final int SF_INT32 = 2;
  public static final int SF_FLOAT = 3;
  public static final int SF_VEC2F = 4;
  public static final int SF_VEC3F = 5;
  public static final int SF_ROTATION = 6;
  public static final int SF_COLOR = 7;
  public static final int SF_STRING = 8;
  public static final int SF_NODE = 9;
  public static final int MF_BOOL = 17;
  public static final int MF_INT32 = 18;
  public static final int MF_FLOAT = 19;
  public static final int MF_VEC2F = 20;
  public static final int MF_VEC3F = 21;
  public static final int MF_ROTATION = 22;
  public static final int MF_COLOR = 23;
  public static final int MF_STRING = 24;
  public static final int MF_NODE = 25;

  private final long address;

  private Field(long address) {
    this.address = address;
  }

  static Field of(long address) {
    return address == 0 ? null : new Field(address);
  }

  /** As in the world file. */
  public String getName() {
    return Native.supervisor_field_get_name(address);
  }

  /** Field.SF_VEC3F ... */
  public int getType() {
    return Native.supervisor_field_get_type(address);
  }

  /** "SFVec3f" ... */
  public String getTypeName() {
    return Native.supervisor_field_get_type_name(address);
  }

  /** Members of a list; -1 of what is no list. */
  public int getCount() {
    return Native.supervisor_field_get_count(address);
  }

  /** The value. */
  public boolean getSFBool() {
    return Native.supervisor_field_get_sf_bool(address);
  }

  /** The value. */
  public void setSFBool(boolean value) {
    Native.supervisor_field_set_sf_bool(address, value);
  }

  /** A member. */
  public boolean getMFBool(int index) {
    return Native.supervisor_field_get_mf_bool(address, index);
  }

  /** A member. */
  public void setMFBool(int index, boolean value) {
    Native.supervisor_field_set_mf_bool(address, index, value);
  }

  /** A new member before another; -1: at the end. */
  public void insertMFBool(int index, boolean value) {
    Native.supervisor_field_insert_mf_bool(address, index, value);
  }

  /** The value. */
  public int getSFInt32() {
    return Native.supervisor_field_get_sf_int32(address);
  }

  /** The value. */
  public void setSFInt32(int value) {
    Native.supervisor_field_set_sf_int32(address, value);
  }

  /** A member. */
  public int getMFInt32(int index) {
    return Native.supervisor_field_get_mf_int32(address, index);
  }

  /** A member. */
  public void setMFInt32(int index, int value) {
    Native.supervisor_field_set_mf_int32(address, index, value);
  }

  /** A new member before another; -1: at the end. */
  public void insertMFInt32(int index, int value) {
    Native.supervisor_field_insert_mf_int32(address, index, value);
  }

  /** The value. */
  public double getSFFloat() {
    return Native.supervisor_field_get_sf_float(address);
  }

  /** The value. */
  public void setSFFloat(double value) {
    Native.supervisor_field_set_sf_float(address, value);
  }

  /** A member. */
  public double getMFFloat(int index) {
    return Native.supervisor_field_get_mf_float(address, index);
  }

  /** A member. */
  public void setMFFloat(int index, double value) {
    Native.supervisor_field_set_mf_float(address, index, value);
  }

  /** A new member before another; -1: at the end. */
  public void insertMFFloat(int index, double value) {
    Native.supervisor_field_insert_mf_float(address, index, value);
  }

  /** Two numbers. */
  public double[] getSFVec2f() {
    return Memory.values(Native.supervisor_field_get_sf_vec2f(address), 2);
  }

  /** Two numbers. */
  public void setSFVec2f(double[] value) {
    Native.supervisor_field_set_sf_vec2f(address, Memory.of(value, 2, "Field.setSFVec2f"));
  }

  /** A member: two numbers. */
  public double[] getMFVec2f(int index) {
    return Memory.values(Native.supervisor_field_get_mf_vec2f(address, index), 2);
  }

  /** A member: two numbers. */
  public void setMFVec2f(int index, double[] value) {
    Native.supervisor_field_set_mf_vec2f(address, index, Memory.of(value, 2, "Field.setMFVec2f"));
  }

  /** A new member before another; -1: at the end. */
  public void insertMFVec2f(int index, double[] value) {
    Native.supervisor_field_insert_mf_vec2f(address, index, Memory.of(value, 2, "Field.insertMFVec2f"));
  }

  /** Three numbers; of translation x, y, z in m. */
  public double[] getSFVec3f() {
    return Memory.values(Native.supervisor_field_get_sf_vec3f(address), 3);
  }

  /** Three numbers; of translation x, y, z in m. */
  public void setSFVec3f(double[] value) {
    Native.supervisor_field_set_sf_vec3f(address, Memory.of(value, 3, "Field.setSFVec3f"));
  }

  /** A member: three numbers; of translation x, y, z in m. */
  public double[] getMFVec3f(int index) {
    return Memory.values(Native.supervisor_field_get_mf_vec3f(address, index), 3);
  }

  /** A member: three numbers; of translation x, y, z in m. */
  public void setMFVec3f(int index, double[] value) {
    Native.supervisor_field_set_mf_vec3f(address, index, Memory.of(value, 3, "Field.setMFVec3f"));
  }

  /** A new member before another; -1: at the end. */
  public void insertMFVec3f(int index, double[] value) {
    Native.supervisor_field_insert_mf_vec3f(address, index, Memory.of(value, 3, "Field.insertMFVec3f"));
  }

  /** An axis x, y, z and an angle in rad. */
  public double[] getSFRotation() {
    return Memory.values(Native.supervisor_field_get_sf_rotation(address), 4);
  }

  /** An axis x, y, z and an angle in rad. */
  public void setSFRotation(double[] value) {
    Native.supervisor_field_set_sf_rotation(address, Memory.of(value, 4, "Field.setSFRotation"));
  }

  /** A member: an axis x, y, z and an angle in rad. */
  public double[] getMFRotation(int index) {
    return Memory.values(Native.supervisor_field_get_mf_rotation(address, index), 4);
  }

  /** A member: an axis x, y, z and an angle in rad. */
  public void setMFRotation(int index, double[] value) {
    Native.supervisor_field_set_mf_rotation(address, index, Memory.of(value, 4, "Field.setMFRotation"));
  }

  /** A new member before another; -1: at the end. */
  public void insertMFRotation(int index, double[] value) {
    Native.supervisor_field_insert_mf_rotation(address, index, Memory.of(value, 4, "Field.insertMFRotation"));
  }

  /** Red, green, blue, 0 to 1. */
  public double[] getSFColor() {
    return Memory.values(Native.supervisor_field_get_sf_color(address), 3);
  }

  /** Red, green, blue, 0 to 1. */
  public void setSFColor(double[] value) {
    Native.supervisor_field_set_sf_color(address, Memory.of(value, 3, "Field.setSFColor"));
  }

  /** A member: red, green, blue, 0 to 1. */
  public double[] getMFColor(int index) {
    return Memory.values(Native.supervisor_field_get_mf_color(address, index), 3);
  }

  /** A member: red, green, blue, 0 to 1. */
  public void setMFColor(int index, double[] value) {
    Native.supervisor_field_set_mf_color(address, index, Memory.of(value, 3, "Field.setMFColor"));
  }

  /** A new member before another; -1: at the end. */
  public void insertMFColor(int index, double[] value) {
    Native.supervisor_field_insert_mf_color(address, index, Memory.of(value, 3, "Field.insertMFColor"));
  }

  /** The value. */
  public String getSFString() {
    return Native.supervisor_field_get_sf_string(address);
  }

  /** The value. */
  public void setSFString(String value) {
    Native.supervisor_field_set_sf_string(address, value);
  }

  /** A member. */
  public String getMFString(int index) {
    return Native.supervisor_field_get_mf_string(address, index);
  }

  /** A member. */
  public void setMFString(int index, String value) {
    Native.supervisor_field_set_mf_string(address, index, value);
  }

  /** A new member before another; -1: at the end. */
  public void insertMFString(int index, String value) {
    Native.supervisor_field_insert_mf_string(address, index, value);
  }

  /** A node; null: there is none in it. */
  public Node getSFNode() {
    return Node.of(Native.supervisor_field_get_sf_node(address));
  }

  /** A member of an MFNode, as of the root's children. */
  public Node getMFNode(int index) {
    return Node.of(Native.supervisor_field_get_mf_node(address, index));
  }

  /** A member goes; of an MFNode its node goes from the world. */
  public void removeMF(int index) {
    Native.supervisor_field_remove_mf(address, index);
  }

  /** The same as removeMF(). */
  public void removeMFItem(int index) {
    removeMF(index);
  }

  /** The same as removeMF(). */
  public void removeMFNode(int index) {
    removeMF(index);
  }

  /** The node of an SFNode goes. */
  public void removeSF() {
    Native.supervisor_field_remove_sf(address);
  }

  /** Adds a node, written as in a world file of Webots, before the member {@code position}; -1: at the end. */
  public void importMFNodeFromString(int position, String nodeString) {
    Native.supervisor_field_import_mf_node_from_string(address, position, nodeString);
  }

  /** Adds the nodes of a file (.wbo), as importMFNodeFromString(). */
  public void importMFNode(int position, String filename) {
    try {
      byte[] text = java.nio.file.Files.readAllBytes(java.nio.file.Paths.get(filename));
      importMFNodeFromString(position, new String(text, java.nio.charset.StandardCharsets.UTF_8));
    } catch (java.io.IOException error) {
      throw new java.io.UncheckedIOException(error);
    }
  }

  /** Puts a node, written as in a world file of Webots, into an empty SFNode. */
  public void importSFNodeFromString(String nodeString) {
    Native.supervisor_field_import_sf_node_from_string(address, nodeString);
  }
}
