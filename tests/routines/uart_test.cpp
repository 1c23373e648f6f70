// SPDX-License-Identifier: MIT
// The UART driver's handlers by heart and as they run: the same words on the line at the same cycles, the
// same course, whatever comes in between and wherever time is cut.
#include "dspic30/core/processor.h"
#include "dspic30/routines/known_routines.h"
#include "tests/dspic30/core_bench.h"
#include "tests/routines/routine_program.h"

namespace {

using namespace routines_test;
using dspic::Cycle;

// both lines send, out of RAM and flash, and one echoes what it gets; a timer's handler comes in between, now
// and then the program masks interrupts for longer than four words take, looks at the module's registers,
// and sends by them
constexpr const char* kTalk = R"(
#include <p30F6014A.h>
#include <uart/e_uart_char.h>
volatile unsigned ticks, turns, sum;
static char text[40];
static volatile unsigned pause;
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; ticks++; }
int main(void)
{
  unsigned char i;
  char c;
  IPC0bits.T1IP = PRIORITY;
  PR1 = 7000;
  IEC0bits.T1IE = 1;
  T1CONbits.TON = 1;
  e_init_uart1();
  e_init_uart2(BAUD230400);
  for (;;) {
    turns++;
    for (i = 0; i < 40; i++) text[i] = (char)(i + turns);
    e_send_uart1_char(text, turns % 40 + 1);
    e_send_uart2_char("out of the flash", turns % 16 + 1);
    while (e_getchar_uart1(&c)) {
      sum = sum * 3 + (unsigned char)c;
      e_send_uart2_char(&c, 1);
      while (e_uart2_sending()) sum += U2STA;
    }
    if (turns % 8 == 0) { SRbits.IPL = 5; for (pause = turns % 64 * 20 + 40; pause; pause--) ; SRbits.IPL = 0; }
    if (turns % 5 == 0) while (e_uart1_sending()) ;
    if (turns % 16 == 0) { while (e_uart1_sending()) ; while (!U1STAbits.TRMT) ; U1TXREG = 'x'; }
  }
}
)";

struct Robot {
  explicit Robot(const dspic::FirmwareFile& file) {
    for (const auto& [address, word] : file.words) program.write(address, word);
    dspic::Configuration c;
    c.program = &program;
    device = std::make_unique<dspic::Dspic30f6014a>(outside, &notes, c);
    cpu = std::make_unique<dspic::Processor>(*device, program);
  }
  /// A word on UART 1's line each 3000 cycles: BRG 7 and so 1280 cycles each.
  void hear(Cycle from, Cycle until) {
    for (Cycle at = (from + 2999) / 3000 * 3000; at < until; at += 3000) {
      dspic::UartFrame frame;
      frame.word = static_cast<std::uint16_t>(at / 3000 * 37 & 0xFF);
      frame.start = at;
      frame.bit = 128;
      device->uart_receive(1, frame, from);
    }
  }
  unsigned word(const dspic::FirmwareFile& file, const char* name) const {
    const unsigned at = file.objects.at(name);
    return cpu->ram(at) | static_cast<unsigned>(cpu->ram(at + 1)) << 8;
  }
  bench::FakeOutside outside;
  bench::Notes notes;
  dspic::ProgramMemory program;
  std::unique_ptr<dspic::Dspic30f6014a> device;
  std::unique_ptr<dspic::Processor> cpu;
};

dspic::FirmwareFile talk(int priority) {
  dspic::FirmwareFile file;
  std::string error, text = kTalk;
  text.replace(text.find("PRIORITY;"), 8, std::to_string(priority));
  EXPECT_TRUE(build(text, file, error)) << error;
  return file;
}

std::array<long, 4> answers;  // of UART 1 out and in, UART 2 out and in
bool counted(dspic::Cpu& cpu, int vector, std::int64_t until) {
  const bool is_done = dspic::uart_handler()(cpu, vector, until);
  constexpr int kIrqs[] = {dspic::irq::U1Tx, dspic::irq::U1Rx, dspic::irq::U2Tx, dspic::irq::U2Rx};
  for (std::size_t i = 0; i < answers.size(); ++i)
    answers[i] += is_done && vector == dspic::kFirstIrqVector + kIrqs[i];
  return is_done;
}
std::shared_ptr<const dspic::KnownCalls> handlers() {
  auto calls = std::make_shared<dspic::KnownCalls>();
  calls->add_handlers(&counted);
  answers = {};
  return calls;
}

bool is_same(const dspic::UartFrame& a, const dspic::UartFrame& b) {
  return a.word == b.word && a.start == b.start && a.bit == b.bit;
}

