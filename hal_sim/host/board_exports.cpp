// SPDX-License-Identifier: MIT
// The board functions of pins.h: each finds the running robot, asks its board at this cycle, and tells the
// host until when the answer holds (a read) or that something changed (a write).
// Nothing is computed here; the numbers are hal_sim/board's.
#include <algorithm>
#include <optional>
#include <string>

#include "hal_sim/api/timings.h"
#include "hal_sim/board/board.h"
#include "hal_sim/drivers/drivers.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins.h"

namespace {

using board::Board;
using board::Cycle;
using board::Wheel;
using drivers::Drivers;
using drivers::TimerMotors;
using host::Context;

// processor time of library functions whose work happens on this side
constexpr Cycle kSetSpeedCycles = T_SPEED;           // speed 0
constexpr Cycle kDivisionCycles = T_SPEED_DIVISION;  // any other speed
constexpr Cycle kSpeedReturnCycles = 12;             // of these, after the new speed holds [estimated]
constexpr Cycle kListSearchCycles = T_AGENDA_FOUND;
constexpr Cycle kSetCycleCycles = T_AGENDA_CYCLE;
constexpr Cycle kNodePassedCycles = T_AGENDA_PASSED;
constexpr Cycle kReturnCycles = 6;              // from the end of the list to RETFIE
constexpr Cycle kKnownCycles = T_AGENDA_KNOWN;  // activated although it is there
constexpr Cycle kActivateCycles = T_AGENDA_ACTIVATE;
constexpr Cycle kNodeOfListCycles = T_AGENDA_ACTIVATE_PASSED;
constexpr Cycle kDestroyCycles = T_AGENDA_DESTROY;
constexpr Cycle kDestroyPassedCycles = T_AGENDA_DESTROY_PASSED;
constexpr Cycle kFreeCycles = T_AGENDA_FREE;

Wheel wheel_of(tp_i64 wheel) { return wheel == 0 ? Wheel::Left : Wheel::Right; }

void request_background(Context& context, Board& robot, int slot, Cycle period, Cycle cost) {
  const std::size_t i = static_cast<std::size_t>(slot);
  if (cost == 0 || period <= 0) period = cost = 0;
  if (context.drivers().requests().background_period[i] == period &&
      context.drivers().requests().background_cost[i] == cost)
    return;
  context.drivers().requests().background_period[i] = period;
  context.drivers().requests().background_cost[i] = cost;
  context.set_background(slot, period, cost);
}

/// Two interrupts a pair, each with two conversions.
void charge_basic_prox(Context& context, Board& robot) {
  request_background(context, robot, TP_BG_PROX, (drivers::kBasicPulseCycles + drivers::kBasicRestCycles) / 2,
                     drivers::kBasicProxIsrCycles);
}

void note_speed(Context& context, tp_i64 wheel, tp_i64 speed_steps_s, int most) {
  if (speed_steps_s >= -most && speed_steps_s <= most) return;
  const std::string side = wheel == 0 ? "left" : "right";
  context.board().note_misuse({"speed out of range " + side, "e_set_speed_" + side + "()",
                               "got " + std::to_string(speed_steps_s) + " steps/s, expected -" +
                                   std::to_string(most) + " to " + std::to_string(most) +
                                   "; the library takes the nearest of these",
                               "the motors are not faster", context.now(), 0, 1});
}

Cycle search_cost(const void* function, Cycle found_at_once = kListSearchCycles) {
  return found_at_once + kNodePassedCycles * Context::current().drivers().agendas().nodes_passed(function);
}

/// Shape of every change of the agenda list; `only`: the one wheel that it moves otherwise.
template <typename Change>
tp_i64 change_list(Cycle cost, Change change, std::optional<Wheel> only = std::nullopt) {
  Context& context = Context::current();
  Board& robot = context.board();
  const Cycle now = context.now();
  const int result = change(context.drivers().agendas(), now);
  only ? robot.follow_motor(*only, now) : robot.follow_motors(now);
  context.note_write();
  context.follow_handlers();
  host::request_agenda_interrupt(context);
  context.spend(cost);
  return result;
}

}  // namespace

