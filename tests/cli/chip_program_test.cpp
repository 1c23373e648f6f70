// SPDX-License-Identifier: MIT
// twinpuck asm and dis, and a run of what they made: the sample of docs/controllers.md blinks.
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::twinpuck;

constexpr const char* kBlink = R"(
__reset: mov #__SP_init, w15
    bclr TRISA, #6
1:  btg LATA, #6
    repeat #16383
    nop
    bra 1b
)";

class ChipProgram : public CommandTest {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    const std::string at = (folder / name).string();
    std::ofstream(at) << text;
    return at;
  }
};

TEST_F(ChipProgram, text_becomes_a_program_that_is_shown_and_runs) {
  const std::string source = file("blink.s", kBlink), hex = (folder / "blink.hex").string();
  const auto made = twinpuck("asm '" + source + "' -o '" + hex + "'");
  ASSERT_EQ(made.exit_code, 0) << made.text;
  const auto shown = twinpuck("dis '" + hex + "'");
  EXPECT_EQ(shown.exit_code, 0);
  for (const char* part : {"000000  040100  goto 0x000100\n000002  000000\n", "mov #0x800, w15",
                           "bclr.b 0x02c0, #6", "btg.b 0x02c4, #6", "repeat #0x3fff", "bra 0x000104"})
    EXPECT_NE(shown.text.find(part), std::string::npos) << part << " in:\n" << shown.text;
  const std::string summary = (folder / "run.json").string();
  const auto run = twinpuck("run maze --fw '*=" + hex + "' --for 0.1 --summary '" + summary + "'");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  std::ifstream in(summary);
  const std::string json((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(json.find("\"hal\": \"own\""), std::string::npos) << json;
}

// a project without C, in the vendor's words: its own main, or its own start-up
TEST_F(ChipProgram, project_of_assembler_alone_is_built) {
  constexpr const char* kText = R"(
        .include "p30f6014A.inc"
        config __FWDT, WDT_ON & 0x9234
        .section .letters, code
letters: .hword 0x1234, 0x5678
        .section .data, near
count:  .byte 1
        .hword 17
        .section .place, data, xmemory, address(0x900)
pair:   .word 3, 4
        .text
        .global BEGIN
BEGIN:  mov count + 2, w0
        mov #tblpage(letters), w1
        mov w1, TBLPAG
        mov #tbloffset(letters), w1
        tblrdl [w1++], w2
        tblrdl [w1], w3
        mov #pair, w4
        mov [w4+2], w5
        mov #0x4000, w6
        clr A
        lac w6, A
        add A
        sac A, #1, w7
        clr flags
        bset flags, #9
        btg flags, #3
        bset.b flags + 1, #7
        btss flags, #15
        reset
        btsc flags, #14
        reset
        mov flags, w8
1:      bra 1b
        .pushsection .nbss, bss, near
flags:  .space 2
        .popsection
        nop                             ; in the code again, or not assembled
        .section __c30_signature, info, data
        .word 1, 0, 0
)";
  for (const std::string begin : {"_main", "__reset"}) {
    std::string text = kText;
    for (std::size_t at; (at = text.find("BEGIN")) != std::string::npos;) text.replace(at, 5, begin);
    std::filesystem::create_directories(folder / begin);
    file(begin + "/program.s", text);
    const std::string project = (folder / begin).string(), elf = (folder / "x.elf").string();
    const auto built = twinpuck("build '" + project + "' --hal dspic -o '" + elf + "'");
    ASSERT_EQ(built.exit_code, 0) << built.text;
    const auto stopped =
        twinpuck("debug maze --fw '*=" + elf + "' -x '" + file("commands", "stepi 400\nregs\n") + "'");
    // who copies start values? RAM holds anything before
    EXPECT_EQ(stopped.text.find("w0  0011   w1") != std::string::npos, begin == "_main") << stopped.text;
    for (const char* part : {"w2  1234   w3  5678   w4  0900", "w6  4000", "w7  2000", "w8  8208"})
      EXPECT_NE(stopped.text.find(part), std::string::npos) << part << " in:\n" << stopped.text;
    std::ifstream in(folder / "x.hex");
    const std::string hex((std::istreambuf_iterator<char>(in)), {});
    EXPECT_NE(hex.find(":0200000401F009"), std::string::npos);
    EXPECT_NE(hex.find(":0C000000E6FF000034920000"), std::string::npos) << hex;  // FOSC is the library's
  }
}

TEST_F(ChipProgram, controllers_source_becomes_an_image_and_drives) {
  const std::string elf = (folder / "obstacle.elf").string();
  const auto built = twinpuck("build obstacle --hal dspic -o '" + elf + "'");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  EXPECT_TRUE(reads(built.text,
                    "@/obstacle.elf: … files compiled, … unchanged, … s\nflash   … of 49152 words (… %): "
                    "code …, constants …, tables 0, start values …, vectors and jumps …\nRAM     … of 8192 "
                    "bytes (… %)\nstack    … bytes at most, … left for it"));
  for (const char* kind : {"elf", "hex", "lst", "map"})
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string("obstacle.") + kind))) << kind;
  const auto shown = twinpuck("dis '" + elf + "'");
  EXPECT_NE(shown.text.find("\nmain:\n"), std::string::npos);
  EXPECT_NE(shown.text.find("firmware/lab/obstacle/main.c:"), std::string::npos) << "lines are named";
  // the image and the source give the same run, to the last bit
  const auto digest = [](const std::string& text) { return text.substr(text.find("digest "), 23); };
  const auto of_image = twinpuck("run maze --fw '*=" + elf + "' --for 2");
  const auto of_source = twinpuck("run maze --fw '*=obstacle' --hal dspic --for 2");
  ASSERT_EQ(of_image.exit_code, 0) << of_image.text;
  EXPECT_EQ(digest(of_image.text), digest(of_source.text));
  EXPECT_NE(of_image.text.find(" 0.1"), std::string::npos) << "it drives some 0.1 m: " << of_image.text;
}

