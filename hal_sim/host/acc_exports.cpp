// SPDX-License-Identifier: MIT
// The functions of pins_acc.h on the board.
#include <cstring>

#include "hal_sim/board/board.h"
#include "hal_sim/board/motion_params.h"
#include "hal_sim/drivers/drivers.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_acc.h"

using board::Cycle;
using host::Context;

extern "C" {

void tp_scan_acc_values(void* samples) {
  Context& context = Context::current();
  drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  const drivers::AdcScan::AccRing& ring = scan.acc_scan(now);
  static_assert(sizeof ring == 3 * drivers::kAccSamples * 2, "e_acc_scan's layout");
  std::memcpy(samples, &ring, sizeof ring);
  context.lower_horizon(scan.acc_until(now));
}

tp_i64 tp_scan_acc_newest(tp_i64 axis) {
  if (axis < 0 || axis > 2) return 0;
  Context& context = Context::current();
  drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  context.lower_horizon(scan.acc_until(now));
  return scan.acc_scan(now)[static_cast<std::size_t>(axis)]
                           [static_cast<std::size_t>(scan.acc_samples(now) % drivers::kAccSamples)];
}

tp_i64 tp_scan_acc_index_until_next(void) {
  Context& context = Context::current();
  const drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  context.lower_horizon(scan.acc_until(now));
  return scan.acc_samples(now) % drivers::kAccSamples;
}

void tp_scan_ir_values(void* dark, void* lit) {
  Context& context = Context::current();
  drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  tp_scan_values(dark, lit);
  for (int sensor = 0; sensor < board::kRingSensors; ++sensor)
    context.lower_horizon(scan.horizon(sensor, now));
}

tp_i64 tp_scan_starts(void) { return Context::current().drivers().scan().starts(); }

tp_i64 tp_lsm330_answers(void) {
  Context& context = Context::current();
  board::I2cBus& bus = context.board().i2c();
  const Cycle now = context.now();
  context.note_write();
  if (!bus.find(board::kLsmAccAddress)) return 0;  // where nobody would answer the bus stays as it is: unused
  bus.start(now);
  bus.write(board::kLsmAccAddress, now);
  bus.write(board::kLsmWhoAmI, now);
  bus.start(now);
  bus.write(board::kLsmAccAddress | 1, now);
  const bool answers = bus.read(now) == board::kLsmAccWho;
  bus.stop(now);
  context.note_write();
  return answers ? 1 : 0;
}

}  // extern "C"
