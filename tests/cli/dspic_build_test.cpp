// SPDX-License-Identifier: MIT
// scripts/build_dspic.sh with a compiler of the test's own: what it is asked, what comes out, and what is
// said when something is wrong.
#include <sys/stat.h>

#include <cstdlib>

#include "tests/cli/command.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

class DspicBuild : public cli_test::CommandTest {
 protected:
  /// A tool that writes down how it was called and makes the file after -o (the compiler) or the archive.
  void tool(const std::string& name, const std::string& body) {
    const std::string file =
        write("bin/" + name, "#!/bin/sh\necho \"" + name + " $*\" >>'" + path("calls") + "'\n" + body);
    chmod(file.c_str(), 0755);
  }
  void tools(int flash, int data) {
    tool("xc16-gcc",
         "elf=; while [ $# -gt 0 ]; do case $1 in -o) elf=$2; shift;; *.gld) link=1;; esac; shift; done\n"
         ": >\"$elf\"\n"
         "[ -z \"$link\" ] || { echo 'Total program memory used (bytes): 0x1 (" +
             std::to_string(flash) + ") 1%'; echo 'Total data memory used (bytes): 0x1 (" +
             std::to_string(data) + ") 1%'; }\n");
    tool("xc16-ar", "shift; : >\"$2\"\n");
    tool("xc16-bin2hex", "for f; do :; done; : >\"${f%.elf}.hex\"\n");
    tool("xc16-objdump",
         "cat <<'E'\n"
         "00000200 <_main>:\n"
         "     200:\t06 00 fa    \tlnk       #0x6\n"
         "     202:\t88 9f be    \tmov.d     w8, [w15++]\n"
         "     204:\t10 00 07    \trcall     0x226\n"
         "00000226 <_deep>:\n"
         "     226:\t88 1f 78    \tmov.w     w8, [w15++]\n"
         "00000300 <__T2Interrupt>:\n"
         "     300:\t36 00 f8    \tpush.w    0x0036\n"
         "E\n");
  }
  cli_test::Said build(const std::string& compiler, const std::string& controller) {
    cli_test::Said said;
    const std::string line = "'" TWINPUCK_SOURCE_DIR "/scripts/build_dspic.sh' '" + compiler + "' '" +
                             controller + "' '" + path("out") + "' >'" + path("said") + "' 2>&1";
    const int status = std::system(line.c_str());
    said.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    said.text = read(path("said"));
    return said;
  }
};

// main: 2 + 6 for lnk, 4 for mov.d, 4 for the call, 2 in deep = 18; handler: 4 + 2 = 6
TEST_F(DspicBuild, library_and_program_become_elf_and_hex_with_a_report) {
  tools(14745, 819);
  const auto said = build(path("bin/xc16-gcc"), "blink");
  ASSERT_EQ(said.exit_code, 0) << said.text;
  EXPECT_TRUE(fs::exists(path("out/blink.elf")));
  EXPECT_TRUE(fs::exists(path("out/blink.hex")));
  EXPECT_TRUE(reads(said.text,
                    "flash   14745 of 147456 bytes (9 %)\nRAM       819 of 8192 bytes (9 %), 512 of them the "
                    "heap\nstack      24 bytes at most, 7373 left for it\n@/out/blink.hex"));
  const std::string calls = read(path("calls"));
  for (const char* part : {"-mcpu=30F6014A", "-T p30F6014A.gld", "-Wl,--heap=512", "hal_dspic/uart/e_uart1.c",
                           "firmware/library/e_prox.c", "firmware/webots/core.c", "e_line_interrupt.s",
                           "hal_dspic/motor_led/configuration.c"})
    EXPECT_NE(calls.find(part), std::string::npos) << part;
}

TEST_F(DspicBuild, a_program_too_big_for_the_chip_fails) {
  tools(147457, 819);
  const auto said = build(path("bin/xc16-gcc"), "blink");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_TRUE(reads(said.text,
                    "flash  147457 of 147456 bytes (100 %)\nRAM       819 of 8192 bytes (9 %), 512 of them "
                    "the heap\nstack      24 bytes at most, 7373 left for it\nmake dspic: chip: got a "
                    "program that does not fit, expected one within its flash, RAM and stack"));
  tools(1000, 8182);  // 10 bytes of stack are left of 24
  EXPECT_EQ(build(path("bin/xc16-gcc"), "blink").exit_code, 1);
}

}  // namespace