// program memory goes to 0x18000: debugging information has addresses of 32 bits
TEST_F(ChipProgram, code_beyond_64k_has_lines_and_locals) {
  std::string source = "#define TEN(x) x x x x x x x x x x\nvolatile int v;\n", calls;
  for (int i = 0; i < 11; ++i) {
    const std::string name = "step" + std::to_string(i);
    source += "__attribute__((noinline)) int " + name + "(int rounds) {\n  int n, s = 0;\n" +
              "  __asm__ volatile(TEN(TEN(TEN(\"nop\\n nop\\n nop\\n nop\\n\"))));\n" +
              "  for (n = 0; n < rounds; n++)\n    s += v;\n  return s;\n}\n";
    calls += "  v = " + name + "(v + " + std::to_string(i) + ");\n";
  }
  std::filesystem::create_directories(folder / "large");
  file("large/main.c", source + "int main(void) {\n  v = 1;\n" + calls + "  for (;;) ;\n}\n");
  const std::string elf = (folder / "large.elf").string();
  const auto built = twinpuck("build '" + (folder / "large").string() + "' --hal dspic -o '" + elf + "'");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  // the last function is the last in memory; its loop is in line 77
  const auto said =
      twinpuck("debug maze --for 1 --fw '*=" + elf + "' -x '" +
               file("commands", "break step10\nc\nprint rounds\nbreak main.c:77\nc\nbt\nprint s\n") + "'");
  EXPECT_TRUE(reads(said.text, R"(puck: @/large.elf
puck: 0.000000000 s, cycle 0: 0x000000 0x000000
> break step10
breakpoint 1 at 0x01… step10() (main.c:75)
> c
breakpoint 1
… s, cycle …: 0x01… step10() (main.c:75)
75	  __asm__ volatile(TEN(TEN(TEN("nop\n nop\n nop\n nop\n"))));
> print rounds
rounds = 10 (0xa)
> break main.c:77
breakpoint 2 at 0x01… step10() (main.c:77)
> c
breakpoint 2
… s, cycle …: 0x01… step10() (main.c:77)
77	    s += v;
> bt
#0 0x01… step10() (main.c:77)
#1 … main() (main.c:92)
#2 … _reset() (…)
> print s
s = 0 (0x0))"));
  const auto shown = twinpuck("dis '" + elf + "'");
  EXPECT_NE(shown.text.find("main.c:77"), std::string::npos);
}

// long enough that handlers and loops run hot
TEST_F(ChipProgram, translated_code_changes_no_result) {
  const auto digest = [](const std::string& text) { return text.substr(text.find("digest "), 23); };
  for (const char* controller : {"obstacle", "braitenberg_2a", "camera_follow"}) {
    const std::string run = std::string("run maze --fw '*=") + controller + "' --hal dspic --for 8";
    const auto translated = twinpuck(run);
    ASSERT_EQ(translated.exit_code, 0) << translated.text;
    setenv("TWINPUCK_INTERPRET", "1", 1);
    const auto interpreted = twinpuck(run);
    unsetenv("TWINPUCK_INTERPRET");
    EXPECT_EQ(digest(translated.text), digest(interpreted.text)) << controller;
  }
}

// a RETURN before an interrupt is a cycle shorter, else the code is right
TEST_F(ChipProgram, what_code_tells_holds_in_runs) {
  static const std::regex row(
      R"(^(\S+)(?: \(interrupt\))? +(\d+) +\d+ +(\d+) +\S+ +\S+% +\d+ +\d+ +(\d+)(?: to (\d+))?  )");
  constexpr int kShorterReturns = 2;
  int held = 0;
  for (const char* controller : {"asercom", "camera_follow", "u_obstacle"}) {
    std::istringstream lines(twinpuck(std::string("cycles ") + controller + " --all --for 0.5").text);
    std::smatch m;
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_search(line, m, row)) continue;
      const int least = std::stoi(m[4]), most = m[5].matched ? std::stoi(m[5]) : least;
      EXPECT_GE(std::stoi(m[2]), least - kShorterReturns) << line;
      EXPECT_LE(std::stoi(m[3]), most) << line;
      ++held;
    }
  }
  EXPECT_GT(held, 40);
}

