// SPDX-License-Identifier: MIT
// What programs for this family of chips do with the compiler's own means: standard output, data EEPROM,
// tables in program memory, the second vector table, registers by attribute, blocks of registers, assembler.
// Expectations from the documents of chip and compiler.
#include "tests/own_drivers/fixture.h"
#include "tests/support/wording.h"

namespace own_drivers {
namespace {

TEST_F(OwnDrivers, printf_goes_to_the_uart_that_c30_uart_names) {
  Robot& robot = add_robot_with_source(program(R"(
#include <stdio.h>
#include <libpic30.h>
int main(void)
{
  U1BRG = U2BRG = 7;
  U1MODEbits.UARTEN = U2MODEbits.UARTEN = 1;
  U1STAbits.UTXEN = U2STAbits.UTXEN = 1;
  printf("one %d\n", 1);
  __C30_UART = 2;
  printf("two %d\n", 2);
  while (1);
}
)"));
  run_for(0.05);
  EXPECT_EQ(robot.uart(1).text(), "one 1\n");
  EXPECT_EQ(robot.uart(2).text(), "two 2\n");
  expect_no_traps();
}

TEST_F(OwnDrivers, a_write_of_the_programs_own_gets_what_is_printed) {
  Robot& robot = add_robot_with_source(program(R"(
#include <stdio.h>
int __attribute__((__section__(".libc"))) write(int handle, void *buffer, unsigned int len)
{
  unsigned int i;
  if (!U1MODEbits.UARTEN) { U1BRG = 7; U1MODEbits.UARTEN = 1; U1STAbits.UTXEN = 1; }
  for (i = 0; i < len; i++) {
    while (!U1STAbits.TRMT);
    U1TXREG = ((char *)buffer)[i] == 'a' ? '0' + handle : ((char *)buffer)[i];
  }
  return len;
}
int main(void)
{
  printf("abc");
  putchar('a');
  puts("!");
  while (1);
}
)"));
  run_for(0.05);
  EXPECT_EQ(robot.uart(1).text(), "1bc1!\n");
  expect_no_traps();
}

// variables of the EEPROM hold what they were given from the beginning, and keep what is written over a reset
TEST_F(OwnDrivers, data_eeprom_is_reached_through_program_addresses) {
  Robot& robot = add_robot_with_source(program(R"(
#include <libpic30.h>
int _EEDATA(_EE_ROW) rows[16] = {0x11, 0x22, 0x33};
int __attribute__((space(eedata))) single = 0x77;
int first[4], second[17], alone, resets;
int main(void)
{
  _prog_addressT at;
  int i, words[16];
  _init_prog_address(at, single);
  _memcpy_p2d16(&alone, at, _EE_WORD);
  _init_prog_address(at, rows);
  if (RCONbits.SWR) {
    _memcpy_p2d16(second, at, _EE_ROW);
    resets = 1;
    while (1);
  }
  _memcpy_p2d16(first, at, 8);
  for (i = 0; i < 16; i++) words[i] = 100 + i;
  _erase_eedata(at, _EE_ROW);
  _wait_eedata();
  _write_eedata_row(at, words);
  _wait_eedata();
  _erase_eedata(at + 2, _EE_WORD);
  _wait_eedata();
  _write_eedata_word(at + 2, 0x1234);
  _wait_eedata();
  asm("reset");
  return 0;
}
)"));
  run_for(0.1);
  EXPECT_EQ(robot.variable("resets"), 1);
  EXPECT_EQ(robot.variable("alone"), 0x77);
  const auto second = robot.variables("second", 16);
  EXPECT_EQ(second[0], 100);
  EXPECT_EQ(second[1], 0x1234);
  EXPECT_EQ(second[15], 115);
}

TEST_F(OwnDrivers, tables_in_program_memory_are_read_by_table_instructions) {
  Robot& robot = add_robot_with_source(program(R"(
const int __attribute__((space(psv))) table[3] = {0x1234, 0x5678, -2};
const unsigned char __attribute__((space(prog))) bytes[2] = {9, 8};
unsigned words[3], pair;
int main(void)
{
  int i;
  unsigned at = __builtin_tbloffset(table);
  TBLPAG = __builtin_tblpage(table);
  for (i = 0; i < 3; i++) words[i] = __builtin_tblrdl(at + 2 * i);
  TBLPAG = __builtin_tblpage(bytes);
  pair = __builtin_tblrdl(__builtin_tbloffset(bytes));
  while (1);
}
)"));
  run_for(0.01);
  const auto words = robot.variables<std::uint16_t>("words", 3);
  EXPECT_EQ(words, (std::vector<std::uint16_t>{0x1234, 0x5678, 0xFFFE}));
  EXPECT_EQ(robot.variable<std::uint16_t>("pair"), 0x0809);
  expect_no_traps();
}

TEST_F(OwnDrivers, alternate_vectors_serve_while_altivt_is_set) {
  Robot& robot = add_robot_with_source(program(R"(
int usual, alternate;
void _ISR _AltT1Interrupt(void) { _T1IF = 0; if (++alternate == 3) INTCON2bits.ALTIVT = 0; }
void _ISR _T1Interrupt(void) { _T1IF = 0; if (++usual == 4) T1CON = 0; }
int main(void)
{
  INTCON2bits.ALTIVT = 1;
  PR1 = 1000;
  T1CON = 0x8000;
  _T1IE = 1;
  while (1);
}
)"));
  run_for(0.01);
  EXPECT_EQ(robot.variable("alternate"), 3);
  EXPECT_EQ(robot.variable("usual"), 4);
  expect_no_traps();
}

TEST_F(OwnDrivers, an_alternate_vector_without_a_function_is_named) {
  Robot& robot = add_robot_with_source(program(R"(
void _ISR _T1Interrupt(void) { _T1IF = 0; }
int main(void)
{
  INTCON2bits.ALTIVT = 1;
  T1CON = 0x8000;
  _T1IE = 1;
  _T1IF = 1;
  while (1);
}
)"));
  run_for(0.01);
  ASSERT_EQ(robot.traps().size(), 1u);
  EXPECT_TRUE(wording::reads(
      robot.traps()[0].message,
      "the interrupt of T1 is enabled, but the program has no _AltT1Interrupt(), so the processor resets"));
}

TEST_F(OwnDrivers, the_default_interrupt_takes_what_has_no_handler) {
  Robot& robot = add_robot_with_source(program(R"(
#include <libpic30.h>
int taken, own;
void _ISR _DefaultInterrupt(void) { taken++; IFS0 = 0; IFS1 = 0; }
void _ISR _T3Interrupt(void) { own++; _T3IF = 0; }
int main(void)
{
  _T2IE = 1; _INT1IE = 1; _T3IE = 1;
  _T2IF = 1;
  __delay32(100); /* each is served before the next one comes, or the handler would clear that, too */
  _INT1IF = 1;
  __delay32(100);
  _T3IF = 1;
  while (1);
}
)"));
  run_for(0.01);
  EXPECT_EQ(robot.variable("taken"), 2);
  EXPECT_EQ(robot.variable("own"), 1);
  expect_no_traps();
}

// LATA is at 0x2C4, TRISA at 0x2C0; a place in memory has no effect
TEST_F(OwnDrivers, a_variable_that_is_placed_at_a_register_is_that_register) {
  Robot& robot = add_robot_with_source(program(R"(
volatile unsigned int __attribute__((address(0x2C4))) leds;
extern volatile unsigned int __attribute__((__sfr__(0x2C0))) directions;
int __attribute__((address(0x1000))) plain = 3;
int main(void)
{
  directions &= ~(1 << 6);
  leds |= 1 << 6;
  plain++;
  while (1);
}
)"));
  run_for(0.01);
  EXPECT_TRUE(robot.led(0));
  EXPECT_EQ(robot.variable("plain"), 4);
  expect_no_traps();
}

// as drivers for several sensors do that take a whole scan at once
TEST_F(OwnDrivers, memcpy_reads_a_block_of_registers) {
  Robot& robot = add_robot_with_source(program(R"(
#include <string.h>
int counts[6], done;
unsigned int masks[3];
void __attribute__((interrupt, auto_psv)) _ADCInterrupt(void)
{
  IFS0bits.ADIF = 0;
  memcpy(counts, (char *)&ADCBUF0, 6 * sizeof(int));
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
  IPC0 = 0x1234; IPC1 = 0x5671;
  memcpy(masks, (void *)&IPC0, 4);
  memset((void *)&IPC0, 0, 4);
  masks[2] = IPC1;
  while (1);
}
)"));
  run_for(0.1);
  const auto counts = robot.variables("counts", 6);
  for (int m = 0; m < 3; ++m) EXPECT_NEAR(counts[static_cast<std::size_t>(m)], 2048, 20);
  EXPECT_GT(counts[5], counts[3] + 500);  // 1 g
  const auto masks = robot.variables<std::uint16_t>("masks", 3);
  EXPECT_EQ(masks, (std::vector<std::uint16_t>{0x1234, 0x5671, 0}));
  expect_no_traps();
}

TEST_F(OwnDrivers, time_counts_cycles_in_timers_2_and_3) {
  Robot& robot = add_robot_with_source(program(R"(
#include <time.h>
#include <libpic30.h>
long first, later, again, ticks;
int main(void)
{
  time_t t;
  first = time(0);
  __delay32(1000000);
  later = time(&t);
  again = t;
  ticks = clock() - later;
  while (1);
}
)"));
  run_for(0.1);
  EXPECT_LT(robot.variable<std::int32_t>("first"), 20);
  EXPECT_NEAR(robot.variable<std::int32_t>("later"), 1000000, 100);
  EXPECT_EQ(robot.variable<std::int32_t>("again"), robot.variable<std::int32_t>("later"));
  EXPECT_GT(robot.variable<std::int32_t>("ticks"), 0);
  EXPECT_LT(robot.variable<std::int32_t>("ticks"), 200);
  expect_no_traps();
}

TEST_F(OwnDrivers, assembler_names_registers_without_an_underscore_and_has_comments) {
  Robot& robot = add_robot_with_source(program(R"(
int done;
int main(void)
{
  asm("bclr TRISA, #6 ; LED 0\n\tbset LATA,#6");
  __asm__ volatile(".pword 0xDA4000 ; break");
  asm("nop ; a comment\n");
  done = 1;
  while (1);
}
)"));
  run_for(0.01);
  EXPECT_TRUE(robot.led(0));
  EXPECT_EQ(robot.variable("done"), 1);
  expect_no_traps();
}

// the unlock sequences of the manuals: OSCCON takes a byte after two keys, NVMCON.WR is set after two keys
TEST_F(OwnDrivers, assembler_moves_keys_through_working_registers) {
  Robot& robot = add_robot_with_source(program(R"(
int copied, kept = 7, word = 0x1234;
unsigned oscillator, started, after;
int main(void)
{
  asm volatile ("mov #0x46, w0 \n"
                "mov #0x57, w1 \n"
                "mov #_OSCCON,w2 \n"
                "mov.b w0, [w2] \n"
                "mov.b w1, [w2] \n"
                "bset.b [w2],#1;");
  oscillator = OSCCON;
  asm("mov _word, W3");
  asm("push W3");
  asm("mov #5, W3");
  asm("mov.b W3, W0");  /* the upper half stays */
  asm("pop W3");
  asm("mov W3, _copied");
  NVMADRU = 0x7F;
  NVMADR = 0xF000;
  NVMCON = 0x4044;  /* erase a word */
  __asm__ volatile("disi #5\n mov #0x55,W0\n mov W0,NVMKEY\n mov #0xAA,W1\n mov W1,NVMKEY\n bset NVMCON,#WR\n nop\n nop");
  started = NVMCON;
  while (NVMCONbits.WR);
  after = NVMCON;
  while (1);
}
)"));
  run_for(0.05);
  EXPECT_EQ(robot.variable<std::uint16_t>("oscillator") & 2, 2);  // LPOSCEN
  EXPECT_EQ(robot.variable("copied"), 0x1234);
  EXPECT_EQ(robot.variable<std::uint16_t>("started") & 0x8000, 0x8000);
  EXPECT_EQ(robot.variable<std::uint16_t>("after") & 0xA000, 0);  // WR, WRERR
  expect_no_traps();
}

// CN1 is RC13, beside the camera's pins: their edges are none of its business
TEST_F(OwnDrivers, change_notification_does_not_follow_pins_that_it_does_not_watch) {
  Robot& robot = add_robot_with_source(program(R"(
int changes;
void _ISR _CNInterrupt(void) { _CNIF = 0; changes++; }
int main(void)
{
  CNEN1bits.CN1IE = 1;
  _CNIE = 1;
  while (1) Idle();
}
)"));
  run_for(0.1);
  EXPECT_EQ(robot.variable("changes"), 0);
  expect_no_traps();
}

}  // namespace
}  // namespace own_drivers
