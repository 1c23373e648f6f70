// SPDX-License-Identifier: MIT
// The e-puck's body for the world; every number is epuck_params.h's. Sensors look level: the few degrees by
// which some models tilt them upwards are part of the profiles, which were measured on walls.
#include "hal_sim/board/epuck_model.h"

#include "hal_sim/board/battery_params.h"
#include "hal_sim/board/epuck_params.h"

namespace board {

sim::RobotModel epuck_model() {
  sim::RobotModel model;
  // Body, wheels, battery.
  model.name = "e-puck";
  model.body_radius_m = kBodyRadiusM;
  model.body_z0_m = kBodyUndersideM;
  model.body_height_m = kBodyTopM;
  model.mass_kg = kMassKg;
  model.centre_of_mass_m = {0, 0, kCentreOfMassZM};
  model.inertia_kg_m2 = kInertiaKgM2;
  model.wheel_radius_m = kWheelRadiusM;
  model.axle_m = kAxleM;
  model.steps_per_turn = kStepsPerTurn;
  model.battery_wh = kBatteryWh;
  // Sensors, and LEDs: the ring, then body and front.
  for (const SensorPlace& place : kProximity)
    model.proximity.push_back({{place.x_m, place.y_m, kProximityZM}, sim::radians(place.yaw_deg), 0});
  const sim::Colour red{1, 0.1, 0.1}, green{0.1, 1, 0.1};
  for (const Place& place : kRingLeds) model.leds.push_back({{place.x_m, place.y_m}, red});
  for (sim::LedMount& led : model.leds) led.z_m = kRingLedZM, led.spot_m = kRingLedSpotM;
  model.leds.push_back({{kBodyLed.x_m, kBodyLed.y_m}, green});
  model.leds.push_back({{kFrontLed.x_m, kFrontLed.y_m}, red, kFrontLedZM, kFrontLedSpotM});
  // What a world file may say of an e-puck alone.
  using Type = sim::OwnKeyType;
  model.keys = {
      {"selector", Type::Integer, "", 0, 15, "", "0", "position of the selector switch"},
      {"revision", Type::Choice, "", 0, 0, "1.1|1.3", "\"1.1\"",
       "of its hardware; 1.3 has another accelerometer, a gyroscope and a battery channel"},
      {"camera", Type::Choice, "", 0, 0, "po3030k|po6030k|po8030d|none", "",
       "image sensor; without it the usual one of the robot's revision"},
      {"camera_mount", Type::Choice, "", 0, 0, "upright|sideways|inverted", "\"upright\"",
       "how the sensor sits: upright pictures with the library's own settings, turned by a quarter as on "
       "many "
       "robots of the first series, or by a half"},
      {"camera_noise", Type::Number, "", 0, 100, "", "1", "factor on the camera's noise; 0 switches it off"},
  };
  return model;
}

void set_up(Setup& setup, const sim::OwnSettings& own) {
  setup.selector = own.integer("selector");
  if (own.text("revision") == "1.3") setup.revision = Revision::Rev13;
  const std::string camera = own.text("camera"), mount = own.text("camera_mount");
  setup.camera = camera == "none"      ? CameraKind::None
                 : camera == "po3030k" ? CameraKind::Po3030k
                 : camera == "po6030k" ? CameraKind::Po6030k
                 : camera == "po8030d" ? CameraKind::Po8030d
                                       : usual_camera(setup.revision);
  setup.camera_mount = mount == "sideways"   ? CameraMount::Sideways
                       : mount == "inverted" ? CameraMount::Inverted
                                             : CameraMount::Upright;
  setup.camera_noise = own.number("camera_noise");
}

}  // namespace board
