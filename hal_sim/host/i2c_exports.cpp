// SPDX-License-Identifier: MIT
// The functions of pins_i2c.h on the drivers' master module.
#include "hal_sim/drivers/drivers.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_i2c.h"

namespace {

using drivers::I2cMaster;
using host::Context;

/// What a reading function sees: everything that is over by now, and until when it stays so.
I2cMaster& look(Context& context) {
  I2cMaster& master = context.drivers().i2c_master();
  const host::Cycle now = context.now();
  master.settle(now);
  if (master.busy_until() > now) context.lower_horizon(master.busy_until());
  return master;
}

}  // namespace

extern "C" {

void tp_i2c_switch(tp_i64 brg) {
  Context& context = Context::current();
  I2cMaster& master = context.drivers().i2c_master();
  if (brg < 0)
    master.switch_off(context.now());
  else
    master.switch_on(static_cast<int>(brg), context.now());
  context.irq_at(TP_V_MI2C, -1);
  context.note_write();
}

tp_i64 tp_i2c_begin(tp_i64 operation, tp_i64 byte) {
  Context& context = Context::current();
  if (operation < TP_I2C_START || operation > TP_I2C_WRITE) return -1;
  const host::Cycle over = context.drivers().i2c_master().begin(
      static_cast<I2cMaster::Operation>(operation), static_cast<std::uint8_t>(byte), context.now());
  if (over >= 0) context.irq_at(TP_V_MI2C, over);
  context.note_write();
  return over;
}

tp_i64 tp_i2c_busy_until(void) { return look(Context::current()).busy_until(); }

tp_i64 tp_i2c_started(void) { return look(Context::current()).is_started() ? 1 : 0; }

tp_i64 tp_i2c_stopped(void) { return look(Context::current()).is_stopped() ? 1 : 0; }

tp_i64 tp_i2c_received(void) { return look(Context::current()).received(); }

tp_i64 tp_i2c_acknowledged(void) { return look(Context::current()).is_acknowledged() ? 1 : 0; }

}  // extern "C"
