// SPDX-License-Identifier: MIT
// A controller's program in the debugger, with each HAL: scripts of commands, as a person would type them.
#pragma once
#include "tests/cli/command.h"

namespace cli_test {

/// Counts ticks of timer 1, and works in main() after each.
inline constexpr const char* kProgram = R"(#include <p30F6014A.h>
volatile int ticks;
static int table[4] = {1, 2, 3, 4};
int sum;

void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) {
  ticks++;
  IFS0bits.T1IF = 0;
}

__attribute__((noinline)) int weigh(int n) {
  int s = 0;
  for (int i = 0; i < 4; i++)
    s += table[i] * n;
  return s;
}

__attribute__((noinline)) void work(int n) {
  sum += weigh(n);
  LATAbits.LATA6 = !LATAbits.LATA6;  // toggle
}

int main(void) {
  TRISAbits.TRISA6 = 0;
  PR1 = 14745;
  IEC0bits.T1IE = 1;
  T1CON = 0x8000;
  while (1) {
    int now = ticks;
    while (ticks == now)
      ;
    work(ticks);
  }
}
)";

class Debug : public CommandTest, public ::testing::WithParamInterface<const char*> {
 protected:
  std::string hal() const { return GetParam(); }
  std::string program() const { return path("mine.elf"); }

  /// Builds `source` (a main.c).
  void build(const std::string& source, const std::string& level = "-O1") {
    write("mine/main.c", source);
    const auto built = twinpuck("build '" + path("mine") + "' --hal " + hal() + " --opt " + level + " -o '" +
                                program() + "'");
    ASSERT_EQ(built.exit_code, 0) << built.text;
  }
  /// What the commands answer.
  std::string debug(const std::string& commands, const std::string& options = "--for 1",
                    const std::string& world = "maze") {
    const auto said = twinpuck("debug " + world + " --fw '*=" + program() + "' -x '" +
                               write("commands", commands) + "' " + options);
    EXPECT_EQ(said.exit_code, 0) << said.text;
    return said.text;
  }
  /// Of a run without a debugger: "digest 0123456789abcdef".
  std::string digest(const std::string& options, const std::string& world = "maze") {
    const auto run = twinpuck("run " + world + " --fw '*=" + program() + "' " + options);
    const std::size_t at = run.text.find("digest ");
    EXPECT_NE(at, std::string::npos) << run.text;
    return at == std::string::npos ? "none" : run.text.substr(at, 23);
  }
  static void expect_in_order(const std::string& text, std::initializer_list<std::string> parts) {
    std::size_t at = 0;
    for (const std::string& part : parts) {
      const std::size_t found = text.find(part, at);
      ASSERT_NE(found, std::string::npos)
          << "'" << part << "' behind " << text.substr(0, at) << "\n--- in ---\n"
          << text.substr(at);
      at = found + part.size();
    }
  }
};

inline std::string hal_name(const ::testing::TestParamInfo<const char*>& info) { return info.param; }

}  // namespace cli_test
