// SPDX-License-Identifier: MIT
// See original_objects.h.
#include "original_objects.h"

#include <algorithm>

#include "sim_core/base/words.h"

namespace cc {
namespace {

struct OriginalObject {
  const char* source;  // its place in the library
  const char* functions;
  const char* later = "";  // those that older copies do not have
};

#define TP_BASIC_LEDS "e_set_led e_led_clear e_set_body_led e_set_front_led"
#define TP_LEDS                                                                                             \
  TP_BASIC_LEDS                                                                                             \
  " e_blink_led e_blink_led0 e_blink_led1 e_blink_led2 e_blink_led3 e_blink_led4 e_blink_led5 e_blink_led6" \
  " e_blink_led7 e_start_led_blinking e_stop_led_blinking e_set_blinking_cycle"
#define TP_MOTORS                                                                                        \
  "e_init_motors e_set_speed_left e_set_speed_right e_get_steps_left e_get_steps_right e_set_steps_left" \
  " e_set_steps_right"
#define TP_AGENDAS                                                                         \
  "e_start_agendas_processing e_end_agendas_processing e_activate_agenda e_destroy_agenda" \
  " e_set_agenda_cycle e_reset_agenda e_pause_agenda e_restart_agenda _T2Interrupt"

// gctronic/e-puck-library 4cb85cb; what is later, by the copies that a survey counted
constexpr OriginalObject kOriginals[] = {
    {"motor_led/e_init_port.c", "e_init_port", "isEpuckVersion1_3"},
    {"motor_led/e_led.c", TP_BASIC_LEDS},
    {"motor_led/advance_one_timer/e_led.c", TP_LEDS, "flow_led snake_led k2000_led right_led left_led"},
    {"motor_led/advance_one_timer/fast_agenda/e_led.c", TP_LEDS},
    {"motor_led/e_motors.c", TP_MOTORS " _T4Interrupt _T5Interrupt"},
    {"motor_led/e_motors_timer3.c", TP_MOTORS " _T3Interrupt"},
    {"motor_led/advance_one_timer/e_motors.c", TP_MOTORS, "e_set_speed"},
    {"motor_led/advance_one_timer/fast_agenda/e_motors.c", TP_MOTORS " e_set_speed"},
    {"motor_led/advance_one_timer/e_agenda.c", TP_AGENDAS},
    {"motor_led/advance_one_timer/fast_agenda/e_agenda_fast.c",
     TP_AGENDAS " _T1Interrupt _T3Interrupt e_start_timer_processing e_configure_timer e_activate_motors "
                "e_set_motor_speed"},
    {"motor_led/advance_one_timer/e_remote_control.c",
     "e_init_remote_control e_get_check e_get_address e_get_data _INT0Interrupt", "e_read_remote_control"},
    {"a_d/advance_ad_scan/e_ad_conv.c",
     "e_init_ad_scan e_ad_is_array_filled e_ad_scan_on e_ad_scan_off _ADCInterrupt",
     "e_ad_is_acquisition_completed"},
    {"a_d/e_ad_conv.c", "e_init_ad e_read_ad"},
    {"a_d/advance_ad_scan/e_prox.c", "e_calibrate_ir e_get_prox e_get_calibrated_prox e_get_ambient_light"},
    {"a_d/e_prox.c", "e_init_prox e_stop_prox e_get_prox e_get_ambient_light _T1Interrupt"},
    {"a_d/e_prox_timer2.c", "e_init_prox e_stop_prox e_get_prox e_get_ambient_light _T2Interrupt"},
    {"a_d/advance_ad_scan/e_acc.c",
     "e_get_acc e_get_acc_filtered e_read_acc_spheric e_read_orientation e_read_inclination e_read_acc"
     " e_read_acc_xyz e_read_acc_x e_read_acc_y e_read_acc_z e_acc_calibr",
     "e_display_angle"},
    {"a_d/e_accelerometer.c", "e_init_acc e_get_acc"},
    {"a_d/advance_ad_scan/e_micro.c",
     "e_get_micro e_get_micro_average e_get_micro_volume e_get_micro_last_values"},
    {"a_d/e_micro.c", "e_init_micro e_get_micro"},
    {"uart/e_uart1_rx_char.s", "e_ischar_uart1 e_getchar_uart1 _U1RXInterrupt"},
    {"uart/e_uart1_tx_char.s", "e_send_uart1_char e_uart1_sending _U1TXInterrupt"},
    {"uart/e_uart2_rx_char.s", "e_ischar_uart2 e_getchar_uart2 _U2RXInterrupt"},
    {"uart/e_uart2_tx_char.s", "e_send_uart2_char e_uart2_sending _U2TXInterrupt"},
    {"codec/e_sound.c", "e_init_sound e_play_sound e_close_sound"},
    {"I2C/e_I2C_master_module.c",
     "e_i2c_init e_i2c_reset e_i2c_enable e_i2c_disable e_i2c_start e_i2c_restart e_i2c_stop e_i2c_ack "
     "e_i2c_nack"
     " e_i2c_read e_i2c_write _MI2CInterrupt",
     "e_i2c_deinit"},
    {"I2C/e_I2C_protocol.c", "e_i2cp_init e_i2cp_enable e_i2cp_disable e_i2cp_read e_i2cp_write",
     "e_i2cp_deinit e_i2cp_read_string e_i2cp_write_string"},
    {"camera/fast_2_timer/e_common.c",
     "e_poxxxx_init_cam e_poxxxx_config_cam e_poxxxx_set_mirror e_poxxxx_write_cam_registers",
     "e_poxxxx_get_orientation e_poxxxx_set_awb_ae e_poxxxx_set_rgb_gain e_poxxxx_set_exposure "
     "getCameraVersion"},
    {"camera/fast_2_timer/e_timers.c",
     "e_poxxxx_launch_capture e_poxxxx_is_img_ready e_poxxxx_apply_timer_config _T5Interrupt"},
    {"acc_gyro/e_lsm330.c",
     "initAccAndGyro getXAxisGyro getYAxisGyro getZAxisGyro getAllAxesGyro calibrateGyroscope getTemperature",
     "getXAxisAcc getYAxisAcc getZAxisAcc getAllAxesAcc getAllAxesAccRaw getAllAxesGyroRaw rawToDps "
     "rawToDpms"},
    {"bluetooth/e_bluetooth.c",
     "e_bt_find_epuck e_bt_connect_epuck e_bt_read_local_pin_number e_bt_read_local_name"
     " e_bt_write_local_pin_number e_bt_write_local_name e_bt_etablish_SPP_link e_bt_release_SPP_link"
     " e_bt_send_SPP_data e_bt_tranparent_mode e_bt_exit_tranparent_mode e_bt_list_local_paired_device"
     " e_bt_remove_local_paired_device e_bt_inquiry e_bt_get_friendly_name e_bt_reset e_bt_factory_reset",
     "e_bt_set_event_filter e_bt_get_event_filter"},
    {"matlab/matlab.c",
     "e_send_int_to_matlab e_send_char_to_matlab e_receive_int_from_matlab e_receive_char_from_matlab"},
    {"utility/utility.c", "wait getselector",
     "getBatteryValueRaw getBatteryValuePercentage getDiffTimeMs getDiffTimeMsAndReset resetTime"},
};

/// The first that the program calls and has not, and the file that does; null for none.
const std::pair<const std::string, std::string>* needed_of(const std::vector<std::string>& names,
                                                           const FormOfSource& form,
                                                           const ProgramFunctions& program,
                                                           std::string& name) {
  for (const std::string& one : names)
    for (const std::string& prefix : form.prefixes)
      if (const auto who = program.wanted.find(prefix + one);
          who != program.wanted.end() && !program.defined.count(one)) {
        name = one;
        return &*who;
      }
  return nullptr;
}

}  // namespace

std::vector<std::string> second_definitions(const ProgramFunctions& program,
                                            const std::vector<DriverChoice>& choices) {
  std::vector<std::string> messages;
  for (const OriginalObject& original : kOriginals) {
    const FormOfSource form = form_of_source(original.source, choices);
    std::vector<std::string> all = sim::words_of(original.functions);
    const auto twice = std::find_if(all.begin(), all.end(),
                                    [&](const std::string& name) { return program.own.count(name); });
    if (!form.is_linked || twice == all.end()) continue;
    const std::string name = *twice;
    for (const std::string& later : sim::words_of(original.later)) all.push_back(later);
    std::string needed;
    if (const auto* call = needed_of(all, form, program, needed))
      messages.push_back(program.own.at(name) + ": error: " + name +
                         "(): got a second definition, expected one; the library's " + original.source +
                         " has it too and is linked for " + needed + "(), which " + call->second +
                         " calls: the robot's linker refuses that; define " + needed +
                         "() as well, or give your function another name");
  }
  return messages;
}

}  // namespace cc
