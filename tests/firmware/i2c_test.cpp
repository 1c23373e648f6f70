// SPDX-License-Identifier: MIT
// e_I2C_master_module and e_I2C_protocol on whole robots: results, times, what the bus hears, time-outs. A
// bit is 164 cycles = 11.12 us; write transaction 1+9+9+9+1 bits, read 1+9+9+1+9+8+1+1 = 39 bits = 0.434 ms.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

constexpr double kFcy = 14745600.0;

/// 256 registers at 0x42.
struct Memory : board::I2cRegisters {
  Memory() : I2cRegisters(0x42) {}
  std::array<std::uint8_t, 256> held{};
  int writes = 0;
  bool write_register(std::uint8_t number, std::uint8_t value, board::Cycle) override {
    held[number] = value;
    ++writes;
    return true;
  }
  std::uint8_t read_register(std::uint8_t number, board::Cycle) override { return held[number]; }
};

class I2cApi : public FirmwareTest {
 protected:
  Memory& plug() {
    auto made = std::make_unique<Memory>();
    Memory& memory = *made;
    twin().mind(0).board().i2c().attach(std::move(made));
    return memory;
  }
};

// times with a 1:1 timer would overflow; 1:64 counts 4.34 us
const char* const kTransactions = R"(
#include <I2C/e_I2C_protocol.h>
int wrote, got, absent, done;
unsigned int write_ticks, read_ticks;
int main(void) {
  T1CON = 0; PR1 = 0xFFFF; T1CONbits.TCKPS = 2; T1CONbits.TON = 1;
  e_i2cp_init();
  e_i2cp_enable();
  TMR1 = 0;
  wrote = e_i2cp_write(0x42, 3, -7);
  write_ticks = TMR1;
  TMR1 = 0;
  got = e_i2cp_read(0x42, 3);
  read_ticks = TMR1;
  absent = e_i2cp_read(0x50, 0);
  e_i2cp_disable();
  done = 1;
  while (1);
}
)";

TEST_F(I2cApi, a_register_is_written_and_read_in_half_a_millisecond) {
  Robot& r = add_robot_with_source(kTransactions);
  Memory& memory = plug();
  run_for(0.1);
  EXPECT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("wrote"), 1);
  EXPECT_EQ(memory.held[3], 0xF9);
  EXPECT_EQ(r.variable("got"), -7);     // a signed char
  EXPECT_EQ(r.variable("absent"), -1);  // 0xFF: nobody pulls the line
  // the bits, and at most 25 % for calls, interrupts and rounds
  const double write_s = r.variable<std::uint16_t>("write_ticks") * 64 / kFcy;
  const double read_s = r.variable<std::uint16_t>("read_ticks") * 64 / kFcy;
  EXPECT_GE(write_s, 29 * 164 / kFcy);
  EXPECT_LE(write_s, 29 * 164 / kFcy * 1.25);
  EXPECT_GE(read_s, 39 * 164 / kFcy);
  EXPECT_LE(read_s, 39 * 164 / kFcy * 1.25);
  expect_no_traps();
}

const char* const kForgotten = R"(
#include <I2C/e_I2C_protocol.h>
int wrote, again;
int main(void) {
  wrote = e_i2cp_write(0x42, 3, 5);
  again = e_i2cp_write(0x42, 4, 6);
  while (1);
}
)";

// neither initialised nor enabled: the first pass fails, its reset does both
TEST_F(I2cApi, forgetting_enable_works_after_the_first_failed_pass) {
  Robot& r = add_robot_with_source(kForgotten);
  Memory& memory = plug();
  run_for(0.5);
  EXPECT_EQ(r.variable("wrote"), 1);
  EXPECT_EQ(r.variable("again"), 1);
  EXPECT_EQ(memory.held[3], 5);
  EXPECT_EQ(memory.held[4], 6);
  EXPECT_EQ(memory.writes, 2);  // the module was off: the failed pass never reached the bus
  expect_no_traps();
}

const char* const kNotEnabled = R"(
#include <I2C/e_I2C_protocol.h>
int wrote;
int main(void) {
  e_i2cp_init();
  wrote = e_i2cp_write(0x42, 3, 5);
  while (1);
}
)";

// initialised, not enabled: every primitive times out, yet the bits went over the bus; then once more
TEST_F(I2cApi, without_the_interrupt_the_device_hears_it_twice) {
  Robot& r = add_robot_with_source(kNotEnabled);
  Memory& memory = plug();
  run_for(0.5);
  EXPECT_EQ(r.variable("wrote"), 1);
  EXPECT_EQ(memory.writes, 2);
  expect_no_traps();
}

const char* const kAfterPorts = R"(
#include <I2C/e_I2C_protocol.h>
#include <motor_led/e_init_port.h>
int wrote;
int main(void) {
  e_init_port();
  e_i2cp_enable();
  wrote = e_i2cp_write(0x42, 3, 5);
  while (1);
}
)";

// e_init_port() asks for a gyroscope and leaves the module on: the first pass gets through
TEST_F(I2cApi, initialising_the_ports_leaves_the_module_on) {
  Robot& r = add_robot_with_source(kAfterPorts);
  Memory& memory = plug();
  run_for(0.1);
  EXPECT_EQ(r.variable("wrote"), 1);
  EXPECT_EQ(memory.writes, 1);
  expect_no_traps();
}