namespace host {

void request_agenda_interrupt(Context& context) {
  const drivers::AgendaTimer& agendas = context.drivers().agendas();
  if (agendas.is_walking()) return;  // tp_agenda_end() follows
  const Cycle next = agendas.next_interrupt();
  const Cycle wanted = next >= kNever ? -1 : next;
  if (wanted == context.drivers().requests().agenda_interrupt) return;
  context.drivers().requests().agenda_interrupt = wanted;
  context.irq_at(TP_V_T2, wanted);
}

}  // namespace host

extern "C" {

// --- ports -----------------------------------------------------------------------------------------------

void tp_init_ports(void) {
  Context& context = Context::current();
  context.drivers().init_ports(context.now());
  context.note_write();
}

tp_i64 tp_latch_read(tp_i64 port, tp_i64 bit) {
  Context& context = Context::current();
  const Cycle now = context.now();
  context.lower_horizon(context.board().port_horizon(static_cast<char>(port), now));
  return context.board().latch_bit(static_cast<char>(port), static_cast<int>(bit), now) ? 1 : 0;
}

void tp_latch_write(tp_i64 port, tp_i64 bit, tp_i64 level) {
  Context& context = Context::current();
  context.board().latch_bit(static_cast<char>(port), static_cast<int>(bit), (level & 1) != 0, context.now());
  context.note_write();
}

tp_i64 tp_pins_read(tp_i64 port) {
  Context& context = Context::current();
  const Cycle now = context.now();
  context.lower_horizon(context.board().port_horizon(static_cast<char>(port), now));
  return context.board().port_read(static_cast<char>(port), Board::Register::Port, now);
}

void tp_note_led(tp_i64 led) {
  constexpr tp_i64 kAll = 8;
  if (led <= kAll) return;
  Context& context = Context::current();
  context.board().note_misuse(
      {"LED out of range", "e_set_led()",
       "got LED " + std::to_string(led) + ", expected 0 to 7, or 8 for all; the library sets all eight",
       "count from 0; body and front have functions of their own", context.now(), 0, 1});
}

void tp_coils_write(tp_i64 wheel, tp_i64 coils) {
  Context& context = Context::current();
  const Cycle now = context.now();
  context.board().stepper(wheel_of(wheel), now).energise(static_cast<unsigned>(coils & 15), now);
  context.board().follow_motors(now);
  context.note_write();
}

// --- agendas ---------------------------------------------------------------------------------------------

void tp_agenda_start(void) {
  change_list(0, [](drivers::AgendaTimer& agendas, Cycle now) {
    agendas.start(now);
    return 1;
  });
}

void tp_agenda_stop(void) {
  change_list(0, [](drivers::AgendaTimer& agendas, Cycle now) {
    agendas.stop(now);
    return 1;
  });
}

tp_i64 tp_agenda_activate(const void* function, tp_i64 cycle) {
  if (!function)
    Context::current().trap(TP_TRAP_ADDRESS,
                            "agenda: its function is a null pointer; on the chip a call through "
                            "it jumps to the reset at address 0");
  const drivers::AgendaTimer& list = Context::current().drivers().agendas();
  if ((cycle & 0xFFFF) == 0 && !list.is_motor(function) && !list.has(function))
    Context::current().board().note_misuse(
        {"agenda without a period", "e_activate_agenda()",
         "got cycle 0, expected 1 to 65535 (0.1 ms each): the agenda's function is never called",
         "give it a cycle, now or with e_set_agenda_cycle()", Context::current().now(), 0, 1},
        function);
  const int passed = list.nodes_passed(function);
  const Cycle cost = list.has(function) ? kKnownCycles + kNodePassedCycles * passed
                                        : kActivateCycles + kNodeOfListCycles * passed;
  return change_list(cost, [&](drivers::AgendaTimer& agendas, Cycle now) {
    return agendas.activate(function, static_cast<int>(cycle), now);
  });
}

tp_i64 tp_agenda_destroy(const void* function) {
  const drivers::AgendaTimer& list = Context::current().drivers().agendas();
  const Cycle cost = kDestroyCycles + kDestroyPassedCycles * list.nodes_passed(function) +
                     (list.has(function) ? kFreeCycles : 0);
  return change_list(
      cost, [&](drivers::AgendaTimer& agendas, Cycle now) { return agendas.destroy(function, now); });
}

tp_i64 tp_agenda_set_cycle(const void* function, tp_i64 cycle) {
  if ((cycle & 0xFFFF) != 0 && function) Context::current().board().forget_misuse(function);
  return change_list(search_cost(function, kSetCycleCycles), [&](drivers::AgendaTimer& agendas, Cycle now) {
    return agendas.set_cycle(function, static_cast<int>(cycle), now);
  });
}

tp_i64 tp_agenda_reset(const void* function) {
  return change_list(search_cost(function), [&](drivers::AgendaTimer& agendas, Cycle now) {
    return agendas.reset_count(function, now);
  });
}

tp_i64 tp_agenda_pause(const void* function) {
  return change_list(search_cost(function),
                     [&](drivers::AgendaTimer& agendas, Cycle now) { return agendas.pause(function, now); });
}

tp_i64 tp_agenda_restart(const void* function) {
  return change_list(search_cost(function), [&](drivers::AgendaTimer& agendas, Cycle now) {
    return agendas.restart(function, now);
  });
}

void tp_agenda_begin(void) {
  Context& context = Context::current();
  context.drivers().agendas().begin(context.now());
  context.note_write();
}

const void* tp_agenda_next(void) {
  Context& context = Context::current();
  bool divided_by_zero = false;
  const void* function = context.drivers().agendas().next(divided_by_zero);
  context.spend(context.drivers().agendas().take_walk_cost());
  if (divided_by_zero)
    context.trap(TP_TRAP_MATH, "motor agenda: 10000 / 0 (speed 0 with a power-save half pending)");
  context.callback(function);
  return function;
}

void tp_agenda_end(void) {
  Context& context = Context::current();
  context.spend(kReturnCycles);
  context.drivers().agendas().finish(context.now());
  context.drivers().requests().agenda_interrupt = Drivers::Requests::kUnknown;  // the request was used up
  context.note_write();
  host::request_agenda_interrupt(context);
}

// --- motors ----------------------------------------------------------------------------------------------

void tp_motor_agenda(tp_i64 wheel, const void* function) {
  Context::current().drivers().agendas().name_motor(wheel_of(wheel), function);
}

void tp_motor_speed(tp_i64 wheel, tp_i64 speed_steps_s) {
  Context& context = Context::current();
  note_speed(context, wheel, speed_steps_s, drivers::kMaxSpeed);
  const Wheel which = wheel_of(wheel);
  const int passed = context.drivers().agendas().nodes_passed(which);
  const Cycle cost =
      kSetSpeedCycles + kNodePassedCycles * passed + (speed_steps_s == 0 ? 0 : kDivisionCycles);
  // the agenda's cycle is set last
  context.spend(cost - kSpeedReturnCycles);
  const auto set_speed = [&](drivers::AgendaTimer& agendas, Cycle now) {
    agendas.set_speed(which, static_cast<int>(speed_steps_s), now);
    return 1;
  };
  change_list(kSpeedReturnCycles, set_speed, which);
}

void tp_motor_run(tp_i64 wheel) {
  Context& context = Context::current();
  const bool fine = context.drivers().agendas().run_motor(wheel_of(wheel), context.now());
  context.note_write();
  context.follow_handlers();
  host::request_agenda_interrupt(context);
  if (!fine) context.trap(TP_TRAP_MATH, "motor agenda: 10000 / 0 (speed 0 with a power-save half pending)");
}

tp_i64 tp_motor_steps(tp_i64 wheel) {
  Context& context = Context::current();
  const Cycle now = context.now();
  const drivers::AgendaTimer& agendas = context.drivers().agendas();
  context.lower_horizon(agendas.steps_horizon(wheel_of(wheel), now));
  return agendas.commanded_steps(wheel_of(wheel), now);
}

void tp_timer_motor_speed(tp_i64 driver, tp_i64 wheel, tp_i64 speed_steps_s) {
  Context& context = Context::current();
  Board& robot = context.board();
  const Cycle now = context.now();
  const Wheel which = wheel_of(wheel);
  const auto kind = driver == 0 ? TimerMotors::Driver::Basic : TimerMotors::Driver::Timer3;
  if (kind == TimerMotors::Driver::Timer3) note_speed(context, wheel, speed_steps_s, drivers::kMaxSpeed);
  context.drivers().timer_motors().set_speed(kind, which, static_cast<int>(speed_steps_s), now,
                                             robot.stepper(which, now));
  robot.follow_motors(now);
  if (kind == TimerMotors::Driver::Basic) {
    const Cycle period = context.drivers().timer_motors().interrupt_period(which);
    request_background(context, robot, which == Wheel::Left ? TP_BG_MOTOR_LEFT : TP_BG_MOTOR_RIGHT, period,
                       period > 0 ? drivers::kBasicMotorIsrCycles : 0);
  }
  context.note_write();
  context.spend(kSetSpeedCycles);
}

tp_i64 tp_timer_motor_steps(tp_i64 driver, tp_i64 wheel) {
  Context& context = Context::current();
  const Cycle now = context.now();
  const Wheel which = wheel_of(wheel);
  context.lower_horizon(context.drivers().timer_motors().steps_horizon(which, now));
  return context.drivers().timer_motors().commanded_steps(
      driver == 0 ? TimerMotors::Driver::Basic : TimerMotors::Driver::Timer3, which, now,
      context.drivers().agendas().stepper_at(which, now));
}

void tp_timer3_motors_start(void) {
  Context& context = Context::current();
  Board& robot = context.board();
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) robot.stepper(wheel, context.now());
  context.drivers().timer_motors().start_timer3(context.now());
  request_background(context, robot, TP_BG_MOTOR_LEFT, drivers::kTimer3TickCycles, drivers::kTimer3IsrCycles);
  context.note_write();
}

