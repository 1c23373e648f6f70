// SPDX-License-Identifier: MIT
// The functions of image_abi.h and the time and interrupt part of pins.h, as firmware images call them.
#include <string>

#include "hal_sim/host/compiled_runner.h"
#include "hal_sim/host/pins.h"
#include "sim_core/base/check.h"

using host::CompiledRunner;

namespace {
CompiledRunner& runner() {
  CompiledRunner* r = CompiledRunner::running();
  CHECK(r, "a firmware function was called outside firmware");
  return *r;
}

/// What only our own code in the image passes: it is wrong when the program has written over our variables.
void expect(bool is_right) {
  if (!is_right)
    runner().trap(TP_TRAP_ADDRESS,
                  "the library's own variables were overwritten: an array or pointer out of bounds");
}
bool is_vector(tp_i64 vector) { return vector >= 0 && vector < TP_VECTORS; }
constexpr tp_i64 kLongest = tp_i64{1} << 40;  // cycles: most of a day
}  // namespace

extern "C" {

void tp_event(void) { runner().on_event(); }
void tp_poll(tp_i64 loop) { runner().on_poll(loop); }
void tp_rest(tp_i64 loop) { runner().on_rest(loop); }
void tp_delay(tp_i64 rounds, tp_i64 cycles) { runner().on_delay(rounds, cycles); }

void tp_trap(tp_i64 kind) {
  static constexpr const char* kSentence[] = {"", "division by zero", "bad address", "stack overflow",
                                              "abort() was called"};
  runner().trap(static_cast<int>(kind),
                kind >= 1 && kind <= 4 ? kSentence[kind] : host::trap_name(static_cast<int>(kind)));
}
void tp_trap_message(tp_i64 kind, const char* message) { runner().trap(static_cast<int>(kind), message); }
void tp_reset(void) { runner().on_reset(nullptr); }
void tp_disi(tp_i64 cycles) { runner().on_disi(cycles); }
void tp_power_save(tp_i64 mode) { runner().on_power_save(mode == 0); }
void tp_clear_watchdog(void) { runner().clear_watchdog(); }

tp_i64 tp_sfr_read(tp_i64 address, tp_i64 bits) {
  return runner().read_register(static_cast<unsigned>(address), static_cast<unsigned>(bits));
}
void tp_sfr_write(tp_i64 address, tp_i64 value, tp_i64 bits) {
  runner().write_register(static_cast<unsigned>(address), static_cast<std::uint16_t>(value),
                          static_cast<unsigned>(bits));
}
void tp_sfr_modify(tp_i64 address, tp_i64 keep, tp_i64 flip) {
  runner().modify_register(static_cast<unsigned>(address), static_cast<std::uint16_t>(keep),
                           static_cast<std::uint16_t>(flip));
}

tp_i64 tp_table_read(tp_i64 address) {
  CompiledRunner& r = runner();
  return r.processor().table_read(static_cast<unsigned>(address), r.now());
}
void tp_table_write(tp_i64 address, tp_i64 value) {
  CompiledRunner& r = runner();
  r.processor().table_write(static_cast<unsigned>(address), static_cast<std::uint16_t>(value), r.now());
}

tp_i64 tp_rand(void) { return runner().next_rand(); }
void tp_srand(tp_i64 seed) { runner().seed_rand(seed); }

tp_i64 tp_now(void) {
  const host::Cycle now = runner().now();
  runner().lower_horizon(now);
  return now;
}
void tp_spend(tp_i64 cycles) {
  expect(cycles >= 0 && cycles < kLongest);
  runner().spend(cycles);
}
void tp_wait_until(tp_i64 at) { runner().wait_until(at); }
void tp_irq_install(tp_i64 vector, void (*handler)(void), tp_i64 priority, tp_i64 entry_cycles) {
  expect(is_vector(vector) && priority >= 0 && priority <= 7 && entry_cycles >= 0 && entry_cycles < kLongest);
  runner().irq_install(static_cast<int>(vector), handler, static_cast<int>(priority), entry_cycles);
}
void tp_irq_at(tp_i64 vector, tp_i64 at) {
  expect(is_vector(vector));
  runner().irq_at(static_cast<int>(vector), at);
}
void tp_irq_every(tp_i64 vector, tp_i64 first, tp_i64 period) {
  expect(is_vector(vector));
  runner().irq_every(static_cast<int>(vector), first, period);
}
void tp_background(tp_i64 slot, tp_i64 period, tp_i64 cost) {
  expect(slot >= 0 && slot < 16 && period >= 0 && cost >= 0 && cost < kLongest);
  runner().set_background(static_cast<int>(slot), period, cost);
}

}  // extern "C"
