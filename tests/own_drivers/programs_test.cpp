// SPDX-License-Identifier: MIT
// Register-level firmware as e-puck programs have it: own timer set-up and handlers, converter, UART, I2C,
// coils. Expectations are worked out from the chip's documents (14.7456 MHz instruction clock).
#include "tests/own_drivers/fixture.h"

namespace own_drivers {
namespace {

TEST_F(OwnDrivers, own_timer_handler_toggles_a_led_ten_times_a_second) {
  // (5759 + 1) x 256 cycles = 0.1 s
  Robot& robot = add_robot_with_source(program(R"(
volatile unsigned int count;
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void)
{
  IFS0bits.T1IF = 0;
  LED0 = LED0 ^ 1;
  count++;
}
int main(void)
{
  LED0_dir = OUTPUT_PIN;
  LED0 = 0;
  T1CON = 0;
  T1CONbits.TCKPS = 3;
  TMR1 = 0;
  PR1 = 5759;
  IFS0bits.T1IF = 0;
  IEC0bits.T1IE = 1;
  T1CONbits.TON = 1;
  while (1);
  return 0;
}
)"));
  run_for(0.55);
  EXPECT_EQ(robot.variable<std::uint16_t>("count"), 5);
  EXPECT_TRUE(robot.led(0));
  run_for(0.1);
  EXPECT_EQ(robot.variable<std::uint16_t>("count"), 6);
  EXPECT_FALSE(robot.led(0));
  run_for(9.3);
  EXPECT_EQ(robot.variable<std::uint16_t>("count"), 99);
  EXPECT_LT(robot.cpu_load(), 0.001);  // an empty main loop waits
  expect_no_diagnoses();
  expect_no_traps();
}

TEST_F(OwnDrivers, a_polled_timer_flag_is_jumped_over) {
  // 32-bit timer 2:3: 14745600 cycles = 1 s
  Robot& robot = add_robot_with_source(program(R"(
int seconds;
int main(void)
{
  T2CON = 0;
  T2CONbits.T32 = 1;
  TMR3 = TMR2 = 0;
  PR3 = (unsigned)((14745600L - 1) >> 16);
  PR2 = (unsigned)(14745600L - 1);
  _T3IF = 0;
  T2CONbits.TON = 1;
  while (1) {
    while (!_T3IF);
    _T3IF = 0;
    seconds++;
  }
}
)"));
  run_for(3.5);
  EXPECT_EQ(robot.variable("seconds"), 3);
  EXPECT_LT(robot.cpu_load(), 0.001);
  expect_no_traps();
}

TEST_F(OwnDrivers, coils_stepped_in_a_handler_drive_as_the_library_does) {
  // one step each 10 ms, both wheels: 100 steps a second are 12.9 cm/s x 100 / 1000
  const std::string source = program(R"(
static const unsigned char phases[4] = {0x0A, 0x06, 0x05, 0x09};
unsigned int left, right;
void _ISR _T4Interrupt(void)
{
  IFS1bits.T4IF = 0;
  left = (left - 1) & 3;
  right = (right + 1) & 3;
  LATD = (LATD & 0xFF00) | phases[right] << 4 | phases[left];
}
int main(void)
{
  TRISD &= 0xFF00;
  LATD &= 0xFF00;
  T4CON = 0;
  T4CONbits.TCKPS = 3;
  PR4 = 575;
  TMR4 = 0;
  IFS1bits.T4IF = 0;
  IEC1bits.T4IE = 1;
  T4CONbits.TON = 1;
  for (;;) ;
}
)");
  Robot& robot = add_robot_with_source(source);
  run_for(5.005);
  EXPECT_EQ(robot.left_steps(), 500);
  EXPECT_EQ(robot.right_steps(), 500);
  // 1000 steps a turn of a wheel of 41 mm
  EXPECT_NEAR(robot.x_m(), 500 / 1000.0 * 3.14159265 * 0.041, 0.0005);
  EXPECT_NEAR(robot.y_m(), 0, 0.0005);
  expect_no_traps();
}

TEST_F(OwnDrivers, uart_echo_by_interrupt) {
  Robot& robot = add_robot_with_source(program(R"(
void __attribute__((__interrupt__, no_auto_psv)) _U1RXInterrupt(void)
{
  IFS0bits.U1RXIF = 0;
  while (U1STAbits.URXDA) {
    char c = U1RXREG;
    while (U1STAbits.UTXBF);
    U1TXREG = c + 1;
  }
}
int main(void)
{
  U1BRG = 7;            /* 115200 baud */
  U1MODEbits.UARTEN = 1;
  U1STAbits.UTXEN = 1;
  IFS0bits.U1RXIF = 0;
  IEC0bits.U1RXIE = 1;
  while (1) Idle();
}
)"));
  run_for(0.1);
  robot.uart(1).send("HAL 9000");
  run_for(0.1);
  EXPECT_EQ(robot.uart(1).text(), "IBM!:111");
  expect_no_traps();
}

TEST_F(OwnDrivers, printf_goes_out_at_the_rate_of_uart_1) {
  Robot& robot = add_robot_with_source(program(R"(
#include <stdio.h>
long before, after;
int main(void)
{
  U1BRG = 95;           /* 9600 baud */
  U1MODEbits.UARTEN = 1;
  U1STAbits.UTXEN = 1;
  T1CON = 0x8030;
  before = TMR1;
  printf("count %d\r\n", 42);
  after = TMR1;
  while (1);
}
)"));
  run_for(0.5);
  EXPECT_EQ(robot.uart(1).text(), "count 42\r\n");
  // ten characters, of which one goes to the shift register at once and four wait: five times 10 bits of
  // 16 x 96 cycles, in ticks of 256
  EXPECT_NEAR(robot.variable<std::int32_t>("after") - robot.variable<std::int32_t>("before"), 5 * 60, 12);
  expect_no_traps();
}

// the converter by hand, and the first emitter
const std::string kConverter = R"(
static int convert(int channel)
{
  ADCHS = channel;
  ADCON1bits.SAMP = 1;
  { int i; for (i = 0; i < 40; i++) Nop(); }
  ADCON1bits.SAMP = 0;
  while (!ADCON1bits.DONE);
  return ADCBUF0;
}
static void begin(void)
{
  pulse_IR0_dir = OUTPUT_PIN;
  pulse_IR0 = 0;
  ADPCFG = 0;
  ADCON1 = 0;
  ADCON2 = 0;
  ADCON3 = 9;             /* TAD = 5 cycles */
  ADCSSL = 0;
  ADCON1bits.ADON = 1;
}
)";

TEST_F(OwnDrivers, converter_sees_the_reflection_of_an_emitter_that_it_lights) {
  Robot& robot = add_robot_with_source(program(kConverter + R"(
int dark, lit;
int main(void)
{
  begin();
  while (1) {
    int i;
    dark = convert(IR0);
    pulse_IR0 = 1;
    for (i = 0; i < 900; i++) Nop();
    lit = convert(IR0);
    pulse_IR0 = 0;
    for (i = 0; i < 9000; i++) Nop();
  }
}
)"));
  // sensor 0 looks 17 degrees to the right of ahead
  wall(0.07, -0.3, 0.07, 0.3);
  run_for(0.2);
  const int difference = robot.variable("dark") - robot.variable("lit");
  const int of_library = robot.proximity(0);
  EXPECT_GT(of_library, 100);
  EXPECT_NEAR(difference, of_library, 3);
  expect_no_traps();
}

// noise belongs to the sample's instant: nothing here looks like a driver of the library
TEST_F(OwnDrivers, a_driver_of_the_programs_own_finds_as_much_noise_as_the_world_has) {
  Robot& robot = add_robot_with_source(program(kConverter + R"(
#define SAMPLES 400
int reflected[SAMPLES], forward[SAMPLES], right[SAMPLES], taken;
int main(void)
{
  begin();
  while (taken < SAMPLES) {
    int i, dark = convert(IR0);
    pulse_IR0 = 1;
    for (i = 0; i < 600; i++) Nop();
    reflected[taken] = dark - convert(IR0);
    pulse_IR0 = 0;
    forward[taken] = convert(ACCY);
    right[taken] = convert(MIC1);
    taken++;
    for (i = 0; i < 2000; i++) Nop();
  }
  while (1);
}
)"));
  wall(0.07, -0.3, 0.07, 0.3);
  world.proximity.noise_scale.reset();  // the profile's own
  run_for(1);
  ASSERT_EQ(robot.variable("taken"), 400);
  const auto spread = [&](const char* name) {
    double sum = 0, squares = 0;
    for (const int x : robot.variables<std::int16_t>(name, 400)) sum += x, squares += 1.0 * x * x;
    return std::sqrt(squares / 400 - sum / 400 * sum / 400);
  };
  // a standard deviation of 400 samples is known within 3.5 %; rounding and the converter add a little
  const board::Board& board = twin().mind(0).board();
  const board::IrConversion lit = board.ir().conversion(0, board::kFcyHz, 100'000);
  const double expected = lit.reflection_counts * lit.relative_noise;
  ASSERT_GT(expected, 4);
  EXPECT_NEAR(spread("reflected"), expected, 0.15 * expected);
  EXPECT_NEAR(spread("forward"), 6.3, 1.0);  // 350 ug/rtHz over pi/2 * 350 Hz, in counts
  EXPECT_NEAR(spread("right"), std::hypot(board::kMicNoiseCounts, std::sqrt(1.0 / 12)), 0.3);
}

TEST_F(OwnDrivers, scan_with_handler_fills_all_channels_at_its_rate) {
  // 16 inputs, TAD 4.5 cycles, SAMC 1: (1 + 14) x 4.5 x 16 = 1080 cycles an interrupt
  Robot& robot = add_robot_with_source(program(R"(
unsigned int counts[16], done;
void __attribute__((interrupt, no_auto_psv, shadow)) _ADCInterrupt(void)
{
  unsigned int volatile *buffer = 0;
  IFS0bits.ADIF = 0;
  (void)buffer;
  counts[2] = ADCBUF2; counts[3] = ADCBUF3; counts[4] = ADCBUF4;
  counts[5] = ADCBUF5; counts[6] = ADCBUF6; counts[7] = ADCBUF7;
  counts[8] = ADCBUF8; counts[15] = ADCBUFF;
  done++;
}
int main(void)
{
  ADCON1 = 0x00E4;       /* convert by itself, sample again by itself */
  ADCON2 = 0x043C;       /* scan, interrupt after 16 */
  ADCON3 = 0x0108;       /* SAMC 1, TAD 4.5 cycles */
  ADCHS = 0;
  ADCSSL = 0xFFFF;
  IFS0bits.ADIF = 0;
  IEC0bits.ADIE = 1;
  ADCON1bits.ADON = 1;
  while (1);
}
)"));
  run_for(1);
  EXPECT_NEAR(robot.variable<std::uint16_t>("done"), 14745600 / 1080, 3);
  const auto counts = robot.variables<std::uint16_t>("counts", 16);
  // level and at rest: the accelerometer's vertical axis differs from the two others by 1 g
  EXPECT_NEAR(counts[5], counts[6], 45);  // noise of 6.3 counts in each
  EXPECT_GT(counts[7], counts[5] + 500);
  EXPECT_GT(counts[8], 4000);  // nothing shines
  EXPECT_NEAR(counts[2], counts[3], 60);
  expect_no_traps();
}

TEST_F(OwnDrivers, ground_sensors_over_the_i2c_module) {
  Robot& robot = add_robot_with_source(program(R"(
int ground[3], answered;
static void idle(void) { while (I2CCON & 0x1F || I2CSTATbits.TRSTAT); }
static void put(unsigned char byte) { I2CTRN = byte; while (I2CSTATbits.TRSTAT); answered += !I2CSTATbits.ACKSTAT; }
static unsigned char get(int last)
{
  unsigned char byte;
  I2CCONbits.RCEN = 1;
  while (!I2CSTATbits.RBF);
  byte = I2CRCV;
  I2CCONbits.ACKDT = last;
  I2CCONbits.ACKEN = 1;
  idle();
  return byte;
}
int main(void)
{
  int i;
  I2CBRG = 150;
  I2CCONbits.I2CEN = 1;
  I2CCONbits.SEN = 1; while (I2CCONbits.SEN);
  put(0xC0); put(0);
  I2CCONbits.RSEN = 1; while (I2CCONbits.RSEN);
  put(0xC1);
  for (i = 0; i < 3; i++) {
    unsigned char high = get(0);
    ground[i] = high << 8 | get(i == 2);
  }
  I2CCONbits.PEN = 1; while (I2CCONbits.PEN);
  while (1);
}
)"));
  sim::PartDesc part;
  part.kind = "ground-sensors";
  part.values["noise"].numbers = {0.0};
  world.floor.colour = {1, 1, 1};
  world.floor.ir_reflectance = -1;
  robot.settings().parts.push_back(part);
  run_for(0.1);
  EXPECT_EQ(robot.variable("answered"), 3);
  // white: 856 [FRM A5]
  for (int i = 0; i < 3; ++i) EXPECT_EQ(robot.variables("ground", 3)[static_cast<std::size_t>(i)], 856);
  expect_no_traps();
}

TEST_F(OwnDrivers, xc16_built_ins_and_attributes) {
  Robot& robot = add_robot_with_source(program(R"(
int __attribute__((space(xmemory), near)) a;
int __attribute__((far, persistent)) b;
long product; int quotient, modulo, level; unsigned word, osccon;
int main(void)
{
  __builtin_nop();
  __builtin_disi(0x3FFF);
  product = __builtin_mulss(-300, 200);
  quotient = __builtin_divsd(-70000L, 7);
  modulo = __builtin_modsd(70001L, 7);
  TBLPAG = 0x7F;
  NVMADRU = 0x7F; NVMADR = 0xF010;
  NVMCON = 0x4044; __builtin_write_NVM(); while (NVMCONbits.WR);
  __builtin_tblwtl(0xF010, 0x1234);
  NVMCON = 0x4004; __builtin_write_NVM(); while (NVMCONbits.WR);
  word = __builtin_tblrdl(0xF010);
  __builtin_btg((unsigned int *)&LATA, 6);
  TRISAbits.TRISA6 = 0;
  DISICNT = 0;
  SET_CPU_IPL(3);
  level = SRbits.IPL;
  while (1);
}
)"));
  run_for(0.1);
  EXPECT_EQ(robot.variable<std::int32_t>("product"), -60000);
  EXPECT_EQ(robot.variable("quotient"), -10000);
  EXPECT_EQ(robot.variable("modulo"), 1);
  EXPECT_EQ(robot.variable<std::uint16_t>("word"), 0x1234);
  EXPECT_TRUE(robot.led(0));
  EXPECT_EQ(robot.variable("level"), 3);
  expect_no_traps();
}

}  // namespace
}  // namespace own_drivers