// --- converter -------------------------------------------------------------------------------------------

void tp_scan_start(tp_i64 micro_only, tp_i64 five_pairs) {
  Context& context = Context::current();
  Board& robot = context.board();
  const Cycle now = context.now();
  context.drivers().scan().start(micro_only != 0, five_pairs != 0, now);
  robot.follow_power(now);
  context.note_write();
  context.follow_handlers();
}

void tp_scan_switch(tp_i64 on) {
  Context& context = Context::current();
  Board& robot = context.board();
  const Cycle now = context.now();
  context.drivers().scan().switch_converter(on != 0, now);
  robot.follow_power(now);
  context.note_write();
  context.follow_handlers();
}

tp_i64 tp_scan_filled_at(void) {
  Context& context = Context::current();
  return context.drivers().scan().first_fill(context.now());
}

tp_i64 tp_scan_interrupts(void) {
  Context& context = Context::current();
  const drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  context.lower_horizon(scan.next_interrupt(now));
  return scan.interrupts(now);
}

tp_i64 tp_scan_array_filled(void) {
  Context& context = Context::current();
  const drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  const std::int64_t count = scan.interrupts(now);
  const bool filled = count > 0 && count % drivers::kMicSamples == 0;
  const std::int64_t next = filled ? count + 1 : count - count % drivers::kMicSamples + drivers::kMicSamples;
  context.lower_horizon(scan.interrupt_cycle(next));
  return filled ? 1 : 0;
}

