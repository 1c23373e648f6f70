// SPDX-License-Identifier: MIT
// What a program can see of the PC it runs on is the same in every run, whatever addresses the system gives
// out, however many threads there are and whatever else runs in the world.
#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::twinpuck;

class SameRun : public CommandTest {
 protected:
  /// What robot `second` of the world said, run so.
  std::string said(const std::string& options) const {
    const auto run = twinpuck("run " + path("two.toml") + " --for 0.3 -q --fw 'second=" + path("nosy") +
                              "' --uart 'second=file:" + path("out.txt") + "' " + options);
    EXPECT_EQ(run.exit_code, 0) << run.text;
    return read(path("out.txt"));
  }
  void SetUp() override {
    write("two.toml",
          "twinpuck = 1\n[[robot]]\nname = \"first\"\nfirmware = \"blink\"\n"
          "[[robot]]\nname = \"second\"\nposition = [0.5, 0.0]\n");
    write("nosy/main.c",
          "#include <stdio.h>\n#include <stdlib.h>\n#include <uart/e_uart_char.h>\n#include "
          "<motor_led/e_init_port.h>\n"
          "int global;\n"
          "__attribute__((noinline)) unsigned garbage(int which) {\n"
          "  unsigned never[40]; int i; unsigned sum = 0;\n"
          "  if (which > 100) for (i = 0; i < 40; i++) never[i] = i;\n"
          "  for (i = 0; i < 40; i++) sum = sum * 3 + never[i];\n"
          "  return sum; }\n"
          "__attribute__((noinline)) unsigned beyond(void) {\n"
          "  volatile unsigned few[4]; int i; unsigned sum = 0; volatile int many = 60;\n"
          "  few[0] = 1;\n"
          "  for (i = 0; i < many; i++) sum = sum * 3 + few[i];\n"
          "  return sum; }\n"
          "volatile int never_true;\n"
          "int main(void) {\n"
          "  char text[100]; int local, i, *heap = malloc(100); unsigned sum = 0, unset;\n"
          "  if (never_true) unset = 5;\n"
          "  e_init_port(); e_init_uart1();\n"
          "  for (i = 0; i < 50; i++) sum = sum * 3 + heap[i];\n"
          "  sprintf(text, \"%lx %lx %lx %lx %x %x %x %x\\r\\n\", (unsigned long)&global, (unsigned "
          "long)&local,\n"
          "    (unsigned long)heap, (unsigned long)main, garbage(i), sum, unset, beyond());\n"
          "  e_send_uart1_char(text, 100); while (1); }\n");
  }
};

TEST_F(SameRun, addresses_and_memory_never_written_are_the_same_in_every_run) {
  const std::string first = said("--seed 4");
  EXPECT_GT(first.size(), 40u) << first;
  for (const char* options : {"--seed 4", "--seed 4 --fw first=braitenberg",
                              "--seed 4 --record /dev/null --record-every 0.01", "--seed 4 --threads 2"})
    EXPECT_EQ(said(options), first) << options;
}

TEST_F(SameRun, memory_never_written_is_another_one_with_another_seed) {
  for (const std::string hal : {"--hal sim", "--hal dspic"})
    EXPECT_NE(said(hal + " --seed 4"), said(hal + " --seed 5")) << hal;
}

}  // namespace