TEST_F(ChipProgram, exact_cycles_of_the_docs_are_those_of_the_chip) {
  const std::string check =
      "cd '" TWINPUCK_SOURCE_DIR "' && python3 scripts/exact_cycles.py '" TWINPUCK_BUILD_DIR
      "' --check braitenberg_2a tilt blink 2>&1";
  const auto said = shell::run(check);
  EXPECT_EQ(said.exit_code, 0) << said.text;
}

// a HEX file names nothing: what the vectors and calls lead to are its functions
TEST_F(ChipProgram, functions_of_a_hex_file_are_found) {
  const std::string elf = (folder / "obstacle.elf").string(), hex = (folder / "obstacle.hex").string();
  ASSERT_EQ(twinpuck("build obstacle --hal dspic -o '" + elf + "'").exit_code, 0);
  const auto named = twinpuck("cycles '" + elf + "' --for 0.3 --all"),
             found = twinpuck("cycles '" + hex + "' --for 0.3");
  ASSERT_EQ(found.exit_code, 0) << found.text;
  const auto row = [](const std::string& text,
                      const std::string& name) {  // least, mean, most, us, load, calls
    const std::size_t at = text.find("\n" + name + " ");
    return at == std::string::npos ? "no " + name : text.substr(at + 33, 62);
  };
  EXPECT_EQ(row(found.text, "_T2Interrupt (interrupt)"), row(named.text, "_T2Interrupt (interrupt)"))
      << found.text;
  EXPECT_EQ(row(found.text, "_ADCInterrupt (interrupt)"), row(named.text, "_ADCInterrupt (interrupt)"));
  // called through a pointer alone
  const auto shown = twinpuck("dis '" + elf + "'").text;
  const std::string tick = shown.substr(shown.find('\n', shown.find("\ncontrol_tick:\n") + 1) + 1);
  const std::string address = tick.substr(tick.find("\n") + 1, 6);
  EXPECT_EQ(row(found.text, "sub_" + address), row(named.text, "control_tick")) << found.text;
}

// a tick or frame that came while it was held off is served within a step: its flag was not cleared unserved
TEST_F(ChipProgram, what_handlers_known_by_heart_serve_late_is_not_missed) {
  write("held/main.c",
        "#include <p30F6014A.h>\n#include <a_d/advance_ad_scan/e_ad_conv.h>\n"
        "#include <motor_led/advance_one_timer/e_agenda.h>\n#include <motor_led/e_init_port.h>\n"
        "volatile unsigned i;\nstatic void spin(void) { for (i = 0; i < 70; i++); }\n"
        "int main(void) {\n  e_init_port();\n  e_init_ad_scan(ALL_ADC);\n  e_activate_agenda(spin, 3);\n"
        "  e_start_agendas_processing();\n  while (1) {\n    SRbits.IPL = 7;\n    for (i = 0; i < 90; i++);\n"
        "    SRbits.IPL = 0;\n    for (i = 0; i < 500; i++);\n  }\n}\n");
  const std::string json = (folder / "held.json").string();
  for (const std::string hal : {"sim", "dspic"}) {
    const auto run = twinpuck("run maze --fw '*=" + path("held") + "' --hal " + hal +
                              " --for 0.5 --profile-json '" + json + "'");
    EXPECT_EQ(run.exit_code, 0) << run.text;
    std::ifstream in(json);
    int rows = 0;
    const auto robot = nlohmann::json::parse(in)["robots"][0];
    for (const auto& interrupt : robot["interrupts"]) {
      if (interrupt["missed"] != 0) ADD_FAILURE() << hal << ": " << interrupt;
      rows += interrupt["name"] == "T2";
    }
    EXPECT_EQ(rows, 1);
  }
}