tp_i64 tp_scan_acc_samples(void) {
  Context& context = Context::current();
  const drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  context.lower_horizon(scan.next_interrupt(now));
  return scan.acc_samples(now);
}

tp_i64 tp_scan_pair(tp_i64 sensor) {
  Context& context = Context::current();
  if (sensor < 0 || sensor > 9) return 0;
  const drivers::AdcScan::Pair now = context.drivers().scan().pair(static_cast<int>(sensor), context.now());
  context.lower_horizon(now.until);
  return tp_i64{now.dark} | tp_i64{now.lit} << 16;
}

tp_i64 tp_scan_mic_index(void) {
  Context& context = Context::current();
  return context.drivers().scan().interrupts(context.now()) % drivers::kMicSamples;
}

tp_i64 tp_scan_acc_index(void) {
  Context& context = Context::current();
  return context.drivers().scan().acc_samples(context.now()) % drivers::kAccSamples;
}

void tp_scan_values(void* dark, void* lit) {
  Context& context = Context::current();
  drivers::AdcScan& scan = context.drivers().scan();
  const Cycle now = context.now();
  for (int sensor = 0; sensor < 10; ++sensor) {
    static_cast<std::int16_t*>(dark)[sensor] = static_cast<std::int16_t>(scan.dark(sensor, now));
    static_cast<std::int16_t*>(lit)[sensor] = static_cast<std::int16_t>(scan.lit(sensor, now));
  }
}

void tp_basic_prox_start(void) {
  Context& context = Context::current();
  Board& robot = context.board();
  context.drivers().basic_prox().start(context.now());
  robot.follow_power(context.now());
  charge_basic_prox(context, robot);
  context.note_write();
}