const char* const kPrimitives = R"(
#include <I2C/e_I2C_master_module.h>
extern char e_i2c_mode;
extern int e_interrupts[3];
void idle_i2c(void);
int answers[12];
char bytes[3];
unsigned int timeout_ticks;
int done;
int main(void) {
  T1CON = 0; PR1 = 0xFFFF; T1CONbits.TCKPS = 2; T1CONbits.TON = 1;
  answers[0] = e_i2c_start();          /* module off: P is clear */
  answers[1] = e_i2c_init();
  answers[2] = e_i2c_restart();        /* no start yet */
  TMR1 = 0;
  answers[3] = e_i2c_start();          /* interrupt off: the start happens, nobody notices */
  timeout_ticks = TMR1;
  answers[4] = e_i2c_start();          /* already started */
  answers[5] = e_i2c_reset();
  answers[6] = e_i2c_start();
  answers[7] = e_i2c_mode;
  e_i2c_write(0x43);
  e_i2c_read(&bytes[0]);
  answers[8] = e_i2c_ack();
  e_i2c_read(&bytes[1]);
  answers[9] = e_i2c_nack();
  answers[10] = e_i2c_stop();
  idle_i2c();
  answers[11] = e_i2c_disable() + e_i2c_deinit() + e_i2c_enable() + e_interrupts[0];
  done = 1;
  while (1);
}
)";

TEST_F(I2cApi, primitives_answer_as_the_bus_allows) {
  Robot& r = add_robot_with_source(kPrimitives);
  Memory& memory = plug();
  memory.held[0] = 0x12;
  memory.held[1] = 0x34;
  run_for(0.3);
  EXPECT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variables("answers", 12), (std::vector<std::int16_t>{0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 3}));
  EXPECT_EQ(r.variables<char>("bytes", 2), (std::vector<char>{0x12, 0x34}));
  // 10,000 rounds of 6 cycles at -O1
  const double timeout_s = 10000 * 6 / kFcy;
  EXPECT_NEAR(r.variable<std::uint16_t>("timeout_ticks") * 64 / kFcy, timeout_s, 0.2 * timeout_s);
  expect_no_traps();
}

const char* const kWithAgenda = R"(
#include <I2C/e_I2C_protocol.h>
#include <motor_led/advance_one_timer/e_agenda.h>
int ticks, at_start, during;
static void tick(void) { ticks++; }
int main(void) {
  int i;
  e_i2cp_init();
  e_i2cp_enable();
  e_start_agendas_processing();
  e_activate_agenda(tick, 1);
  at_start = ticks;
  for (i = 0; i < 100; i++) e_i2cp_write(0x42, 0, i);
  during = ticks - at_start;
  while (1);
}
)";

// 100 writes are 100 x 0.32 ms and some: at least 320 agenda ticks of 0.1 ms
TEST_F(I2cApi, interrupts_keep_running_during_transfers) {
  Robot& r = add_robot_with_source(kWithAgenda);
  Memory& memory = plug();
  run_for(0.3);
  EXPECT_GE(r.variable("during"), 320);
  EXPECT_LE(r.variable("during"), 450);
  EXPECT_EQ(memory.held[0], 99);
  EXPECT_EQ(memory.writes, 100);
  expect_no_traps();
}

const char* const kFromInterrupt = R"(
#include <I2C/e_I2C_master_module.h>
int answer = -1;
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) {
  IFS0bits.T1IF = 0;
  IEC0bits.T1IE = 0;
  answer = e_i2c_start();
}
int main(void) {
  e_i2c_init();
  e_i2c_enable();
  T1CON = 0; TMR1 = 0; PR1 = 1000;
  IPC0bits.T1IP = PRIO;
  IEC0bits.T1IE = 1;
  T1CONbits.TON = 1;
  while (1);
}
)";

TEST_F(I2cApi, a_handler_of_the_same_priority_waits_in_vain) {
  const std::string source = kFromInterrupt;
  Robot& low = add_robot_with_source("#define PRIO 4\n" + source, "low");
  Robot& high = add_robot_with_source("#define PRIO 5\n" + source, "high");
  high.at(1, 0);
  run_for(0.1);
  EXPECT_EQ(low.variable("answer"), 1);
  EXPECT_EQ(high.variable("answer"), 0);
  expect_no_traps();
}

// a program that leaves the bus to an extension: the one thing done with the module's register
TEST_F(I2cApi, the_module_can_be_switched_off_by_its_register) {
  Robot& r = add_robot_with_source(R"(
#include <p30F6014A.h>
#include <I2C/e_I2C_protocol.h>
int before, after, done;
int main(void) {
  e_i2cp_init();
  e_i2cp_enable();
  e_i2cp_write(0x42, 3, 7);
  before = I2CCONbits.I2CEN;
  I2CCONbits.I2CEN = 0;
  after = I2CCONbits.I2CEN;
  done = 1;
  while (1);
}
)");
  Memory& memory = plug();
  run_for(0.2);
  EXPECT_EQ(memory.held[3], 7);
  EXPECT_EQ(r.variable("before"), 1);
  EXPECT_EQ(r.variable("after"), 0);
  EXPECT_EQ(r.variable("done"), 1);
  expect_no_traps();
}

}  // namespace
