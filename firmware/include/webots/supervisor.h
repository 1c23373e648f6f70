/* SPDX-License-Identifier: MIT
 * webots/supervisor.h: what a supervisor may ask of the world and do to it, in the names that programs for Webots
 * use since 2008. For programs of the PC. Positions are m, rotations an axis and rad, in the axes of the world's
 * [webots] axes. A node or field that there is none of is NULL, and a warning names it; a function that gets NULL
 * warns and answers 0, or NaN where it answers several numbers. Questions are answered at once; commands are done
 * at the latest with the next step.
 * Interface: [Webots: reference manual, Supervisor]. */
#ifndef WEBOTS_SUPERVISOR_H
#define WEBOTS_SUPERVISOR_H

#include "contact_point.h"
#include "nodes.h"
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

/* --- the simulation */
/** The run ends with this status: 0 passed, else failed. Returns; leave by wb_robot_cleanup(). */
void wb_supervisor_simulation_quit(int status);
/** Every robot and object back to its start. */
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
/** A run has one world: a warning; false. */
void wb_supervisor_world_load(const char *filename);
bool wb_supervisor_world_save(const char *filename);
void wb_supervisor_load_world(const char *filename);
bool wb_supervisor_save_world(const char *filename);

/* --- pictures and labels */
/** x, y from the upper left corner, 0 to 1; size 0 to 1; colour 0xRRGGBB; transparency 0 to 1; the font is ours. */
void wb_supervisor_set_label(int id, const char *text, double x, double y, double size, int color,
                             double transparency, const char *font);
/* before 2018 it had no font */
#define WB_LABEL_ENDS_(transparency, font, ...) transparency, font
#define WB_LABEL_ENDS(...) WB_LABEL_ENDS_(__VA_ARGS__, "Arial", 0)
#define wb_supervisor_set_label(id, text, x, y, size, color, ...) \
  wb_supervisor_set_label(id, text, x, y, size, color, WB_LABEL_ENDS(__VA_ARGS__))
/** PNG or SVG; other endings get .png added. quality has no meaning for these. */
void wb_supervisor_export_image(const char *filename, int quality);
/** There are no movies and no animations by program (use `--record` and `twinpuck replay`): a warning; ready, not failed, false. */
#define WB_SUPERVISOR_MOVIE_READY 0
#define WB_SUPERVISOR_MOVIE_RECORDING 1
#define WB_SUPERVISOR_MOVIE_SAVING 2
#define WB_SUPERVISOR_MOVIE_WRITE_ERROR 3
#define WB_SUPERVISOR_MOVIE_ENCODING_ERROR 4
#define WB_SUPERVISOR_MOVIE_SIMULATION_ERROR 5
void wb_supervisor_movie_start_recording(const char *filename, int width, int height, int codec, int quality,
                                         int acceleration, bool caption);
void wb_supervisor_movie_stop_recording(void);
bool wb_supervisor_movie_is_ready(void);
bool wb_supervisor_movie_failed(void);
int wb_supervisor_movie_get_status(void);
void wb_supervisor_start_movie(const char *file, int width, int height, int codec, int quality, int acceleration,
                               bool caption);
void wb_supervisor_stop_movie(void);
int wb_supervisor_get_movie_status(void);
bool wb_supervisor_animation_start_recording(const char *filename);
bool wb_supervisor_animation_stop_recording(void);
/** Nobody wears a headset: false, NULL. */
bool wb_supervisor_virtual_reality_headset_is_used(void);
const double *wb_supervisor_virtual_reality_headset_get_position(void);
const double *wb_supervisor_virtual_reality_headset_get_orientation(void);

/* --- nodes */
WbNodeRef wb_supervisor_node_get_root(void);
/** The robot that runs this program. */
WbNodeRef wb_supervisor_node_get_self(void);
/** By def, or else by name; NULL when there is none. */
WbNodeRef wb_supervisor_node_get_from_def(const char *def);
WbNodeRef wb_supervisor_node_get_from_id(int id);
WbNodeRef wb_supervisor_node_get_from_device(WbDeviceTag tag);
WbNodeRef wb_supervisor_node_get_from_proto_def(WbNodeRef node, const char *def);
/** Nobody selects anything in a window: NULL. */
WbNodeRef wb_supervisor_node_get_selected(void);
/** NULL for the root. */
WbNodeRef wb_supervisor_node_get_parent_node(WbNodeRef node);
/** Numbers from 1 on; -1 for NULL. */
int wb_supervisor_node_get_id(WbNodeRef node);
WbNodeType wb_supervisor_node_get_type(WbNodeRef node);
/** false: nodes are not told apart by whether a PROTO made them. */
bool wb_supervisor_node_is_proto(WbNodeRef node);
WbProtoRef wb_supervisor_node_get_proto(WbNodeRef node);
const char *wb_supervisor_node_get_def(WbNodeRef node);
const char *wb_supervisor_node_get_type_name(WbNodeRef node);
const char *wb_supervisor_node_get_base_type_name(WbNodeRef node);
/** Three numbers, nine, six (m/s, then rad/s); valid until the next call for this node. */
const double *wb_supervisor_node_get_position(WbNodeRef node);
const double *wb_supervisor_node_get_orientation(WbNodeRef node);
const double *wb_supervisor_node_get_velocity(WbNodeRef node);
const double *wb_supervisor_node_get_center_of_mass(WbNodeRef node);
void wb_supervisor_node_set_velocity(WbNodeRef node, const double velocity[6]);
/** Position and orientation as a matrix of 4 x 4, row after row; of `from_node` where it is not NULL. */
const double *wb_supervisor_node_get_pose(WbNodeRef node, WbNodeRef from_node);
/** What touches the node, in the world's axes. The second argument (descendants included) came in R2022 and has no
 *  meaning: a robot is one body. */