void tp_basic_prox_hold(void) {
  Context& context = Context::current();
  context.drivers().basic_prox().hold(context.now());
  context.note_write();
}

void tp_basic_prox_release(void) {
  Context& context = Context::current();
  Board& robot = context.board();
  const bool was_on = context.drivers().basic_prox().is_on();
  context.drivers().basic_prox().release(context.now());
  if (!was_on && context.drivers().basic_prox().is_on()) charge_basic_prox(context, robot);
  context.note_write();
}

void tp_basic_prox_stop(void) {
  Context& context = Context::current();
  context.drivers().basic_prox().stop(context.now());
  context.board().follow_power(context.now());
  request_background(context, context.board(), TP_BG_PROX, 0, 0);
  context.note_write();
}

tp_i64 tp_basic_prox_ambient(tp_i64 sensor) {
  Context& context = Context::current();
  if (sensor < 0 || sensor >= board::kRingSensors) return 0;
  drivers::BasicProx& prox = context.drivers().basic_prox();
  const Cycle now = context.now();
  context.lower_horizon(prox.horizon(now));
  return prox.ambient(static_cast<int>(sensor), now);
}

tp_i64 tp_basic_prox_reflected(tp_i64 sensor) {
  Context& context = Context::current();
  if (sensor < 0 || sensor >= board::kRingSensors) return 0;
  drivers::BasicProx& prox = context.drivers().basic_prox();
  const Cycle now = context.now();
  context.lower_horizon(prox.horizon(now));
  return prox.reflected(static_cast<int>(sensor), now);
}

tp_i64 tp_convert(tp_i64 channel) {
  Context& context = Context::current();
  const Cycle now = context.now();
  const int counts = context.board().convert(static_cast<int>(channel), now);
  if (counts < 0) context.trap(TP_TRAP_UNSIMULATED, "converter: this input is not simulated");
  context.lower_horizon(now);
  return counts;
}

// --- serial lines ----------------------------------------------------------------------------------------

void tp_uart_init(tp_i64 number, tp_i64 brg) {
  Context& context = Context::current();
  context.drivers().uart_ring(static_cast<int>(number)).init(static_cast<int>(brg), context.now());
  context.note_write();
}

void tp_uart_load(tp_i64 number, tp_i64 byte) {
  Context& context = Context::current();
  board::Uart& uart = context.board().uart(number == 2 ? 2 : 1);
  const Cycle now = context.now();
  if (uart.load(static_cast<std::uint8_t>(byte), now))
    context.irq_at(number == 2 ? TP_V_U2TX : TP_V_U1TX, std::max(now, uart.buffer_empty_at()));
  context.note_write();
}

tp_i64 tp_uart_unread(tp_i64 number) {
  Context& context = Context::current();
  const Cycle now = context.now();
  context.lower_horizon(context.board().uart(number == 2 ? 2 : 1).next_arrival(now));
  return context.drivers().uart_ring(static_cast<int>(number)).unread(now);
}

tp_i64 tp_uart_take(tp_i64 number) {
  Context& context = Context::current();
  const Cycle now = context.now();
  context.lower_horizon(context.board().uart(number == 2 ? 2 : 1).next_arrival(now));
  const int byte = context.drivers().uart_ring(static_cast<int>(number)).take(now);
  if (byte >= 0) context.note_write();
  return byte;
}

/* image_abi.h: printf() waits for room in the UART's buffer byte by byte, as XC16's does */
void tp_console(const char* bytes, tp_i64 length, tp_i64 number) {
  Context& context = Context::current();
  if (context.print(bytes, length, static_cast<int>(number))) return;
  board::Uart& uart = context.board().uart(number == 2 ? 2 : 1);
  context.note_write();
  for (tp_i64 i = 0; i < length; ++i)
    context.wait_until(uart.load_when_room(static_cast<std::uint8_t>(bytes[i]), context.now()));
}

// --- the rest --------------------------------------------------------------------------------------------

tp_i64 tp_revision_1_3(void) {
  return Context::current().board().setup().revision == board::Revision::Rev13 ? 1 : 0;
}

tp_i64 tp_battery_counts(void) {
  Context& context = Context::current();
  const Cycle now = context.now();
  context.lower_horizon(now);
  return context.board().battery_counts(now);
}

}  // extern "C"
