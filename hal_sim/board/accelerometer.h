// SPDX-License-Identifier: MIT
// The analogue accelerometer of robots before revision 1.3 (MMA7260QT) on AN5 to AN7.
//
//   AN5 = x: specific force to the left     AN6 = y: forward     AN7 = z: up      (at rest 0, 0, 1 g)
//
// These signs are the library's: e_display_angle() lights the LED on the lowest side. Forward is lower: y <
// 0. Modelled: scale, zero, calibration offset, the part's one-pole filters, noise per sample, its output
// range, the converter's. It feels the body's motion one tick of the world ago, so that a sample has one
// value whenever it is worked out. Not modelled: cross-axis sensitivity, drift with temperature, g-range
// switching, its place off the robot's origin (unknown). Source: [MMA7260QT], [lib:
// a_d/advance_ad_scan/e_acc.c], facts restated.
#pragma once
#include "hal_sim/board/motion_params.h"
#include "sim_core/world/true_motion.h"

namespace board {

class Specimen;

/// Specific force in the robot's frame (m/s2) after a filter with one pole, as a sensor feels it at `at`;
/// (0, 0, 9.81) without a scene. Offsets of the robot's variation included.
sim::Vec3 felt_force_m_s2(const Specimen& robot, Cycle at, double pole_hz);
/// Angular rate about the robot's axes (rad/s), the same way; zero without a scene.
sim::Vec3 felt_turn_rad_s(const Specimen& robot, Cycle at, double pole_hz);

/// One conversion of axis 0 x, 1 y, 2 z, held at `at`, counts 0 to 4095.
int accelerometer_counts(const Specimen& robot, int axis, Cycle at);
/// The outputs stand still from `at` on (before revision 1.3 at the counts they have then), or do no longer.
void stick_accelerometer(Specimen& robot, bool is, Cycle at);

}  // namespace board