#ifdef __cplusplus
int wb_supervisor_node_get_number_of_contact_points(WbNodeRef node, bool include_descendants = false);
#else
int wb_supervisor_node_get_number_of_contact_points();
#endif
const double *wb_supervisor_node_get_contact_point(WbNodeRef node, int index);
WbNodeRef wb_supervisor_node_get_contact_point_node(WbNodeRef node, int index);
WbContactPoint *wb_supervisor_node_get_contact_points(WbNodeRef node, bool include_descendants, int *size);
bool wb_supervisor_node_get_static_balance(WbNodeRef node);
/** N and Nm for the next step, in the world's axes, or in the node's where `relative`. */
void wb_supervisor_node_add_force(WbNodeRef node, const double force[3], bool relative);
void wb_supervisor_node_add_force_with_offset(WbNodeRef node, const double force[3], const double offset[3],
                                              bool relative);
void wb_supervisor_node_add_torque(WbNodeRef node, const double torque[3], bool relative);
/** Comes to rest. */
void wb_supervisor_node_reset_physics(WbNodeRef node);
/** Goes from the world. */
void wb_supervisor_node_remove(WbNodeRef node);
/** Keeps the node's state under a name, and takes it again; "__init__" is the state at the start. */
void wb_supervisor_node_save_state(WbNodeRef node, const char *state_name);
void wb_supervisor_node_load_state(WbNodeRef node, const char *state_name);
/** Not supported: a warning; an empty text. */
void wb_supervisor_node_set_joint_position(WbNodeRef node, double position, int index);
const char *wb_supervisor_node_export_string(WbNodeRef node);
/** There is no window: nothing happens. */
void wb_supervisor_node_move_viewpoint(WbNodeRef node);
void wb_supervisor_node_set_visibility(WbNodeRef node, WbNodeRef from, bool visible);
/** A question is as cheap as tracking: nothing happens. Period in ms. */
void wb_supervisor_node_enable_pose_tracking(WbNodeRef node, int sampling_period, WbNodeRef from_node);
void wb_supervisor_node_disable_pose_tracking(WbNodeRef node, WbNodeRef from_node);
void wb_supervisor_node_enable_contact_points_tracking(WbNodeRef node, int sampling_period, bool include_descendants);
void wb_supervisor_node_disable_contact_points_tracking(WbNodeRef node);
void wb_supervisor_node_enable_contact_point_tracking(WbNodeRef node, int sampling_period, bool include_descendants);
void wb_supervisor_node_disable_contact_point_tracking(WbNodeRef node, bool include_descendants);
/** A robot's program begins anew. */
void wb_supervisor_node_restart_controller(WbNodeRef node);

/* --- fields. An index below 0 counts from the end. A value of another type than the field's is refused, with a
 * warning. What a getter returns is valid until the next question about that field --- */
WbFieldRef wb_supervisor_node_get_field(WbNodeRef node, const char *field_name);
WbFieldRef wb_supervisor_node_get_field_by_index(WbNodeRef node, int index);
int wb_supervisor_node_get_number_of_fields(WbNodeRef node);
/** The same fields: there are none that a PROTO hides. */
WbFieldRef wb_supervisor_node_get_proto_field(WbNodeRef node, const char *field_name);
WbFieldRef wb_supervisor_node_get_proto_field_by_index(WbNodeRef node, int index);
int wb_supervisor_node_get_proto_number_of_fields(WbNodeRef node);
WbFieldRef wb_supervisor_node_get_base_node_field(WbNodeRef node, const char *field_name);
WbFieldRef wb_supervisor_node_get_base_node_field_by_index(WbNodeRef node, int index);
int wb_supervisor_node_get_number_of_base_node_fields(WbNodeRef node);
WbFieldRef wb_supervisor_field_get_actual_field(WbFieldRef field);
const char *wb_supervisor_field_get_name(WbFieldRef field);
WbFieldType wb_supervisor_field_get_type(WbFieldRef field);
/** Such as "SFVec3f". */
const char *wb_supervisor_field_get_type_name(WbFieldRef field);
/** Members of a list; -1 of what is no list. */
int wb_supervisor_field_get_count(WbFieldRef field);
/** Nothing happens, as of nodes. */
void wb_supervisor_field_enable_sf_tracking(WbFieldRef field, int sampling_period);
void wb_supervisor_field_disable_sf_tracking(WbFieldRef field);