void expect_same_words(const Robot& a, const Robot& b) {
  for (std::size_t n = 0; n < 2; ++n) {
    const auto &one = a.outside.sent_by[n], &other = b.outside.sent_by[n];
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_TRUE(is_same(one[i], other[i])) << i;
  }
}

constexpr Cycle kEnd = 12000000, kWindow = 50000;

TEST(UartByHeart, is_the_same_on_the_line_and_in_the_program) {
  for (const int priority : {4, 6}) {
    SCOPED_TRACE(priority);
    const dspic::FirmwareFile file = talk(priority);
    Robot plain(file), by_heart(file);
    by_heart.cpu->know(handlers());
    for (Cycle until = kWindow; until <= kEnd; until += kWindow) {
      for (Robot* robot : {&plain, &by_heart}) {
        robot->hear(until - kWindow, until);
        ASSERT_FALSE(robot->cpu->run(until));
      }
      ASSERT_EQ(by_heart.cpu->now(), plain.cpu->now()) << "at " << until;
      ASSERT_EQ(by_heart.cpu->state_hash(), plain.cpu->state_hash()) << "at " << until;
      ASSERT_EQ(by_heart.device->state_hash(until), plain.device->state_hash(until)) << "at " << until;
    }
    expect_same_words(by_heart, plain);
    EXPECT_GT(plain.outside.sent.size(), 4000u);
    constexpr int kIrqs[] = {dspic::irq::U1Tx, dspic::irq::U1Rx, dspic::irq::U2Tx};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t served = plain.device->interrupts().served(dspic::kFirstIrqVector + kIrqs[i]);
      EXPECT_EQ(by_heart.device->interrupts().served(dspic::kFirstIrqVector + kIrqs[i]), served);
      EXPECT_GT(answers[i], served / 2) << i << " of " << served;
    }
    EXPECT_EQ(by_heart.cpu->idle(kEnd), plain.cpu->idle(kEnd));
    EXPECT_GT(plain.word(file, "turns"), 100u);
    EXPECT_EQ(by_heart.notes.all.size(), plain.notes.all.size());
  }
}

// what it sends is what the handlers change: their variables, and the words that they put on the stack
TEST(UartByHeart, sends_what_it_changes_itself) {
  constexpr const char* kSendsItself = R"(
#include <p30F6014A.h>
#include <uart/e_uart_char.h>
int main(void)
{
  int here;
  e_init_uart1();
  for (;;) {
    e_send_uart1_char((char *)0x800, 0x400);
    while (e_uart1_sending()) ;
    e_send_uart1_char((char *)&here - 20, 80);
    while (e_uart1_sending()) ;
  }
}
)";
  dspic::FirmwareFile file;
  std::string error;
  ASSERT_TRUE(build(kSendsItself, file, error)) << error;
  Robot plain(file), by_heart(file);
  by_heart.cpu->know(handlers());
  for (Robot* robot : {&plain, &by_heart}) {
    robot->hear(0, kEnd / 3);
    ASSERT_FALSE(robot->cpu->run(kEnd / 3));
  }
  expect_same_words(by_heart, plain);
  EXPECT_EQ(by_heart.cpu->state_hash(), plain.cpu->state_hash());
  EXPECT_GT(plain.outside.sent.size(), 2200u);
  EXPECT_GT(answers[0], 100);  // of the rest
}

// one way of waiting each, while a line leaves; the handler comes into all of them
struct Waiting {
  const char *name, *code;
  bool is_of_memory;  ///< goes on over handlers
};
constexpr Waiting kWaits[] = {
    {"the driver's own", "e_send_uart1_char(text, 40);", true},
    {"what a handler changes", "e_send_uart1_char(text, 39); while (e_uart1_sending()) ;", true},
    {"a timer's flag", "e_send_uart1_char(text, 40); while (ticks < 9) ; ticks = 0;", true},
    {"through a call", "e_send_uart1_char(text, 38); while (asked() < 9) turns += 0; ticks = 0;", true},
    {"a loop that counts", "e_send_uart1_char(text, 40); for (pause = 5000; pause; pause--) ;", true},
    {"a loop in a register", "e_send_uart1_char(text, 40); { int i; for (i = 0; i < 9000; i++) Nop(); }",
     true},
    {"two loops",
     "e_send_uart1_char(text, 40); { int i, j; for (i = 0; i < 90; i++) for (j = 0; j < 90; j++) Nop(); }",
     true},
    {"few rounds",
     "e_send_uart1_char(text, 40); { int i, j; for (i = 0; i < 900; i++) for (j = 0; j < 9; j++) sum++; }",
     false},
    {"a register of the module", "e_send_uart1_char(text, 5); while (!U1STAbits.TRMT) ;", false},
    {"the driver's counters", "e_send_uart1_char(text, 40); while (peeked() > 3) ; ticks = 0;", false},
    {"with interrupts off",
     "e_send_uart1_char(text, 40); while (ticks < 9) { SRbits.IPL = 6; SRbits.IPL = 0; } ticks = 0;", false},
    {"nothing", "e_send_uart1_char(text, 40); sum = sum * 7 + 1;", false},
    {"a word that comes", "e_send_uart1_char(text, 3); while (!e_ischar_uart1()) ; e_getchar_uart1(text);",
     false},
};
constexpr const char* kWaitingProgram = R"(
#include <p30F6014A.h>
#include <uart/e_uart_char.h>
#define Nop() __asm__ volatile("nop")
volatile unsigned ticks, turns, sum;
static char text[40];
static volatile unsigned pause;
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; ticks++; }
unsigned __attribute__((noinline)) asked(void) { return ticks; }
unsigned __attribute__((noinline)) peeked(void) { return e_uart1_sending() ? 5 : 0; }
int main(void)
{
  IPC0bits.T1IP = 4;
  PR1 = 5477;
  IEC0bits.T1IE = 1;
  T1CONbits.TON = 1;
  e_init_uart1();
  for (;;) { turns++; WAIT }
}
)";

