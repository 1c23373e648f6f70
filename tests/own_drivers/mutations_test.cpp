// SPDX-License-Identifier: MIT
// Small drivers as e-puck programs have them, each right as it stands, and each broken by one textual change
// at a time. The right one gives no diagnosis; each broken one gives the diagnosis, trap or figure that names
// what was broken.
#include <utility>

#include "tests/own_drivers/fixture.h"

namespace own_drivers {
namespace {

struct Driver {
  std::string source;
  double seconds;           // of a run
  std::string serial = "";  // arrives at UART 1 after 50 ms
};

// 100 steps/s on Timer 4 for a fifth of a second, then rest
const Driver kMotors{R"(
static const unsigned char phases[4] = {0x0A, 0x06, 0x05, 0x09};
unsigned int phase, steps;
void _ISR _T4Interrupt(void)
{
  IFS1bits.T4IF = 0;
  if (steps == 20) {
    T4CONbits.TON = 0;
    LATD &= 0xFF00;
    return;
  }
  steps++;
  phase = (phase + 1) & 3;
  LATD = (LATD & 0xFF00) | phases[phase] << 4 | phases[phase];
}
int main(void)
{
  TRISD &= 0xFF00;
  LATD &= 0xFF00;
  T4CON = 0;
  T4CONbits.TCKPS = 3;
  PR4 = 575;
  IFS1bits.T4IF = 0;
  IEC1bits.T4IE = 1;
  T4CONbits.TON = 1;
  while (1);
}
)",
                     1.5};

// a pair of proximity sensors by hand, 100 times a second
const Driver kInfrared{R"(
int dark, lit;
static int convert(int channel)
{
  int i;
  ADCHS = channel;
  ADCON1bits.SAMP = 1;
  for (i = 0; i < 40; i++) Nop();
  ADCON1bits.SAMP = 0;
  while (!ADCON1bits.DONE);
  return ADCBUF0;
}
void _ISR _T1Interrupt(void)
{
  int i;
  IFS0bits.T1IF = 0;
  dark = convert(8);
  LATFbits.LATF7 = 1;
  for (i = 0; i < 600; i++) Nop();
  lit = convert(8);
  LATFbits.LATF7 = 0;
}
int main(void)
{
  TRISFbits.TRISF7 = 0;
  LATFbits.LATF7 = 0;
  ADPCFG = 0;
  ADCON1 = 0;
  ADCON3 = 9;
  ADCSSL = 0;
  ADCON1bits.ADON = 1;
  PR1 = 575;
  T1CON = 0x8030;
  IEC0bits.T1IE = 1;
  while (1);
}
)",
                       0.2};

// microphones and two proximity inputs, scanned: (1 + 14) x 5 x 5 cycles an interrupt
const Driver kScan{R"(
unsigned int frames, ir0;
void _ISR _ADCInterrupt(void)
{
  ir0 = ADCBUF3;
  IFS0bits.ADIF = 0;
  frames++;
}
int main(void)
{
  ADPCFG = 0;
  ADCON1 = 0x00E4;
  ADCON2 = 0x0400 | 4 << 2;
  ADCON3 = 0x0100 | 9;
  ADCSSL = 0x111C;
  IFS0bits.ADIF = 0;
  IEC0bits.ADIE = 1;
  ADCON1bits.ADON = 1;
  while (1);
}
)",
                   0.2};

// counts what it receives at 115200 baud, while a handler of 1 ms runs every 10 ms
const Driver kSerial{R"(
unsigned int received;
void _ISR _U1RXInterrupt(void)
{
  IFS0bits.U1RXIF = 0;
  while (U1STAbits.URXDA) { U1TXREG = U1RXREG; received++; }
}
void _ISR _T1Interrupt(void)
{
  int i;
  IFS0bits.T1IF = 0;
  for (i = 0; i < 1800; i++) Nop();
}
int main(void)
{
  INTCON1bits.NSTDIS = 0;
  IPC2bits.U1RXIP = 5;
  IPC0bits.T1IP = 3;
  U1BRG = 7;
  U1MODEbits.UARTEN = 1;
  U1STAbits.UTXEN = 1;
  IEC0bits.U1RXIE = 1;
  PR1 = 575;
  T1CON = 0x8030;
  IEC0bits.T1IE = 1;
  while (1);
}
)",
                     0.3, std::string(300, 'x')};