TEST_F(ChipProgram, a_run_shows_its_profile) {
  const std::string json = (folder / "profile.json").string();
  const auto run =
      twinpuck("run maze --fw '*=obstacle' --hal dspic --for 0.5 --profile --profile-json '" + json + "'");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  for (const char* part : {"puck: profile of 0.5 s, exact to the cycle",
                           "main loop  main() (main.c:", "\nADC ", "busy wait", "control_tick (agenda)"})
    EXPECT_NE(run.text.find(part), std::string::npos) << part << " in:\n" << run.text;
  std::ifstream in(json);
  const auto robot = nlohmann::json::parse(in)["robots"][0];
  EXPECT_EQ(robot["to_cycle"].get<long>() / 1000, 7372);
  EXPECT_GT(robot["functions"].size(), 20u);
  const auto without = twinpuck("run maze --fw '*=obstacle' --hal dspic --for 0.5");
  const auto digest = [](const std::string& text) { return text.substr(text.find("digest "), 23); };
  EXPECT_EQ(digest(run.text), digest(without.text));
  // the program's functions take the same cycles whoever plays the library, whose functions have theirs; its
  // wait for the first scan is one; agendas are called by the handler that is known by heart
  const auto sim = twinpuck("run maze --fw '*=obstacle' --hal sim --for 0.5 --profile");
  for (const char* line :
       {"\ncontrol_tick (agenda)                8         5         5         5", "\n_T2Interrupt ",
        "\ncloseness                           16       207       207       207",
        "\ne_init_motors                        1 ", "\ne_init_ad_scan                       1 ",
        "\nT2                    8 "})
    EXPECT_NE(sim.text.find(line), std::string::npos) << line << " in:\n" << sim.text;
  for (const char* line : {"\ncloseness                           16       207       207       207"})
    EXPECT_NE(run.text.find(line), std::string::npos) << line << " in:\n" << run.text;
  const auto load = [](const std::string& text) { return std::atof(text.c_str() + text.find("load  ") + 5); };
  EXPECT_NEAR(load(sim.text), load(run.text), 1);
}

TEST_F(ChipProgram, every_controller_drives_alike_with_either_hal) {
  namespace fs = std::filesystem;
  int controllers = 0;
  for (const auto& entry : fs::directory_iterator(TWINPUCK_SOURCE_DIR "/firmware")) {
    if (!fs::exists(entry.path() / "main.c")) continue;
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    ++controllers;
    double x[2] = {}, y[2] = {}, heading[2] = {};
    for (int hal = 0; hal < 2; ++hal) {
      const std::string summary = (folder / "run.json").string();
      const auto run = twinpuck("run maze --fw '*=" + name + "' --hal " + (hal ? "dspic" : "sim") +
                                " --for 2 --summary '" + summary + "'");
      ASSERT_EQ(run.exit_code, 0) << run.text;
      std::ifstream in(summary);
      const auto robot = nlohmann::json::parse(in)["robots"][0];
      x[hal] = robot["x_m"];
      y[hal] = robot["y_m"];
      heading[hal] = robot["heading_rad"];
    }
    // a sample of the infrared sensors taken beside another decides the turn of `braitenberg`: 4 mm
    EXPECT_NEAR(x[0], x[1], 0.005);
    EXPECT_NEAR(y[0], y[1], 0.005);
    EXPECT_NEAR(heading[0], heading[1], 0.07);
  }
  EXPECT_GE(controllers, 19);
}

// the bootloader's own image in a robot, and the command at the other end of a real line
TEST_F(ChipProgram, flash_writes_a_program_into_a_robot) {
  const std::string source = file("blink.s", kBlink), hex = (folder / "blink.hex").string();
  const std::string boot = (folder / "boot.hex").string(), line = (folder / "line").string();
  ASSERT_EQ(twinpuck("asm '" + source + "' -o '" + hex + "'").exit_code, 0);
  ASSERT_EQ(
      twinpuck("asm '" TWINPUCK_SOURCE_DIR "/hal_dspic/bootloader/bootloader.s' -o '" + boot + "'").exit_code,
      0);
  const std::string robot = cli_test::executable() + " run maze --fw \"*=" + boot +
                            "\" --uart \"puck=pty:" + line + "\" --for 60 --speed 1";
  const auto flashed =
      twinpuck("flash '" + hex + "' --port '" + line + "' --wait 20",
               "sh -c '" + robot + " >/dev/null 2>&1 & p=$!; n=0; until [ -e \"" + line +
                   "\" ] || [ $n = 400 ]; do sleep 0.05; n=$((n + 1)); done; \"$@\"; r=$?; kill $p; "
                   "wait $p; exit $r' sh");
  EXPECT_EQ(flashed.exit_code, 0) << flashed.text;
  EXPECT_TRUE(reads(flashed.text,
                    "waiting for the bootloader on @/line: press the robot's reset button\n@/blink.hex: 3 "
                    "rows written and verified in … s, 0 frames again; the program runs"));
}

}  // namespace
