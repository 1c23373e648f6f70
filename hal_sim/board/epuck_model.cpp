// SPDX-License-Identifier: MIT
// The e-puck's body for the world; every number is epuck_params.h's. Sensors look level: the few degrees by
// which some models tilt them upwards are part of the profiles, which were measured on walls.
#include "hal_sim/board/epuck_model.h"

#include "hal_sim/board/battery_params.h"
#include "hal_sim/board/epuck_params.h"

namespace board {

sim::RobotModel epuck_model() {
  sim::RobotModel model;
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
  for (const SensorPlace& place : kProximity)
    model.proximity.push_back({{place.x_m, place.y_m, kProximityZM}, sim::radians(place.yaw_deg), 0});
  const sim::Colour red{1, 0.1, 0.1}, green{0.1, 1, 0.1};
  for (const Place& place : kRingLeds) model.leds.push_back({{place.x_m, place.y_m}, red});
  for (sim::LedMount& led : model.leds) led.z_m = kRingLedZM, led.spot_m = kRingLedSpotM;
  model.leds.push_back({{kBodyLed.x_m, kBodyLed.y_m}, green});
  model.leds.push_back({{kFrontLed.x_m, kFrontLed.y_m}, red, kFrontLedZM, kFrontLedSpotM});
  return model;
}

}  // namespace board
