/* SPDX-License-Identifier: MIT
 * device/supervisor.h: the supervisor's functions as programs of 2005 to 2007 call them. For programs of the PC.
 * Positions are m, rotations an axis and
 * rad, always with x to the right, y up and z towards the reader, whatever the world's axes.
 * Interface: [Webots: changelog and archived controllers of versions 5.0 to 5.8]. */
#ifndef DEVICE_SUPERVISOR_H
#define DEVICE_SUPERVISOR_H

#include "robot_types.h"

#ifdef __cplusplus
extern "C" {
#endif

/* which numbers of a field: those chosen stand packed, in this order, in the array of floats */
#define SUPERVISOR_FIELD_TRANSLATION_X 0x01
#define SUPERVISOR_FIELD_TRANSLATION_Y 0x02
#define SUPERVISOR_FIELD_TRANSLATION_Z 0x04
#define SUPERVISOR_FIELD_TRANSLATION 0x07
#define SUPERVISOR_FIELD_ROTATION_X 0x08
#define SUPERVISOR_FIELD_ROTATION_Y 0x10
#define SUPERVISOR_FIELD_ROTATION_Z 0x20
#define SUPERVISOR_FIELD_ROTATION_ANGLE 0x40
#define SUPERVISOR_FIELD_ROTATION 0x78
#define SUPERVISOR_FIELD_TRANSLATION_AND_ROTATION 0x7F

/** By def, or else by name. Never NULL; see supervisor_node_was_found(). */
NodeRef supervisor_node_get_from_def(const char *def);
/** 1: the world has it. [Webots: to be asked after robot_step(0)] */
int supervisor_node_was_found(NodeRef node);
/** Fills `buffer` with the chosen numbers now, and anew every `period_ms` until it is called with 0. */
void supervisor_field_get(NodeRef node, int mask, float *buffer, int period_ms);
/** Sets the chosen numbers; the others stay. */
void supervisor_field_set(NodeRef node, int mask, const float *values);
/** Text over pictures: x, y of its upper left corner and size as fractions of the picture, colour 0xRRGGBB. */
void supervisor_set_label(int id, const char *text, float x, float y, float size, unsigned int colour);
/** PNG or SVG; other endings get .png added. */
void supervisor_export_image(const char *filename, int quality);
/** The run ends, passed. */
void supervisor_simulation_quit(void);
/** Every robot and object back to its start, robots' programs restarted. */
void supervisor_simulation_revert(void);
/** Every robot and object comes to rest. */
void supervisor_simulation_physics_reset(void);
/** A robot's program begins anew; it keeps the one it has, and a warning says so when that has another name. */
void supervisor_robot_set_controller(NodeRef robot, const char *controller);

#ifdef __cplusplus
}
#endif
#endif