// writes a register of the camera again and again
const Driver kBus{R"(
int answered;
static void put(unsigned char byte) {
  I2CTRN = byte;
  while (I2CSTATbits.TRSTAT);
  answered += !I2CSTATbits.ACKSTAT;
}
int main(void)
{
  int i;
  TRISCbits.TRISC13 = 0;
  LATCbits.LATC13 = 1;
  for (i = 0; i < 10000; i++) Nop();
  I2CBRG = 150;
  I2CCONbits.I2CEN = 1;
  for (i = 0; i < 10; i++) {
    I2CCONbits.SEN = 1; while (I2CCONbits.SEN);
    put(0xDC); put(0x00);
    I2CCONbits.PEN = 1; while (I2CCONbits.PEN);
  }
  while (1) Nop();
}
)",
                  0.1};

struct Mutation {
  const char* name;
  const Driver* driver;
  const char* was;
  const char* is;
  std::string expected;  // diagnoses and traps' sentences, line by line
};

/// A line about each motor; @ is the motor.
std::string of_both(const std::string& what, const std::string& says) {
  const auto line = [&](const char* pins, const char* motor) {
    const std::size_t at = says.find('@');
    return std::string(pins) + ": " + what + ": " + says.substr(0, at) + motor + says.substr(at + 1) + "\n";
  };
  return line("LATD0-3", "left motor") + line("LATD4-7", "right motor");
}
std::string driven_input(const std::string& port, const std::string& pin) {
  return "TRIS" + port + pin + ": input driven: LAT" + port + pin + " is written again and again, but TRIS" +
         port + pin +
         " = 1 makes the pin an input: nothing reaches it; clear the TRIS bit, or call e_init_port() first\n";
}
std::string driven_inputs() {
  std::string all;
  for (const char* pin : {"1", "5", "2", "6", "0", "4", "3", "7"}) all += driven_input("D", pin);
  return all;
}
std::string long_pulse(const std::string& ms) {
  return "LATF7: IR pulse too long: pulse_IR0 stays high for " + ms +
         " ms: its two IR emitters draw 100 mA all the time; lower the pulse after the lit sample, 0.3 ms "
         "after it rose\n";
}
std::string not_cleared(const std::string& vector, const std::string& flag) {
  return vector + ": flag never cleared: the handler of " + vector + " returns without clearing " + flag +
         ", so it is entered again at once and the main program hardly runs; clear the flag in the handler\n";
}
std::string missed(const std::string& vector, const std::string& meanwhile) {
  return vector + ": missed interrupt: " + vector +
         ": an event came while its flag was still set and enabled; the handler runs once for several (too "
         "slow, or held "
         "off too long); meanwhile " +
         meanwhile +
         "; make the handler shorter, raise its priority, or allow nesting (INTCON1.NSTDIS = 0)\n";
}
const std::string kLostSteps = of_both("lost steps",
                                       "the @'s coil pattern jumps by two phases: the rotor does not follow "
                                       "and the step is lost; go through the patterns 1010, "
                                       "0110, 0101, 1001 (D C B A) one after the other");
const std::string kTooFast = of_both("steps too fast",
                                     "the @ is stepped faster than 1100 steps/s: the rotor does not follow "
                                     "and steps are lost; e-pucks hold 1000 steps/s; "
                                     "check the timer's period and prescaler");
const std::string kOverrun =
    "U1STA.OERR: UART overrun: U1RX: a fifth word came while four waited in U1RXREG; it is lost, and "
    "reception stops until "
    "U1STA.OERR is cleared; read UxRXREG in the receive interrupt until URXDA is 0, and clear UxSTA.OERR\n";
const std::string kI2cAdvice =
    "; set I2CCON.I2CEN, then wait until SEN, RSEN, PEN, RCEN, ACKEN and I2CSTAT.TRSTAT are 0\n";

