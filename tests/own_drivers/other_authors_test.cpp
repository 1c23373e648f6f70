// SPDX-License-Identifier: MIT
// What public e-puck programs do beside the library's functions, found by building such programs: registers
// by pointer and by number, assembler on variables, flags that are not volatile, configuration words.
// Expectations from the chip's documents.
#include "tests/own_drivers/fixture.h"
#include "tests/support/wording.h"

namespace own_drivers {
namespace {

// as the library's converter handler: the results are fetched by a pointer that walks over the buffers
TEST_F(OwnDrivers, results_are_read_by_a_pointer_to_the_first_buffer) {
  Robot& robot = add_robot_with_source(program(R"(
int counts[6], done;
void __attribute__((interrupt, auto_psv)) _ADCInterrupt(void)
{
  volatile unsigned int *buffer = &ADCBUF0;
  int i;
  IFS0bits.ADIF = 0;
  for (i = 0; i < 6; i++) counts[i] = *buffer++;
  done++;
}
int main(void)
{
  ADPCFG = 0;
  ADCON1 = 0x00E4;
  ADCON2 = 0x0400 | (6 - 1) << 2;
  ADCON3 = 0x0108;
  ADCSSL = 0x00FC;
  IEC0bits.ADIE = 1;
  ADCON1bits.ADON = 1;
  while (done < 100);
  ADCON1bits.ADON = 0;
  while (1);
}
)"));
  run_for(0.1);
  const auto counts = robot.variables("counts", 6);
  for (int m = 0; m < 3; ++m) EXPECT_NEAR(counts[static_cast<std::size_t>(m)], 2048, 20);
  EXPECT_NEAR(counts[3], counts[4], 20);  // level: no acceleration along either axis
  EXPECT_GT(counts[5], counts[3] + 500);  // 1 g
  expect_no_traps();
}

// a table of registers, a register given to a function, and one that lies in no header: LATA is at 0x2C4,
// TRISA at 0x2C0, both as on the chip
TEST_F(OwnDrivers, registers_are_reached_by_tables_arguments_and_numbers) {
  Robot& robot = add_robot_with_source(program(R"(
static volatile unsigned int *const directions[2] = {&TRISA, &TRISC};
static void set_bit(volatile unsigned int *port, int bit) { *port |= 1 << bit; }
unsigned int address, through_table;
int main(void)
{
  int i;
  for (i = 0; i < 2; i++) *directions[i] = 0;
  through_table = *directions[1];
  set_bit(&LATA, 6);
  *(volatile unsigned int *)0x02C4 |= 1 << 7;
  address = (unsigned int)&LATA;
  while (1);
}
)"));
  run_for(0.02);
  EXPECT_TRUE(robot.led(0));
  EXPECT_TRUE(robot.led(1));
  EXPECT_FALSE(robot.led(2));
  EXPECT_EQ(robot.variable<std::uint16_t>("address"), 0x2C4);
  EXPECT_EQ(robot.variable<std::uint16_t>("through_table"), 0);
  expect_no_traps();
}

TEST_F(OwnDrivers, pointers_to_memory_stay_pointers_to_memory_beside_them) {
  Robot& robot = add_robot_with_source(program(R"(
int table[4] = {1, 2, 3, 4}, sum, *walk;
static int take(int *p) { return *p; }
int main(void)
{
  int *volatile p = (int *)&PORTG;
  for (walk = table; walk < table + 4; walk++) { sum += take(walk); *walk = 0; }
  sum += *p & 0;
  while (1);
}
)"));
  run_for(0.02);
  EXPECT_EQ(robot.variable("sum"), 10);
  for (int v : robot.variables("table", 4)) EXPECT_EQ(v, 0);
  expect_no_traps();
}

// as the library's e_sound.c, and drivers that clear their flags so: LED 0 is RA6, T1IF is bit 3 of IFS0
TEST_F(OwnDrivers, assembler_changes_variables_and_registers_in_place) {
  Robot& robot = add_robot_with_source(program(R"(
int busy, stopped = 5, up = 7, down = 7, flags = 0x0F0F;
unsigned char bytes[2] = {0xFF, 0xFF};
unsigned int ticks;
void _ISR _T1Interrupt(void)
{
  asm volatile("bclr.b _IFS0bits, #3");
  ticks++;
}
int main(void)
{
  asm("setm   _busy");
  asm("clr\t_stopped");
  asm volatile ("inc _up\n\tinc2 _up");
  __asm__ volatile("dec _down");
  asm("bset _flags,#15"); asm("bclr _flags, #0"); asm("btg _flags, #4");
  asm("clr.b _bytes+1");
  asm("bclr _TRISA, #6"); asm("bset.b _LATA,#6");
  asm("repeat #99\n nop");
  PR1 = 14745;
  T1CON = 0x8000;
  _T1IE = 1;
  while (1);
}
)"));
  run_for(0.1);
  EXPECT_EQ(robot.variable("busy"), -1);
  EXPECT_EQ(robot.variable("stopped"), 0);
  EXPECT_EQ(robot.variable("up"), 10);
  EXPECT_EQ(robot.variable("down"), 6);
  EXPECT_EQ(robot.variable<std::uint16_t>("flags"), 0x8F1E);
  EXPECT_EQ(robot.variables<std::uint8_t>("bytes", 2), (std::vector<std::uint8_t>{0xFF, 0}));
  EXPECT_TRUE(robot.led(0));
  // 14746 cycles are a millisecond, of which the start-up took some
  EXPECT_NEAR(robot.variable<std::uint16_t>("ticks"), now_s() * 1000, 1.5);
  expect_no_traps();
}

// the converter's driver counts its interrupts, about 15,280 a second; programs wait for the count, declared
// plainly, in loops that do something beside
TEST_F(OwnDrivers, plain_variables_of_drivers_are_read_each_round) {
  Robot& robot = add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
extern unsigned int tickAdcIsr;
volatile int started, passed;
unsigned int rounds, seen;
int main(void) {
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  tickAdcIsr = 0;
  started = 1;
  while (tickAdcIsr < 1000);
  passed = 1;
  tickAdcIsr = 0;
  while (tickAdcIsr < 1000) { rounds++; seen = tickAdcIsr; }
  passed = 2;
  while (1);
}
)");
  ASSERT_TRUE(run_until([&] { return robot.variable("started") == 1; }, 1));
  run_for(0.055);
  EXPECT_EQ(robot.variable("passed"), 0);
  run_for(0.02);
  EXPECT_EQ(robot.variable("passed"), 1);
  run_for(0.1);
  EXPECT_EQ(robot.variable("passed"), 2);
  EXPECT_NEAR(robot.variable<std::uint16_t>("seen"), 1000, 1);
  expect_no_traps();
}

TEST_F(OwnDrivers, a_plain_flag_that_an_own_handler_sets_is_seen_in_the_main_loop) {
  Robot& robot = add_robot_with_source(program(R"(
static int tick;
int twice;
void _ISRFAST _T3Interrupt(void) { _T3IF = 0; tick = 1; }
int main(void)
{
  int half = 0;
  PR3 = 57599; T3CON = 0x8030; _T3IE = 1;   /* 1 s */
  for (;;) {
    if (!tick) continue;
    tick = 0;
    if (++half == 2) { half = 0; twice++; }
  }
}
)"));
  run_for(6.5);
  EXPECT_EQ(robot.variable("twice"), 3);
  expect_no_traps();
}

// as the library's I2C driver: a start is made only after a stop, which no start has seen yet; the failure
// makes the program send a stop, reset the module and try again. PO3030K: device 0xDC, register 0 holds 0x30
TEST_F(OwnDrivers, an_i2c_driver_that_waits_for_a_stop_before_its_first_start) {
  Robot& robot = add_robot_with_source(program(R"(
volatile char mode;
unsigned char id;
int tries;
void __attribute__((__interrupt__, auto_psv)) _MI2CInterrupt(void) { IFS0bits.MI2CIF = 0; mode = 0; }
static int done(void) { long i; for (i = 10000; i; i--) if (!mode) return 1; return 0; }
static void reset(void)
{
  I2CCONbits.I2CEN = 0;
  I2CBRG = 150;
  I2CCONbits.I2CEN = 1;
  IFS0bits.MI2CIF = 0;
  IEC0bits.MI2CIE = 1;
}
static int start(void) { mode = 1; if (!I2CSTATbits.P) return 0; I2CCONbits.SEN = 1; return done(); }
static int restart(void) { mode = 1; if (!I2CSTATbits.S) return 0; I2CCONbits.RSEN = 1; return done(); }
static int put(int byte) { mode = 1; I2CTRN = byte; return done(); }
static int get(void) { mode = 1; I2CCONbits.RCEN = 1; if (!done()) return 0; id = I2CRCV; return 1; }
static int stop(void) { mode = 1; I2CCONbits.PEN = 1; return done(); }
int main(void)
{
  int good = 0;
  reset();
  while (!good && tries < 5) {
    good = start();
    good &= put(0xDC);
    good &= put(0);
    good &= restart();
    good &= put(0xDD);
    good &= get();
    mode = 1; I2CCONbits.ACKDT = 1; I2CCONbits.ACKEN = 1; done();
    stop();
    tries++;
    if (!good) reset();
  }
  while (1);
}
)"));
  run_for(0.5);
  EXPECT_EQ(robot.variable("tries"), 2);
  EXPECT_EQ(robot.variable<std::uint8_t>("id"), 0x30);
  expect_no_traps();
}

// settings and functions under the names of the vendor's peripheral library: 28800 ticks of 256 cycles are
// half a second
TEST_F(OwnDrivers, the_peripheral_librarys_names_set_timers_converter_and_uart) {
  Robot& robot = add_robot_with_source(R"(
#include <xc.h>
#include <adc12.h>
#include <timer.h>
#include <uart.h>
uint8_t halves;
unsigned int counts, con3;
void __attribute__((interrupt, no_auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; halves++; WriteUART1('t'); }
int main(void)
{
  OpenUART1(UART_EN & UART_IDLE_CON & UART_DIS_WAKE & UART_DIS_LOOPBACK & UART_DIS_ABAUD & UART_NO_PAR_8BIT &
                UART_1STOPBIT,
            UART_INT_TX_BUF_EMPTY & UART_TX_PIN_NORMAL & UART_TX_ENABLE & UART_INT_RX_CHAR & UART_ADR_DETECT_DIS &
                UART_RX_OVERRUN_CLEAR,
            7);
  putsUART1((unsigned int *) "hello ");
  ADPCFG = 0;
  ADCHS = 2;
  ADCON3 = ADC_SAMPLE_TIME_0 & ADC_CONV_CLK_SYSTEM & ADC_CONV_CLK_10Tcy;
  ADCON2 = ADC_VREF_AVDD_AVSS & ADC_SCAN_OFF & ADC_SAMPLES_PER_INT_1 & ADC_ALT_BUF_OFF & ADC_ALT_INPUT_OFF;
  ADCON1 = ADC_MODULE_ON & ADC_IDLE_STOP & ADC_FORMAT_INTG & ADC_CLK_MANUAL & ADC_AUTO_SAMPLING_OFF & ADC_SAMP_OFF;
  con3 = ADCON3;
  ADCON1bits.SAMP = 1;
  __delay32(100);
  ADCON1bits.SAMP = 0;
  while (!ADCON1bits.DONE);
  counts = ADCBUF0;
  ConfigIntTimer1(T1_INT_PRIOR_5 & T1_INT_ON);
  OpenTimer1(T1_ON & T1_GATE_OFF & T1_PS_1_256 & T1_SYNC_EXT_OFF & T1_SOURCE_INT, 28799);
  while (1);
}
)");
  run_for(1.25);
  EXPECT_EQ(robot.variable<std::uint8_t>("halves"), 2);
  EXPECT_EQ(robot.uart(1).text(), "hello tt");
  EXPECT_EQ(robot.variable<std::uint16_t>("con3"), 19);  // TAD = 20 halves of a cycle
  EXPECT_NEAR(robot.variable<std::uint16_t>("counts"), 2048, 10);
  expect_no_traps();
}

// 32 bits: 100000 cycles are 0x186A0; the upper half is latched when the lower one is read
TEST_F(OwnDrivers, the_peripheral_librarys_names_set_timers_of_32_bits_and_receive) {
  Robot& robot = add_robot_with_source(R"(
#include <xc.h>
#include <timer.h>
#include <uart.h>
unsigned int fired, left, stands, got;
unsigned long first, later;
char text[4];
void __attribute__((interrupt, no_auto_psv)) _T3Interrupt(void) { IFS0bits.T3IF = 0; fired++; }
void __attribute__((interrupt(irq(22)), no_auto_psv)) fifth(void) { IFS1bits.T5IF = 0; fired += 16; }
int main(void)
{
  ConfigIntTimer23(T3_INT_PRIOR_5 & T3_INT_ON);
  OpenTimer23(T2_ON & T2_GATE_OFF & T2_PS_1_1 & T2_SOURCE_INT, 99999);
  ConfigIntTimer45(T5_INT_PRIOR_4 & T5_INT_ON);
  OpenTimer45(T4_ON & T4_GATE_OFF & T4_PS_1_1 & T4_SOURCE_INT, 199999);
  OpenUART1(UART_EN & UART_IDLE_CON & UART_DIS_WAKE & UART_DIS_LOOPBACK & UART_DIS_ABAUD & UART_NO_PAR_8BIT &
                UART_1STOPBIT,
            UART_INT_TX_BUF_EMPTY & UART_TX_PIN_NORMAL & UART_TX_ENABLE & UART_INT_RX_CHAR & UART_ADR_DETECT_DIS &
                UART_RX_OVERRUN_CLEAR,
            7);
  while (fired < 2 + 16);
  CloseTimer23();
  CloseTimer45();
  WriteTimer23(0x12345678);
  first = ReadTimer23();
  stands = fired;
  left = getsUART1(3, (unsigned int *)text, 50);
  while (getsUART1(3, (unsigned int *)text, 65000)) continue;
  got = 1;
  while (1);
}
)");
  run_for(0.1);
  EXPECT_EQ(robot.variable<std::uint16_t>("stands"), 2 + 16);
  EXPECT_EQ(robot.variable<std::uint32_t>("first"), 0x12345678u);
  EXPECT_EQ(robot.variable<std::uint16_t>("left"), 3);
  EXPECT_EQ(robot.variable<std::uint16_t>("got"), 0);
  robot.uart(1).send("xyz");
  run_for(0.1);
  EXPECT_EQ(robot.variable<std::uint16_t>("got"), 1);
  EXPECT_EQ(robot.variable<std::uint8_t>("text"), 'x');
  expect_no_traps();
}

// --- configuration words

std::string configured(const std::string& words, const std::string& rest) {
  return "#include \"p30F6014A.h\"\n" + words + "\n" + rest;
}

// watchdog on, postscalers 8 and 4: 2 ms x 8 x 4 = 64 ms
TEST_F(OwnDrivers, the_watchdog_of_the_configuration_bites_a_program_that_forgets_it) {
  const std::string words = "_FWDT(WDT_ON & WDTPSA_8 & WDTPSB_4)\n";
  const std::string head =
      "int __attribute__((persistent)) nothing;\nint main(void) {\n"
      "  TRISA = 0;\n  if (RCONbits.WDTO) LATAbits.LATA6 = 1;\n";
  Robot& forgets = add_robot_with_source(configured(words, head + "  while (1);\n}\n"));
  Robot& clears = add_robot_with_source(configured(words, head + "  while (1) ClrWdt();\n}\n")).at(0.5, 0);
  Robot& off = add_robot_with_source(configured("_FWDT(WDT_OFF);", head + "  while (1);\n}\n")).at(1, 0);
  run_for(0.06);
  EXPECT_FALSE(forgets.led(0));
  run_for(0.01);
  EXPECT_TRUE(forgets.led(0));
  run_for(0.5);
  EXPECT_FALSE(clears.led(0));
  EXPECT_FALSE(off.led(0));
  EXPECT_TRUE(clears.traps().empty());
}

// 14745 x 1000 cycles: 1 s at XT_PLL8, half a second at XT_PLL16, two at XT_PLL4; and U1BRG = 15 gives 115200
// baud at twice the clock
TEST_F(OwnDrivers, the_multiplier_of_the_crystal_sets_the_instruction_rate) {
  const std::string rest = R"(
unsigned int ticks;
void _ISR _T1Interrupt(void) { _T1IF = 0; ticks++; }
int main(void)
{
  U1BRG = 15;
  U1MODEbits.UARTEN = 1;
  U1STAbits.UTXEN = 1;
  U1TXREG = 'x';
  PR1 = 14744;
  T1CON = 0x8000;
  _T1IE = 1;
  while (1);
}
)";
  Robot& usual = add_robot_with_source(configured("_FOSC(CSW_FSCM_OFF & XT_PLL8);", rest));
  Robot& twice = add_robot_with_source(configured("_FOSC(CSW_FSCM_OFF & XT_PLL16);", rest)).at(0.5, 0);
  Robot& half = add_robot_with_source(configured("_FOSC(CSW_FSCM_OFF & XT_PLL4);", rest)).at(1, 0);
  Robot& internal = add_robot_with_source(configured("_FOSC(CSW_FSCM_OFF & FRC_PLL8);", rest)).at(1.5, 0);
  run_for(2);
  EXPECT_NEAR(usual.variable<std::uint16_t>("ticks"), 2000, 1);
  EXPECT_NEAR(twice.variable<std::uint16_t>("ticks"), 4000, 1);
  EXPECT_NEAR(half.variable<std::uint16_t>("ticks"), 1000, 1);
  EXPECT_NEAR(internal.variable<std::uint16_t>("ticks"), 2000, 1);
  EXPECT_EQ(twice.diagnoses_text().find("baud"), std::string::npos) << twice.diagnoses_text();
  expect_no_traps();
}

TEST_F(OwnDrivers, the_words_may_be_given_by_pragmas) {
  const std::string rest = R"(
unsigned int ticks;
void _ISR _T1Interrupt(void) { _T1IF = 0; ticks++; }
int main(void)
{
  TRISA = 0;
  if (RCONbits.WDTO) LATAbits.LATA6 = 1;
  PR1 = 14744;
  T1CON = 0x8000;
  _T1IE = 1;
  while (1);
}
)";
  Robot& fast = add_robot_with_source(configured(
      "#pragma config FOSFPR = XT_PLL16, FCKSMEN = CSW_FSCM_OFF\n#pragma config WDT = WDT_OFF\n", rest));
  Robot& dog = add_robot_with_source(
                   configured("#pragma config FWPSA = WDTPSA_8\n#pragma config FWPSB = WDTPSB_4 // 64 ms\n"
                              "#pragma config WDT = WDT_ON, BODENV = BORV20\n",
                              rest))
                   .at(0.5, 0);
  run_for(0.1);
  EXPECT_NEAR(fast.variable<std::uint16_t>("ticks"), now_s() * 2000, 1.5);
  EXPECT_FALSE(fast.led(0));
  EXPECT_TRUE(dog.led(0));
}

// an e-puck has no external clock, so nothing would run
TEST_F(OwnDrivers, a_clock_that_the_robot_has_not_is_told) {
  Robot& robot =
      add_robot_with_source(configured("_FOSC(CSW_FSCM_OFF & EC_PLL8);", "int main(void) { while (1); }\n"));
  run_for(0.02);
  ASSERT_EQ(robot.traps().size(), 1u);
  EXPECT_TRUE(wording::reads(robot.traps()[0].message,
                             "configuration word FOSC: got 0xFFEE, a source of clock that the robot has not, "
                             "expected its crystal of 7.3728 MHz, as with XT_PLL8"));
}

}  // namespace
}  // namespace own_drivers