bool wb_supervisor_field_get_sf_bool(WbFieldRef field);
int wb_supervisor_field_get_sf_int32(WbFieldRef field);
double wb_supervisor_field_get_sf_float(WbFieldRef field);
const double *wb_supervisor_field_get_sf_vec2f(WbFieldRef field);
const double *wb_supervisor_field_get_sf_vec3f(WbFieldRef field);
const double *wb_supervisor_field_get_sf_rotation(WbFieldRef field);
const double *wb_supervisor_field_get_sf_color(WbFieldRef field);
const char *wb_supervisor_field_get_sf_string(WbFieldRef field);
WbNodeRef wb_supervisor_field_get_sf_node(WbFieldRef field);
bool wb_supervisor_field_get_mf_bool(WbFieldRef field, int index);
int wb_supervisor_field_get_mf_int32(WbFieldRef field, int index);
double wb_supervisor_field_get_mf_float(WbFieldRef field, int index);
const double *wb_supervisor_field_get_mf_vec2f(WbFieldRef field, int index);
const double *wb_supervisor_field_get_mf_vec3f(WbFieldRef field, int index);
const double *wb_supervisor_field_get_mf_rotation(WbFieldRef field, int index);
const double *wb_supervisor_field_get_mf_color(WbFieldRef field, int index);
const char *wb_supervisor_field_get_mf_string(WbFieldRef field, int index);
WbNodeRef wb_supervisor_field_get_mf_node(WbFieldRef field, int index);

void wb_supervisor_field_set_sf_bool(WbFieldRef field, bool value);
void wb_supervisor_field_set_sf_int32(WbFieldRef field, int value);
void wb_supervisor_field_set_sf_float(WbFieldRef field, double value);
void wb_supervisor_field_set_sf_vec2f(WbFieldRef field, const double values[2]);
void wb_supervisor_field_set_sf_vec3f(WbFieldRef field, const double values[3]);
void wb_supervisor_field_set_sf_rotation(WbFieldRef field, const double values[4]);
void wb_supervisor_field_set_sf_color(WbFieldRef field, const double values[3]);
void wb_supervisor_field_set_sf_string(WbFieldRef field, const char *value);
void wb_supervisor_field_set_mf_bool(WbFieldRef field, int index, bool value);
void wb_supervisor_field_set_mf_int32(WbFieldRef field, int index, int value);
void wb_supervisor_field_set_mf_float(WbFieldRef field, int index, double value);
void wb_supervisor_field_set_mf_vec2f(WbFieldRef field, int index, const double values[2]);
void wb_supervisor_field_set_mf_vec3f(WbFieldRef field, int index, const double values[3]);
void wb_supervisor_field_set_mf_rotation(WbFieldRef field, int index, const double values[4]);
void wb_supervisor_field_set_mf_color(WbFieldRef field, int index, const double values[3]);
void wb_supervisor_field_set_mf_string(WbFieldRef field, int index, const char *value);

/** Before the member of that index; -1: at the end. */
void wb_supervisor_field_insert_mf_bool(WbFieldRef field, int index, bool value);
void wb_supervisor_field_insert_mf_int32(WbFieldRef field, int index, int value);
void wb_supervisor_field_insert_mf_float(WbFieldRef field, int index, double value);
void wb_supervisor_field_insert_mf_vec2f(WbFieldRef field, int index, const double values[2]);
void wb_supervisor_field_insert_mf_vec3f(WbFieldRef field, int index, const double values[3]);
void wb_supervisor_field_insert_mf_rotation(WbFieldRef field, int index, const double values[4]);
void wb_supervisor_field_insert_mf_color(WbFieldRef field, int index, const double values[3]);
void wb_supervisor_field_insert_mf_string(WbFieldRef field, int index, const char *value);
void wb_supervisor_field_remove_mf(WbFieldRef field, int index);
void wb_supervisor_field_remove_mf_node(WbFieldRef field, int position);
void wb_supervisor_field_remove_sf(WbFieldRef field);
/** Nodes as in a world file of Webots, as a text or in a file of the program's folder. */
void wb_supervisor_field_import_mf_node(WbFieldRef field, int position, const char *filename);
void wb_supervisor_field_import_mf_node_from_string(WbFieldRef field, int position, const char *node_string);
void wb_supervisor_field_import_sf_node(WbFieldRef field, const char *filename);
void wb_supervisor_field_import_sf_node_from_string(WbFieldRef field, const char *node_string);

/* PROTOs are not told apart: NULL, "", false, -1 */
const char *wb_supervisor_proto_get_type_name(WbProtoRef proto);
bool wb_supervisor_proto_is_derived(WbProtoRef proto);
WbProtoRef wb_supervisor_proto_get_parent(WbProtoRef proto);
WbFieldRef wb_supervisor_proto_get_field(WbProtoRef proto, const char *field_name);
WbFieldRef wb_supervisor_proto_get_field_by_index(WbProtoRef proto, int index);
int wb_supervisor_proto_get_number_of_fields(WbProtoRef proto);

#ifdef __cplusplus
}
#endif
#endif
