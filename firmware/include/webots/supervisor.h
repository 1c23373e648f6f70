/* SPDX-License-Identifier: MIT
 * webots/supervisor.h: what a supervisor may ask of the world and do to it, in the names that programs for Webots
 * use since 2008. For programs of the PC that a world names in [[supervisor]]; implemented in
 * supervisor/webots/. Positions are m, rotations an axis and rad, in the axes of the world's [webots] axes.
 * Nodes are the robots, objects and lamps of the world file, found by their def or name. A field that we do not
 * have is NULL, and a warning names it. Interface: [Webots: reference manual, Supervisor]. */
#ifndef WEBOTS_SUPERVISOR_H
#define WEBOTS_SUPERVISOR_H

#include "types.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
	WB_SUPERVISOR_SIMULATION_MODE_PAUSE = 0,
	WB_SUPERVISOR_SIMULATION_MODE_REAL_TIME,
	WB_SUPERVISOR_SIMULATION_MODE_FAST
} WbSimulationMode;
#define WB_SUPERVISOR_SIMULATION_MODE_RUN WB_SUPERVISOR_SIMULATION_MODE_FAST

typedef enum {
	WB_NO_FIELD = 0x00,
	WB_SF_BOOL = 0x01, WB_SF_INT32, WB_SF_FLOAT, WB_SF_VEC2F, WB_SF_VEC3F, WB_SF_ROTATION, WB_SF_COLOR,
	WB_SF_STRING, WB_SF_NODE,
	WB_MF = 0x10,
	WB_MF_BOOL = 0x11, WB_MF_INT32, WB_MF_FLOAT, WB_MF_VEC2F, WB_MF_VEC3F, WB_MF_ROTATION, WB_MF_COLOR,
	WB_MF_STRING, WB_MF_NODE
} WbFieldType;

/* --- the simulation --- */
/** The run ends with this status: 0 passed, else failed. Returns; leave by wb_robot_cleanup(). */
void wb_supervisor_simulation_quit(int status);
/** Every robot and object back to its start, firmware restarted; time and this program go on. */
void wb_supervisor_simulation_reset(void);
void wb_supervisor_simulation_revert(void);
/** Every robot and object comes to rest. */
void wb_supervisor_simulation_reset_physics(void);
void wb_supervisor_simulation_physics_reset(void);
/** Always fast. */
WbSimulationMode wb_supervisor_simulation_get_mode(void);
/** Accepted; pace is the command's --speed. */
void wb_supervisor_simulation_set_mode(WbSimulationMode mode);
/** The same as a reset. */
void wb_supervisor_world_reload(void);

/* --- pictures and labels --- */
/** x, y from the upper left corner, 0 to 1; size 0 to 1; colour 0xRRGGBB; transparency 0 to 1; the font is ours. */
void wb_supervisor_set_label(int id, const char *text, double x, double y, double size, int color,
                             double transparency, const char *font);
/** PNG or SVG; other endings get .png added. quality has no meaning for these. */
void wb_supervisor_export_image(const char *filename, int quality);

/* --- nodes --- */
WbNodeRef wb_supervisor_node_get_root(void);
/** Supervisors have no body: NULL, and a warning. */
WbNodeRef wb_supervisor_node_get_self(void);
/** By def, or else by name; NULL when there is none. */
WbNodeRef wb_supervisor_node_get_from_def(const char *def);
WbNodeRef wb_supervisor_node_get_from_id(int id);
int wb_supervisor_node_get_id(WbNodeRef node);
const char *wb_supervisor_node_get_def(WbNodeRef node);
/** "Robot", "Solid", "PointLight" or "Group" (the root). */
const char *wb_supervisor_node_get_type_name(WbNodeRef node);
const char *wb_supervisor_node_get_base_type_name(WbNodeRef node);
/** Three numbers, nine, six (m/s, then rad/s); valid until the next call for this node. */
const double *wb_supervisor_node_get_position(WbNodeRef node);
const double *wb_supervisor_node_get_orientation(WbNodeRef node);
const double *wb_supervisor_node_get_velocity(WbNodeRef node);
const double *wb_supervisor_node_get_center_of_mass(WbNodeRef node);
void wb_supervisor_node_set_velocity(WbNodeRef node, const double velocity[6]);
/** Comes to rest. */
void wb_supervisor_node_reset_physics(WbNodeRef node);
/** A robot's program begins anew. */
void wb_supervisor_node_restart_controller(WbNodeRef node);

/* --- fields: translation, rotation, name, customData, recognitionColors, baseColor of robots and objects;
 * controller of robots; location, intensity, on of lamps; children of the root. customData stays with this
 * program: no firmware sees it --- */
WbFieldRef wb_supervisor_node_get_field(WbNodeRef node, const char *field_name);
const char *wb_supervisor_field_get_name(WbFieldRef field);
WbFieldType wb_supervisor_field_get_type(WbFieldRef field);
const char *wb_supervisor_field_get_type_name(WbFieldRef field);
/** Members of a list; -1 of what is no list. */
int wb_supervisor_field_get_count(WbFieldRef field);

bool wb_supervisor_field_get_sf_bool(WbFieldRef field);
int wb_supervisor_field_get_sf_int32(WbFieldRef field);
double wb_supervisor_field_get_sf_float(WbFieldRef field);
const double *wb_supervisor_field_get_sf_vec2f(WbFieldRef field);
const double *wb_supervisor_field_get_sf_vec3f(WbFieldRef field);
const double *wb_supervisor_field_get_sf_rotation(WbFieldRef field);
const double *wb_supervisor_field_get_sf_color(WbFieldRef field);
const char *wb_supervisor_field_get_sf_string(WbFieldRef field);
WbNodeRef wb_supervisor_field_get_sf_node(WbFieldRef field);
const double *wb_supervisor_field_get_mf_color(WbFieldRef field, int index);
WbNodeRef wb_supervisor_field_get_mf_node(WbFieldRef field, int index);

void wb_supervisor_field_set_sf_bool(WbFieldRef field, bool value);
void wb_supervisor_field_set_sf_int32(WbFieldRef field, int value);
void wb_supervisor_field_set_sf_float(WbFieldRef field, double value);
void wb_supervisor_field_set_sf_vec2f(WbFieldRef field, const double values[2]);
void wb_supervisor_field_set_sf_vec3f(WbFieldRef field, const double values[3]);
void wb_supervisor_field_set_sf_rotation(WbFieldRef field, const double values[4]);
void wb_supervisor_field_set_sf_color(WbFieldRef field, const double values[3]);
void wb_supervisor_field_set_sf_string(WbFieldRef field, const char *value);
void wb_supervisor_field_set_mf_color(WbFieldRef field, int index, const double values[3]);

#ifdef __cplusplus
}
#endif
#endif