const Mutation kMutations[] = {
    {"wrong_phase_order", &kMotors, "{0x0A, 0x06, 0x05, 0x09}", "{0x0A, 0x05, 0x06, 0x09}", kLostSteps},
    {"both_ends_of_a_coil", &kMotors, "{0x0A, 0x06, 0x05, 0x09}", "{0x0A, 0x0C, 0x05, 0x03}",
     of_both("opposed coil ends",
             "both ends of a coil of the @ are high: no current flows in it; one of A and B and one of C and "
             "D are high at a "
             "time") +
         kLostSteps},
    {"missing_tris", &kMotors, "TRISD &= 0xFF00;", "", driven_inputs()},
    {"motor_flag_never_cleared", &kMotors, "IFS1bits.T4IF = 0;\n  if", "if",
     kLostSteps + not_cleared("T4", "IFS1.T4IF") + kTooFast},
    {"wrong_prescaler", &kMotors, "TCKPS = 3", "TCKPS = 1", kTooFast},
    {"coils_on_at_rest", &kMotors, "T4CONbits.TON = 0;\n    LATD &= 0xFF00;", "T4CONbits.TON = 0;",
     of_both("coils energised at rest",
             "both coils of the @ stay on for more than 1000 ms without a step and draw 120 mA; switch the "
             "four pins off "
             "while the motor rests")},
    {"misspelt_handler", &kMotors, "_T4Interrupt", "_Timer4Interrupt",
     "the interrupt of T4 is enabled, but the program has no _T4Interrupt(), so the processor resets\n"},
    {"pulse_never_lowered", &kInfrared, "lit = convert(8);\n  LATFbits.LATF7 = 0;", "lit = convert(8);",
     long_pulse("191.2")},
    {"channel_left_digital", &kInfrared, "ADPCFG = 0;", "ADPCFG = 0xFFFF;",
     "AN8: analogue channel left digital: AN8 is converted, but ADPCFG.PCFG8 = 1 makes it a digital input; "
     "clear the "
     "channel's ADPCFG bit and set its TRIS bit\n"},
    {"infrared_pin_left_input", &kInfrared, "TRISFbits.TRISF7 = 0;", "", driven_input("F", "7")},
    {"handler_too_slow", &kInfrared, "i < 600; i++) Nop();",
     "i < 30000; i++) { Nop(); Nop(); Nop(); Nop(); }",
     long_pulse("14.3") + missed("T1", "_T1Interrupt() (main.c:26) ran")},
    {"converter_flag_never_cleared", &kScan, "IFS0bits.ADIF = 0;\n  frames++;", "frames++;",
     not_cleared("ADC", "IFS0.ADIF") + missed("ADC", "_ADCInterrupt() (main.c:11) ran")},
    {"wrong_divisor", &kSerial, "U1BRG = 7;", "U1BRG = 8;",
     "U1BRG: baud rate error: U1BRG = 8 gives 102400 baud, -11.1 % from the nearest usual rate, 115200; "
     "UxBRG = FCY / (16 "
     "baud) - 1 with FCY = 14745600 Hz: 7 for 115200, 95 for 9600\n"},
    {"received_words_never_read", &kSerial, "while (U1STAbits.URXDA) { U1TXREG = U1RXREG; received++; }",
     "received++;", kOverrun},
    {"nesting_off", &kSerial, "NSTDIS = 0", "NSTDIS = 1", kOverrun},
    {"wrong_priority", &kSerial, "U1RXIP = 5", "U1RXIP = 2", kOverrun},
    {"stop_missing", &kBus, "I2CCONbits.PEN = 1; while (I2CCONbits.PEN);", "",
     "I2CCON.PEN: I2C bus not stopped: a transfer begins although the one before was not ended by a stop "
     "condition; end "
     "each transfer with I2CCON.PEN (e_i2c_stop()), or go on with RSEN\n"},
    {"module_not_switched_on", &kBus, "I2CCONbits.I2CEN = 1;", "",
     "I2CCON.I2CEN: I2C misuse: an I2C operation is asked for while I2CCON.I2CEN = 0; nothing happens" +
         kI2cAdvice},
    {"byte_before_the_start_is_over", &kBus, "while (I2CCONbits.SEN);", "",
     "I2CSTAT.IWCOL: I2C misuse: I2C: a byte is asked for while another operation is under way; it is "
     "ignored and "
     "I2CSTAT.IWCOL set" +
         kI2cAdvice},
};