TEST(UartByHeart, waits_go_on_over_handlers_as_if_they_were_found_again) {
  for (const Waiting& waiting : kWaits) {
    SCOPED_TRACE(waiting.name);
    dspic::FirmwareFile file;
    std::string error, text = kWaitingProgram;
    text.replace(text.find("WAIT"), 4, waiting.code);
    ASSERT_TRUE(build(text, file, error)) << error;
    Robot plain(file), by_heart(file);
    by_heart.cpu->know(handlers());
    // windows of any length; what was waited is the same whenever somebody looks
    Cycle until = 0;
    for (unsigned n = 1; until < kEnd / 4; ++n) {
      const Cycle from = until;
      until += n * 2654435761u % 16411 + 1;
      for (Robot* robot : {&plain, &by_heart}) {
        robot->hear(from, until);
        ASSERT_FALSE(robot->cpu->run(until));
      }
      ASSERT_EQ(by_heart.cpu->now(), plain.cpu->now()) << "at " << until;
      ASSERT_EQ(by_heart.cpu->state_hash(), plain.cpu->state_hash()) << "at " << until;
      ASSERT_EQ(by_heart.device->state_hash(until), plain.device->state_hash(until)) << "at " << until;
      ASSERT_EQ(by_heart.cpu->idle(until), plain.cpu->idle(until)) << "at " << until;
    }
    expect_same_words(by_heart, plain);
    EXPECT_GT(plain.outside.sent.size(), 1000u);
    EXPECT_GT(plain.word(file, "turns"), 20u);
    if (waiting.is_of_memory) {
      EXPECT_GT(plain.cpu->idle(until), until / 2);
    }
  }
}

TEST(UartByHeart, does_not_depend_on_windows) {
  const dspic::FirmwareFile file = talk(4);
  std::uint64_t hash = 0;
  Cycle idle = 0;
  for (const Cycle window : {kEnd / 8, Cycle{1}, Cycle{13}, Cycle{1477}, Cycle{20011}}) {
    Robot robot(file);
    robot.cpu->know(dspic::known_calls(file.functions, robot.program));
    robot.hear(0, kEnd / 8);
    for (Cycle until = window; until < kEnd / 8; until += window) robot.cpu->run(until);
    robot.cpu->run(kEnd / 8);
    if (hash == 0) {
      hash = robot.cpu->state_hash();
      idle = robot.cpu->idle(kEnd / 8);
    }
    EXPECT_EQ(robot.cpu->state_hash(), hash) << window;
    EXPECT_EQ(robot.cpu->idle(kEnd / 8), idle) << window;
  }
}

// one word of each is another: a handler of the program's own
TEST(UartByHeart, is_not_known_where_the_code_is_another) {
  const dspic::FirmwareFile file = talk(4);
  Robot robot(file);
  for (const char* name : {"_U1TXInterrupt", "_U1RXInterrupt", "_U2TXInterrupt", "_U2RXInterrupt"}) {
    const unsigned handler = file.functions.at(name);
    robot.program.write(handler, 0xF80032);  // TBLPAG is saved, and given back
    for (unsigned at = handler;; at += 2)
      if (robot.program.read(at) == 0xF90034) {
        robot.program.write(at, 0xF90032);
        break;
      }
  }
  robot.cpu->know(handlers());
  robot.hear(0, kEnd / 8);
  ASSERT_FALSE(robot.cpu->run(kEnd / 8));
  EXPECT_EQ(answers, (std::array<long, 4>{}));
  EXPECT_GT(robot.outside.sent.size(), 400u);
}

}  // namespace
