// SPDX-License-Identifier: MIT
// Edges on the chip's pins as programs count them: the camera's VSYNC, HREF and pixel clock at the clock
// inputs of timers 5, 4 and 1, as a capture uses them, and the remote control's pulses at INT0.

#include "tests/own_drivers/fixture.h"

namespace own_drivers {
namespace {

// a window of 40 x 40 pixels, nothing skipped, two bytes a pixel. The driver asks the sensor for a pixel more
// a line than it takes
TEST_F(OwnDrivers, camera_edges_of_a_frame_are_counted_by_timers) {
  Robot& robot = add_robot_with_source(R"(
#include <camera/fast_2_timer/e_poxxxx.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
unsigned int lines[2], pixels;
unsigned long cycles[2];
int frames, answer;
int main(void) {
  e_init_port();
  e_poxxxx_init_cam();
  answer = e_poxxxx_config_cam(300, 220, 40, 40, 1, 1, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  T1CON = T4CON = T5CON = 0x0002;      /* rising edges at RC14, RC3 and RC4 */
  T2CON = 0x0008;                      /* cycles, 32 bits */
  PR1 = PR4 = PR3 = PR2 = 0xFFFF;
  PR5 = 1;
  TMR5 = 0;
  T5CONbits.TON = 1;
  IFS1bits.T5IF = 0;
  while (!IFS1bits.T5IF);
  T4CONbits.TON = T2CONbits.TON = 1;
  for (frames = 0; frames < 2;) {
    TMR5 = 0;
    TMR4 = 0;
    TMR1 = 0;
    T1CONbits.TON = frames == 1;
    TMR3HLD = 0;
    TMR2 = 0;
    IFS1bits.T5IF = 0;
    while (!IFS1bits.T5IF);
    lines[frames] = TMR4;
    pixels = TMR1;
    cycles[frames] = TMR2;
    cycles[frames] |= (unsigned long)TMR3HLD << 16;
    frames++;
  }
  while (1);
}
)");
  ASSERT_TRUE(run_until([&] { return robot.variable("frames") == 2; }, 10));
  const auto lines = robot.variables<std::uint16_t>("lines", 2);
  const auto cycles = robot.variables<std::uint32_t>("cycles", 2);
  // the driver sets where the window begins; it ends with the array: 480 - 220 lines of 640 pixels, two bytes
  // each, 332800 clocks, of which timer 1 keeps 16 bits
  EXPECT_EQ(lines[0], 260);
  EXPECT_EQ(lines[1], 260);
  EXPECT_EQ(robot.variable<std::uint16_t>("pixels"), 332800 % 65536);
  // one frame like the other, but for the few cycles in which a round of the loop sees the flag
  EXPECT_NEAR(double(cycles[1]), double(cycles[0]), 60);
  // the authors' rate for the whole resolution: 2.54 pictures a second at most, 1.27 at least
  const double rate_hz = 14745600.0 / cycles[0];
  EXPECT_GT(rate_hz, 1.2);
  EXPECT_LT(rate_hz, 2.7);
  expect_no_traps();
}

// 11, toggle 0, address 00101, key 100011: seven ones fall in their middle, and of the six zeros that follow
// one another the second of each pair falls at its beginning, four in all: 11 falling edges; as many rise. A
// bit is 64 / 36 kHz: from the middle of the first one to that of the second 26214 cycles
TEST_F(OwnDrivers, remote_control_edges_interrupt_at_int0) {
  const std::string source = program(R"(
unsigned int edges, at[32];
void __attribute__((interrupt, no_auto_psv)) _INT0Interrupt(void)
{
  IFS0bits.INT0IF = 0;
  if (edges < 32) at[edges] = TMR3;
  edges++;
}
int main(void)
{
  TRISFbits.TRISF6 = 1;
  INTCON2bits.INT0EP = EDGE;
  IFS0bits.INT0IF = 0;
  IEC0bits.INT0IE = 1;
  PR3 = 0xFFFF;
  T3CON = 0x8020;      /* 64 cycles a tick */
  while (1) Idle();
}
)");
  const auto with = [&](const char* edge) {
    std::string s = source;
    return s.replace(s.find("EDGE"), 4, edge);
  };
  Robot& falling = add_robot_with_source(with("1"));
  Robot& rising = add_robot_with_source(with("0")).at(0.5, 0);
  run_for(0.01);
  falling.press_key(35, 0.05, 5);
  rising.press_key(35, 0.05, 5);
  run_for(0.1);
  EXPECT_EQ(falling.variable<std::uint16_t>("edges"), 11);
  EXPECT_EQ(rising.variable<std::uint16_t>("edges"), 11);
  const auto f = falling.variables<std::uint16_t>("at", 11), r = rising.variables<std::uint16_t>("at", 11);
  EXPECT_NEAR(f[1] - f[0], 26214.4 / 64, 1);
  // the first bit ends half a bit after its middle, and rises there: the second one begins with silence
  EXPECT_NEAR(r[0] - f[0], 26214.4 / 2 / 64, 1);
  // from the first edge to the last, the middle of the fourteenth bit: thirteen bits
  EXPECT_NEAR(f[10] - f[0], 13 * 26214.4 / 64, 2);
  expect_no_traps();
}

}  // namespace
}  // namespace own_drivers
