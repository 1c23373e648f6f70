// SPDX-License-Identifier: MIT
// See robot_lacks.h.
#include "robot_lacks.h"

#include <array>

namespace cc {
namespace {

struct Lack {
  const char* prefix;  // of functions of today; those of 2005 begin without wb_
  const char* what;
  const char* instead;
};

constexpr const char* kNoRadioDetail = "the radio turret does not tell from where and how strongly it hears";
constexpr const char* kNoWorld = "an e-puck cannot ask or change the world";
constexpr const char* kBySupervisor =
    "leave that to a supervisor, a program of the PC, and run this one there, too";

// the first that fits counts: longer prefixes go before shorter ones
constexpr std::array kLacks = {
    Lack{"wb_gps_", "an e-puck has no GPS", "count the steps of its wheels with a position sensor"},
    Lack{"wb_compass_", "an e-puck has no compass", "count the steps of its wheels from a known direction"},
    Lack{"wb_inertial_unit_", "an e-puck has no inertial unit",
         "its accelerometer tells how it leans, the steps of its wheels where it looks"},
    Lack{"wb_supervisor_", kNoWorld, kBySupervisor},
    Lack{"wb_display_", "an e-puck has no display", "use its LEDs, or printf(), which writes to UART 1"},
    Lack{"wb_robot_keyboard_", "an e-puck has no keyboard",
         "use its selector, getselector() of utility/utility.h"},
    Lack{"wb_keyboard_", "an e-puck has no keyboard", "use its selector, getselector() of utility/utility.h"},
    Lack{"wb_mouse_", "an e-puck has no mouse", "use its selector, getselector() of utility/utility.h"},
    Lack{"wb_joystick_", "an e-puck has no joystick", "use its selector, getselector() of utility/utility.h"},
    Lack{"wb_camera_recognition_", "an e-puck's camera recognises nothing",
         "look for colours in its picture"},
    Lack{"wb_camera_has_recognition", "an e-puck's camera recognises nothing",
         "look for colours in its picture"},
    Lack{"wb_camera_save_image", "an e-puck has no files", "look at the picture where it is taken"},
    Lack{"wb_camera_", "an e-puck's camera has no such setting", "leave it out"},
    Lack{"wb_touch_sensor_", "an e-puck has no touch sensor",
         "use a proximity sensor, or the accelerometer, which feels bumps"},
    Lack{"wb_receiver_get_signal_strength", kNoRadioDetail, "send a robot's place in the packet"},
    Lack{"wb_receiver_get_emitter_direction", kNoRadioDetail, "send a robot's place in the packet"},
    Lack{"wb_receiver_", "the radio turret cannot do this", "leave it out"},
    Lack{"wb_emitter_set_range", "the radio turret knows no range",
         "SetSoftwareAttenuator() makes it weaker"},
    Lack{"wb_emitter_get_range", "the radio turret knows no range", "leave it out"},
    Lack{"wb_emitter_", "the radio turret cannot do this", "leave it out"},
    Lack{"wb_range_finder_", "an e-puck has no range finder", "use its proximity sensors"},
    Lack{"wb_lidar_", "an e-puck has no lidar", "use its proximity sensors"},
    Lack{"wb_radar_", "an e-puck has no radar", "use its proximity sensors"},
    Lack{"wb_altimeter_", "an e-puck has no altimeter", "it drives on the floor"},
    Lack{"wb_pen_", "an e-puck has no pen", "leave it out"},
    Lack{"wb_connector_", "an e-puck has no connector", "leave it out"},
    Lack{"wb_servo_", "an e-puck has no servo",
         "its wheels are set by webots/motor.h or differential_wheels.h"},
    Lack{"wb_brake_", "an e-puck has no brake", "its motors stand by themselves"},
    Lack{"wb_muscle_", "an e-puck has no muscle", "leave it out"},
    Lack{"wb_skin_", "an e-puck cannot change its looks", "use its LEDs"},
    Lack{"wb_vacuum_gripper_", "an e-puck has no gripper", "leave it out"},
    Lack{"wb_gripper_", "an e-puck has no gripper", "leave it out"},
    Lack{"wb_motor_", "an e-puck's wheels are stepper motors, which feel no force", "leave it out"},
    Lack{"wb_speaker_", "an e-puck's loudspeaker plays the five sounds that it stores",
         "wb_speaker_play_sound()"},
    Lack{"wb_robot_window_", "an e-puck has no window", "use its LEDs, or printf(), which writes to UART 1"},
    Lack{"wb_robot_wwi_", "an e-puck has no window", "use its LEDs, or printf(), which writes to UART 1"},
    Lack{"wb_robot_task_", "an e-puck runs one program", "use an agenda, e_activate_agenda()"},
    Lack{"wb_robot_mutex_", "an e-puck runs one program", "use an agenda, e_activate_agenda()"},
    Lack{"wb_remote_control_", "an e-puck is no remote control of another one", "leave it out"},
    Lack{"wbu_motion_", "an e-puck has no files of motions", "set its wheels' speeds"},
    Lack{"wb_motion_", "an e-puck has no files of motions", "set its wheels' speeds"},
};

/// Functions of a PC's library, by their whole names.
constexpr std::array kOfThePc = {
    Lack{"fopen", "an e-puck has no files", "printf() writes to UART 1"},
    Lack{"freopen", "an e-puck has no files", "printf() writes to UART 1"},
    Lack{"fclose", "an e-puck has no files", "printf() writes to UART 1"},
    Lack{"fread", "an e-puck has no files", "declare what the program needs as a const array"},
    Lack{"fgets", "an e-puck has no files", "declare what the program needs as a const array"},
    Lack{"fgetc", "an e-puck has no files", "declare what the program needs as a const array"},
    Lack{"fscanf", "an e-puck has no files", "declare what the program needs as a const array"},
    Lack{"feof", "an e-puck has no files", "declare what the program needs as a const array"},
    Lack{"fwrite", "an e-puck has no files", "printf() writes to UART 1"},
    Lack{"fseek", "an e-puck has no files", "leave it out"},
    Lack{"ftell", "an e-puck has no files", "leave it out"},
    Lack{"rewind", "an e-puck has no files", "leave it out"},
    Lack{"remove", "an e-puck has no files", "leave it out"},
    Lack{"rename", "an e-puck has no files", "leave it out"},
    Lack{"getchar", "an e-puck has no keyboard", "e_getchar_uart1() of uart/e_uart_char.h reads UART 1"},
    Lack{"gets", "an e-puck has no keyboard", "e_getchar_uart1() of uart/e_uart_char.h reads UART 1"},
    Lack{"scanf", "an e-puck has no keyboard",
         "e_getchar_uart1() of uart/e_uart_char.h reads UART 1, sscanf() what it has read"},
    Lack{"sleep", "an e-puck has no operating system", "time passes in the robot's step"},
    Lack{"usleep", "an e-puck has no operating system", "time passes in the robot's step"},
    Lack{"system", "an e-puck has no operating system", "leave it out"},
    Lack{"getenv", "an e-puck has no operating system",
         "use its selector, getselector() of utility/utility.h"},
    Lack{"clock", "an e-puck has no such clock", "use wb_robot_get_time()"},
    Lack{"gettimeofday", "an e-puck has no calendar", "use wb_robot_get_time()"},
};

bool begins(const std::string& text, const std::string& head) { return text.rfind(head, 0) == 0; }

}  // namespace

std::string what_the_robot_lacks(const std::string& function) {
  for (const Lack& lack : kLacks) {
    const std::string prefix = lack.prefix;
    const bool fits =
        begins(function, prefix) || (begins(prefix, "wb_") && begins(function, prefix.substr(3)));
    if (fits) return std::string(lack.what) + "; " + lack.instead;
  }
  for (const Lack& lack : kOfThePc)
    if (function == lack.prefix) return std::string(lack.what) + "; " + lack.instead;
  return "";
}

}  // namespace cc
