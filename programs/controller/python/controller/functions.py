# SPDX-License-Identifier: MIT
"""The functions of libcontroller.so that this package calls, without `wb_`.

A line: the result, the name, the arguments. v nothing, i int, l long, t a device's tag, b bool, d double, s text,
p an address, B bytes, D numbers, I whole numbers. tests/programs/functions_test.py compares them with the headers of C.
"""

_TABLE = """
v twinpuck_language i s
i twinpuck_wait

i robot_init
i robot_step i
i robot_step_begin i
i robot_step_end
v robot_cleanup
d robot_get_time
d robot_get_basic_time_step
s robot_get_name
s robot_get_model
s robot_get_custom_data
v robot_set_custom_data s
s robot_get_project_path
s robot_get_world_path
s robot_get_urdf s
b robot_get_supervisor
b robot_get_synchronization
i robot_get_mode
v robot_set_mode i s
t robot_get_device s
i robot_get_number_of_devices
t robot_get_device_by_index i
v robot_battery_sensor_enable i
v robot_battery_sensor_disable
i robot_battery_sensor_get_sampling_period
d robot_battery_sensor_get_value
i robot_wait_for_user_input_event i i
v robot_wwi_send_text s
s robot_wwi_receive_text

s device_get_name t
s device_get_model t
i device_get_node_type t

v motor_set_position t d
v motor_set_velocity t d
v motor_set_acceleration t d
v motor_set_available_force t d
v motor_set_available_torque t d
v motor_set_control_pid t d d d
v motor_set_force t d
v motor_set_torque t d
d motor_get_target_position t
d motor_get_velocity t
d motor_get_acceleration t
d motor_get_min_position t
d motor_get_max_position t
d motor_get_max_velocity t
d motor_get_available_force t
d motor_get_max_force t
d motor_get_available_torque t
d motor_get_max_torque t
d motor_get_multiplier t
v motor_enable_force_feedback t i
v motor_disable_force_feedback t
i motor_get_force_feedback_sampling_period t
d motor_get_force_feedback t
v motor_enable_torque_feedback t i
v motor_disable_torque_feedback t
i motor_get_torque_feedback_sampling_period t
d motor_get_torque_feedback t
i motor_get_type t
t motor_get_brake t
t motor_get_position_sensor t

v position_sensor_enable t i
v position_sensor_disable t
i position_sensor_get_sampling_period t
d position_sensor_get_value t
i position_sensor_get_type t
t position_sensor_get_motor t
t position_sensor_get_brake t

v distance_sensor_enable t i
v distance_sensor_disable t
i distance_sensor_get_sampling_period t
d distance_sensor_get_value t
d distance_sensor_get_max_value t
d distance_sensor_get_min_value t
d distance_sensor_get_aperture t
i distance_sensor_get_lookup_table_size t
D distance_sensor_get_lookup_table t
i distance_sensor_get_type t

v light_sensor_enable t i
v light_sensor_disable t
i light_sensor_get_sampling_period t
d light_sensor_get_value t
i light_sensor_get_lookup_table_size t
D light_sensor_get_lookup_table t

v touch_sensor_enable t i
v touch_sensor_disable t
i touch_sensor_get_sampling_period t
d touch_sensor_get_value t
D touch_sensor_get_values t
i touch_sensor_get_lookup_table_size t
D touch_sensor_get_lookup_table t
i touch_sensor_get_type t

v led_set t l
i led_get t

v camera_enable t i
v camera_disable t
i camera_get_sampling_period t
p camera_get_image t
i camera_get_width t
i camera_get_height t
d camera_get_fov t
d camera_get_max_fov t
d camera_get_min_fov t
v camera_set_fov t d
d camera_get_near t
d camera_get_exposure t
v camera_set_exposure t d
d camera_get_focal_length t
d camera_get_focal_distance t
d camera_get_max_focal_distance t
d camera_get_min_focal_distance t
v camera_set_focal_distance t d
i camera_save_image t s i
b camera_has_recognition t
v camera_recognition_enable t i
v camera_recognition_disable t
i camera_recognition_get_sampling_period t
i camera_recognition_get_number_of_objects t
p camera_recognition_get_objects t
b camera_recognition_has_segmentation t
v camera_recognition_enable_segmentation t
v camera_recognition_disable_segmentation t
b camera_recognition_is_segmentation_enabled t
p camera_recognition_get_segmentation_image t
i camera_recognition_save_segmentation_image t s i

v accelerometer_enable t i
v accelerometer_disable t
i accelerometer_get_sampling_period t
D accelerometer_get_values t
i accelerometer_get_lookup_table_size t
D accelerometer_get_lookup_table t

v gyro_enable t i
v gyro_disable t
i gyro_get_sampling_period t
D gyro_get_values t
i gyro_get_lookup_table_size t
D gyro_get_lookup_table t

v lidar_enable t i
v lidar_disable t
i lidar_get_sampling_period t
p lidar_get_range_image t
d lidar_get_fov t
d lidar_get_min_range t
d lidar_get_max_range t
p lidar_get_layer_range_image t i
v lidar_enable_point_cloud t
v lidar_disable_point_cloud t
b lidar_is_point_cloud_enabled t
p lidar_get_point_cloud t
p lidar_get_layer_point_cloud t i
i lidar_get_number_of_points t
i lidar_get_horizontal_resolution t
i lidar_get_number_of_layers t
d lidar_get_vertical_fov t
d lidar_get_frequency t
d lidar_get_min_frequency t
d lidar_get_max_frequency t
v lidar_set_frequency t d

v range_finder_enable t i
v range_finder_disable t
i range_finder_get_sampling_period t
p range_finder_get_range_image t
d range_finder_get_fov t
d range_finder_get_min_range t
d range_finder_get_max_range t
i range_finder_get_width t
i range_finder_get_height t
i range_finder_save_image t s i

v compass_enable t i
v compass_disable t
i compass_get_sampling_period t
D compass_get_values t
i compass_get_lookup_table_size t
D compass_get_lookup_table t

v gps_enable t i
v gps_disable t
i gps_get_sampling_period t
D gps_get_values t
d gps_get_speed t
D gps_get_speed_vector t
i gps_get_coordinate_system t

v inertial_unit_enable t i
v inertial_unit_disable t
i inertial_unit_get_sampling_period t
D inertial_unit_get_roll_pitch_yaw t
D inertial_unit_get_quaternion t
d inertial_unit_get_noise t

i emitter_send t B i
v emitter_set_channel t i
i emitter_get_channel t
v emitter_set_range t d
d emitter_get_range t
i emitter_get_buffer_size t

v receiver_enable t i
v receiver_disable t
i receiver_get_sampling_period t
i receiver_get_queue_length t
v receiver_next_packet t
i receiver_get_data_size t
p receiver_get_data t
d receiver_get_signal_strength t
D receiver_get_emitter_direction t
v receiver_set_channel t i
i receiver_get_channel t

v microphone_enable t i
v microphone_disable t
i microphone_get_sampling_period t
p microphone_get_sample_data t
i microphone_get_sample_size t

v speaker_play_sound t t s d d d b
v speaker_stop t s
b speaker_is_sound_playing t s
b speaker_set_engine t s
b speaker_set_language t s
s speaker_get_engine t
s speaker_get_language t
b speaker_is_speaking t
v speaker_speak t s d

i display_get_width t
i display_get_height t
v display_set_color t l
v display_set_alpha t d
v display_set_opacity t d
v display_set_font t s i b
v display_attach_camera t t
v display_detach_camera t
v display_draw_pixel t i i
v display_draw_line t i i i i
v display_draw_rectangle t i i i i
v display_draw_oval t i i i i
v display_draw_polygon t I I i
v display_draw_text t s i i
v display_fill_rectangle t i i i i
v display_fill_oval t i i i i
v display_fill_polygon t I I i
p display_image_new t i i B i
p display_image_copy t i i i i
v display_image_paste t p i i b
p display_image_load t s
v display_image_save t p s
v display_image_delete t p

v keyboard_enable i
v keyboard_disable
i keyboard_get_sampling_period
l keyboard_get_key

v differential_wheels_set_speed d d
d differential_wheels_get_left_speed
d differential_wheels_get_right_speed
v differential_wheels_enable_encoders i
v differential_wheels_disable_encoders
i differential_wheels_get_encoders_sampling_period
d differential_wheels_get_left_encoder
d differential_wheels_get_right_encoder
v differential_wheels_set_encoders d d
d differential_wheels_get_max_speed
d differential_wheels_get_speed_unit

p supervisor_node_get_root
p supervisor_node_get_self
p supervisor_node_get_from_def s
p supervisor_node_get_from_id i
p supervisor_node_get_from_device t
p supervisor_node_get_from_proto_def p s
p supervisor_node_get_selected
p supervisor_node_get_parent_node p
i supervisor_node_get_id p
i supervisor_node_get_type p
s supervisor_node_get_def p
s supervisor_node_get_type_name p
s supervisor_node_get_base_type_name p
b supervisor_node_is_proto p
s supervisor_node_export_string p
p supervisor_node_get_field p s
p supervisor_node_get_field_by_index p i
i supervisor_node_get_number_of_fields p
p supervisor_node_get_proto_field p s
p supervisor_node_get_proto_field_by_index p i
i supervisor_node_get_proto_number_of_fields p
D supervisor_node_get_position p
D supervisor_node_get_orientation p
D supervisor_node_get_pose p p
D supervisor_node_get_center_of_mass p
p supervisor_node_get_contact_points p b p
b supervisor_node_get_static_balance p
D supervisor_node_get_velocity p
v supervisor_node_set_velocity p D
v supervisor_node_reset_physics p
v supervisor_node_restart_controller p
v supervisor_node_remove p
v supervisor_node_save_state p s
v supervisor_node_load_state p s
v supervisor_node_set_joint_position p d i
v supervisor_node_move_viewpoint p
v supervisor_node_set_visibility p p b
v supervisor_node_add_force p D b
v supervisor_node_add_force_with_offset p D D b
v supervisor_node_add_torque p D b

s supervisor_field_get_name p
i supervisor_field_get_type p
s supervisor_field_get_type_name p
i supervisor_field_get_count p
b supervisor_field_get_sf_bool p
i supervisor_field_get_sf_int32 p
d supervisor_field_get_sf_float p
D supervisor_field_get_sf_vec2f p
D supervisor_field_get_sf_vec3f p
D supervisor_field_get_sf_rotation p
D supervisor_field_get_sf_color p
s supervisor_field_get_sf_string p
p supervisor_field_get_sf_node p
b supervisor_field_get_mf_bool p i
i supervisor_field_get_mf_int32 p i
d supervisor_field_get_mf_float p i
D supervisor_field_get_mf_vec2f p i
D supervisor_field_get_mf_vec3f p i
D supervisor_field_get_mf_rotation p i
D supervisor_field_get_mf_color p i
s supervisor_field_get_mf_string p i
p supervisor_field_get_mf_node p i
v supervisor_field_set_sf_bool p b
v supervisor_field_set_sf_int32 p i
v supervisor_field_set_sf_float p d
v supervisor_field_set_sf_vec2f p D
v supervisor_field_set_sf_vec3f p D
v supervisor_field_set_sf_rotation p D
v supervisor_field_set_sf_color p D
v supervisor_field_set_sf_string p s
v supervisor_field_set_mf_bool p i b
v supervisor_field_set_mf_int32 p i i
v supervisor_field_set_mf_float p i d
v supervisor_field_set_mf_vec2f p i D
v supervisor_field_set_mf_vec3f p i D
v supervisor_field_set_mf_rotation p i D
v supervisor_field_set_mf_color p i D
v supervisor_field_set_mf_string p i s
v supervisor_field_insert_mf_bool p i b
v supervisor_field_insert_mf_int32 p i i
v supervisor_field_insert_mf_float p i d
v supervisor_field_insert_mf_vec2f p i D
v supervisor_field_insert_mf_vec3f p i D
v supervisor_field_insert_mf_rotation p i D
v supervisor_field_insert_mf_color p i D
v supervisor_field_insert_mf_string p i s
v supervisor_field_remove_mf p i
v supervisor_field_remove_sf p
v supervisor_field_import_mf_node_from_string p i s
v supervisor_field_import_sf_node_from_string p s

v supervisor_set_label i s d d d i d s
v supervisor_export_image s i
v supervisor_simulation_quit i
v supervisor_simulation_reset
v supervisor_simulation_reset_physics
i supervisor_simulation_get_mode
v supervisor_simulation_set_mode i
v supervisor_world_load s
v supervisor_world_reload
b supervisor_world_save s
b supervisor_animation_start_recording s
b supervisor_animation_stop_recording
v supervisor_movie_start_recording s i i i i i b
v supervisor_movie_stop_recording
b supervisor_movie_is_ready
b supervisor_movie_failed
"""

FUNCTIONS = {}
for _line in _TABLE.splitlines():
    if _line:
        _result, _name, *_arguments = _line.split()
        FUNCTIONS[_name] = (_result, tuple(_arguments))