std::string changed(const std::string& text, const std::string& was, const std::string& is) {
  const auto place = text.find(was);
  EXPECT_NE(place, std::string::npos) << was;
  EXPECT_EQ(text.find(was, place + 1), std::string::npos) << "twice: " << was;
  return place == std::string::npos ? text : std::string(text).replace(place, was.size(), is);
}

class MutationTest : public OwnDrivers {
 protected:
  Robot& run(const std::string& source, const Driver& driver) {
    Robot& robot = add_robot_with_source(program(source));
    run_for(0.05);
    if (!driver.serial.empty()) robot.uart(1).send(driver.serial);
    run_for(driver.seconds - 0.05);
    return robot;
  }
};

class Mutated : public MutationTest, public ::testing::WithParamInterface<Mutation> {};
class Right : public MutationTest,
              public ::testing::WithParamInterface<std::pair<const char*, const Driver*>> {};

TEST_P(Mutated, driver_is_named_by_its_fault) {
  const Mutation& m = GetParam();
  Robot& robot = run(changed(m.driver->source, m.was, m.is), *m.driver);
  std::string said = robot.diagnoses_text();
  for (const auto& trap : robot.traps()) said += trap.message + "\n";
  EXPECT_EQ(said, m.expected);
}

TEST_P(Right, driver_has_nothing_said_about_it) {
  run(GetParam().second->source, *GetParam().second);
  expect_no_traps();
  expect_no_diagnoses();
}

INSTANTIATE_TEST_SUITE_P(Drivers, Mutated, ::testing::ValuesIn(kMutations),
                         [](const auto& p) { return std::string(p.param.name); });
INSTANTIATE_TEST_SUITE_P(Drivers, Right,
                         ::testing::Values(std::pair{"motors", &kMotors}, std::pair{"infrared", &kInfrared},
                                           std::pair{"scan", &kScan}, std::pair{"serial", &kSerial},
                                           std::pair{"bus", &kBus}),
                         [](const auto& p) { return std::string(p.param.first); });

// --- faults that no register shows: the figure that they spoil

// five conversions of 15 x 5 cycles an interrupt; a wrong SMPI interrupts after another number of them
TEST_F(MutationTest, wrong_smpi_shows_in_the_rate_of_frames) {
  struct Run : MutationTest {
    void TestBody() override {}
    double frames_a_second(const std::string& source) {
      Robot& robot = add_robot_with_source(program(source));
      run_for(0.1);
      const auto before = robot.variable<std::uint16_t>("frames");
      const double start_s = now_s();
      run_for(0.5);
      return (robot.variable<std::uint16_t>("frames") - before) / (now_s() - start_s);
    }
  } right, wrong;
  const double rate = 14745600.0 / (15 * 5 * 5);
  EXPECT_NEAR(right.frames_a_second(kScan.source), rate, 5);
  EXPECT_NEAR(wrong.frames_a_second(changed(kScan.source, "4 << 2", "3 << 2")), rate * 5 / 4, 5);
}

// the fourth result is IR 0, which a wall in front changes; a wrong list files a microphone there
TEST_F(MutationTest, wrong_scan_list_shows_in_the_inputs_that_answer) {
  Robot& right = add_robot_with_source(program(kScan.source));
  Robot& wrong = add_robot_with_source(program(changed(kScan.source, "0x111C", "0x113E"))).at(0.5, 0);
  run_for(0.1);
  EXPECT_GT(right.variable("ir0"), 4000);  // nothing shines
  EXPECT_LT(wrong.variable("ir0"), 3000);  // a microphone or an axis
}

}  // namespace
}  // namespace own_drivers
