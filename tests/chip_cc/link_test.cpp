// SPDX-License-Identifier: MIT
// Folders built for the chip by the command that ships: what is linked, what is told, what lies beside the
// image.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "compiler/cache/object_cache.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/program_memory.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

std::string text_at(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// A program's folder, built by `twinpuck build`.
class Built : public ::testing::Test {
 protected:
  Built() : folder(fs::temp_directory_path() / ("twinpuck-link-" + std::to_string(getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder / "prog");
  }
  ~Built() override { fs::remove_all(folder); }

  void file(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / "prog" / name).parent_path());
    std::ofstream(folder / "prog" / name) << text;
  }
  /// What the command says; `is_good`: that it ended so.
  std::string build(bool is_good = true, const char* hal = "dspic", const char* output = "x.elf") {
    const auto run =
        cc::run_process({std::string(TWINPUCK_BUILD_DIR) + "/twinpuck", "build", (folder / "prog").string(),
                         "--hal", hal, "-o", (folder / output).string()});
    EXPECT_EQ(run.status == 0, is_good) << run.output;
    return run.output;
  }
  std::string beside(const char* kind) const { return text_at(folder / (std::string("x.") + kind)); }
  dspic::FirmwareFile image() const {
    dspic::FirmwareFile made;
    std::string error;
    EXPECT_TRUE(dspic::load_firmware(beside("elf"), "x.elf", made, error)) << error;
    return made;
  }
  /// A symbol's address by the map.
  unsigned long place_of(const std::string& symbol) const {
    std::istringstream lines(beside("map"));
    for (std::string line; std::getline(lines, line);)
      if (has(line, " " + symbol + " ")) return std::strtoul(line.c_str(), nullptr, 16);
    ADD_FAILURE() << symbol;
    return 0;
  }
  /// The first lines of the map: modules that are linked.
  std::string modules() const {
    const std::string map = beside("map");
    const std::size_t begin = map.find("\nmodules");
    return begin == std::string::npos ? "" : map.substr(begin, map.find("\n\n", begin + 1) - begin);
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }
  fs::path folder;
};

const char* const kSounds = R"(
        .section .sounds, code
        .global _sounds
_sounds:
        .rept 5000
        .hword 0x1234
        .endr
)";

TEST_F(Built, size_report_counts_every_word_of_the_hex) {
  file("main.c",
       "extern int sounds;\nconst char far_table[2001] __attribute__((space(prog))) = {1};\n"
       "const int near_table[9] = {7};\n"
       "int main(void) { return near_table[1] + __builtin_tbloffset(&far_table) + "
       "__builtin_tbloffset(&sounds); }\n");
  file("sounds.s", kSounds);
  const std::string told = build();
  dspic::FirmwareFile hex;
  std::string error;
  ASSERT_TRUE(dspic::load_hex(beside("hex"), "x.hex", hex, error)) << error;
  const auto words = std::distance(hex.words.begin(), hex.words.lower_bound(dspic::kFlashEnd));
  EXPECT_GT(words, 6000);
  std::size_t at = told.find("flash");
  ASSERT_NE(at, std::string::npos) << told;
  EXPECT_EQ(std::strtol(told.c_str() + at + 5, nullptr, 10), words) << told;
  // the kinds add up to it, and what has not changed is told again
  at = told.find("code ");
  long sum = 0;
  for (const char* kind : {"code ", "constants ", "tables ", "start values ", "jumps "})
    sum += std::strtol(told.c_str() + told.find(kind, at) + std::string(kind).size(), nullptr, 10);
  EXPECT_EQ(sum, words) << told;
  EXPECT_TRUE(has(build(), told.substr(told.find("flash"))));
}

TEST_F(Built, bound_of_ram_and_stack_is_the_linkers_for_every_caller) {
  file("main.c", "char large[7000];\nint main(void) { volatile char deep[1800]; return deep[large[0]]; }\n");
  const std::string told = build();
  EXPECT_TRUE(has(told, "RAM     7000 of 8192 bytes")) << told;
  EXPECT_TRUE(has(told, "prog: warning: stack: got 18")) << told;
}

TEST_F(Built, listing_has_the_lines_of_the_source_and_the_map_its_modules) {
  file("main.c",
       "int part(int);\nint counted;\nint main(void) {\n  counted = part(4711);  // here\n  return "
       "counted;\n}\n");
  file("part.c", "static int kept;\nint part(int v) {\n  kept += v;\n  return kept;\n}\n");
  build();
  const std::string listing = beside("lst");
  const std::size_t line = listing.find(";     4    counted = part(4711);  // here\n");
  ASSERT_NE(line, std::string::npos) << listing.substr(0, 2000);
  EXPECT_LT(listing.rfind("_main:", line), line);
  EXPECT_TRUE(has(listing.substr(line, 400), "mov #0x1267, w0")) << listing.substr(line, 400);
  EXPECT_TRUE(has(listing, "; " + (folder / "prog/part.c").string() + "\n"));
  const std::string symbols = listing.substr(listing.find("; symbols"));
  for (const char* name : {"_main", "_part", "_counted", "_kept"}) EXPECT_TRUE(has(symbols, name)) << name;
  EXPECT_TRUE(has(modules(), "2  " + (folder / "prog/main.c").string())) << modules();
  EXPECT_TRUE(has(modules(), "library(start.s)"));
  EXPECT_TRUE(has(beside("map"), (folder / "prog/part.c").string() + "\n  0x")) << beside("map");
}

TEST_F(Built, link_errors_name_function_and_line_of_the_c) {
  file("main.c",
       "extern int nowhere;\nint missing(int);\n"
       "int twice(void) { return 1; }\n"
       "int main(void) {\n  nowhere = 1;\n  e_set_sped(3);\n  return missing(2);\n}\n");
  std::string told = build(false);
  const std::string main = (folder / "prog/main.c").string();
  EXPECT_TRUE(has(told, main + ":5: error: main() uses nowhere: got no definition")) << told;
  EXPECT_TRUE(has(told, main + ":6: error: main() calls e_set_sped(): got no definition")) << told;
  EXPECT_TRUE(has(told, "its name is misspelt")) << told;
  EXPECT_TRUE(has(told, main + ":7: error: main() calls missing(): got no definition")) << told;
  const std::string well = "int main(void) { return 0; }\n";
  for (const auto& [call, hint] : {
           std::pair("e_i2cp_read_string",
                     "declares this function and defines it nowhere, so the robot's linker"),
           std::pair("e_po8030d_set_color_mode", "declares this function and defines it nowhere"),
           std::pair("VectorDotProduct", "put XC16's libdsp-elf.a into the folder"),
           std::pair("FIR", "put XC16's libdsp-elf.a into the folder"),
       }) {
    file("main.c", std::string("int main(void) { return ") + call + "(); }\n");
    told = build(false);
    EXPECT_TRUE(has(told, hint)) << told;
  }
  file("main.c", "int twice(void) { return 1; }\n" + well);
  file("other.c", "\nint twice(void) { return 2; }\n");
  told = build(false);
  EXPECT_TRUE(
      has(told, "prog/other.c:2: error: twice(): got a second definition, expected one; the first is in " +
                    main + ":1"))
      << told;
  EXPECT_FALSE(has(told, "twinpuck/objects/")) << told;
}

TEST_F(Built, mistakes_in_assembler_text_are_all_told_with_their_lines) {
  file("main.c",
       "#define WRONG asm(\"mov #5, w99\")\n"
       "void first(void) {\n"
       "  asm(\"nop\\n\"\n"
       "      \"foo w1\\n\"\n"
       "      \"bar w2\");\n"
       "}\n"
       "int main(void) {\n  WRONG;\n  first();\n  return 0;\n}\n");
  const std::string told = build(false);
  for (const char* message : {"main.c:4:8: error: instruction: got 'foo', expected one of the dsPIC30F's",
                              "main.c:5:8: error: instruction: got 'bar', expected one of the dsPIC30F's",
                              "main.c:8:3: error: mov: operands '#5, w99'"})
    EXPECT_TRUE(has(told, message)) << message << "\n" << told;
}

TEST_F(Built, assembler_has_pages_of_code_comments_and_includes) {
  file("main.c", "extern int page(void), place(void);\nint main(void) { return page() + place(); }\n");
  file("sound/sounds.s", kSounds);
  file("sound/Names.INC", "        .equ THREE, 3 /* a\n   comment */\n");
  file("shared/more.inc", "        .equiv FOUR, THREE + 1\n");
  file("sound/use.s", R"(
        .include "names.inc"            ; beside the file, in another case
        .include "C:\work\shared\More.inc"
        .text
        .global _page
_page:  mov #psvpage(_sounds), w0       /* the page */
        mov #THREE, w1                  /* over
                                           lines */
        mov #FOUR, w2 // four
        mov #';', w3
        return
        .global _place
_place: mov #psvoffset(_sounds), w0
        mov #psvoffset(here), w1
        mov #tblpage(_sounds), w2
here:   return
)");
  build();
  const dspic::FirmwareFile made = image();
  const std::uint32_t sounds = made.functions.at("sounds"), page = made.functions.at("page"),
                      place = made.functions.at("place");
  EXPECT_EQ(made.words.at(page), 0x200000u | (sounds >> 15) << 4);
  EXPECT_EQ(made.words.at(page + 2), 0x200031u);
  EXPECT_EQ(made.words.at(page + 4), 0x200042u);
  EXPECT_EQ(made.words.at(page + 6), 0x2003B3u);
  EXPECT_EQ(made.words.at(place), 0x200000u | ((sounds & 0x7FFF) | 0x8000) << 4);
  EXPECT_EQ(made.words.at(place + 2), 0x200001u | ((place + 6) | 0x8000) << 4);
  EXPECT_EQ(made.words.at(place + 4), 0x200002u | (sounds >> 16) << 4);
}

TEST_F(Built, assembler_that_includes_itself_ends) {
  file("main.c", "int main(void) { return 0; }\n");
  file("again.s", "        .include \"again.s\"\n        .include \"again.s\"\n");
  EXPECT_TRUE(has(build(false), "includes are nested too deeply, or too many"));
}

TEST_F(Built, sections_with_attributes_and_alignment_place_variables) {
  file("main.c",
       "int samples[64] __attribute__((section(\".ydata, data, ymemory\"), aligned(128))) = {1};\n"
       "int zeros[8] __attribute__((section(\".mine, bss, xmemory, address(0x1000)\")));\n"
       "void aside(void) __attribute__((section(\".aside, code\")));\nvoid aside(void) { zeros[0] = 1; }\n"
       "extern int elsewhere __attribute__((section(\".there, bss\")));\n"
       "void never(void) { elsewhere = 1; }\n"
       "const int odd = 5;\nconst int table[128] __attribute__((space(auto_psv), aligned(256))) = {1, 2};\n"
       "int main(void) { aside(); return samples[0] + zeros[1] + table[zeros[2]] + (int)&odd; }\n");
  build();
  EXPECT_GE(place_of("_samples"), 0x1800u);
  EXPECT_EQ(place_of("_samples") % 128, 0u);
  EXPECT_EQ(place_of("_zeros"), 0x1000u);
  EXPECT_EQ(place_of("_table") % 256, 0u);
}

// the original's fast agenda, in short: its e_motors.c calls its own e_agenda_fast.c, and main includes our
// header, which labels the functions
// 2,896 bytes lie before Y memory's array and 3,072 behind it, were it at Y memory's beginning
TEST_F(Built, a_large_array_lies_over_the_beginning_of_y_memory) {
  file("main.c",
       "int table[512] __attribute__((space(ymemory)));\nchar a_small[1200], big[3300];\n"
       "int main(void) { a_small[table[1]] = 1; big[table[2]] = 2; while (1); }\n");
  build();
  const unsigned long table = place_of("_table"), small = place_of("_a_small"), big = place_of("_big");
  EXPECT_EQ(table, 0x2400u);
  EXPECT_EQ(small, 0x0800u);
  EXPECT_EQ(big, 0x0800u + 1200);
}

TEST_F(Built, drivers_of_a_project_are_never_mixed_with_ours) {
  const std::string place = "library/motor_led/advance_one_timer/fast_agenda/";
  file("main.c",
       "#include <motor_led/advance_one_timer/fast_agenda/e_motors.h>\n"
       "#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>\n"
       "int main(void) { e_start_agendas_processing(); e_init_motors(); e_set_speed_left(200); for (;;) ; "
       "}\n");
  file(place + "e_agenda_fast.c",
       "static int started; void e_start_agendas_processing(void) { started = 1; }\n"
       "void e_activate_motors(void (*a)(void), void (*b)(void)) { if (started) a(), b(); }\n");
  file(place + "e_motors.c",
       "void e_activate_motors(void (*)(void), void (*)(void)); static int speed; static void run(void) { "
       "speed++; }\n"
       "void e_init_motors(void) { e_activate_motors(run, run); }\nvoid e_set_speed_left(int v) { speed = v; "
       "}\n");
  build();
  EXPECT_TRUE(has(modules(), place + "e_agenda_fast.c")) << modules();
  EXPECT_TRUE(has(modules(), place + "e_motors.c")) << modules();
  EXPECT_FALSE(has(modules(), "library(e_agenda")) << modules();
  EXPECT_FALSE(has(modules(), "library(e_motors")) << modules();
}

// our motors of the fast form run on the agendas that the program has
TEST_F(Built, our_drivers_call_what_the_program_has_itself) {
  file("main.c",
       "#include <motor_led/advance_one_timer/fast_agenda/e_motors.h>\n"
       "int main(void) { e_init_motors(); e_set_speed_left(200); for (;;) ; }\n");
  file("agenda.c",
       "int steps; void e_activate_motors(void (*a)(void), void (*b)(void)) { a(), b(); }\n"
       "int e_set_motor_speed(void (*f)(void), unsigned cycle) { steps += cycle; return 1; }\n"
       "int e_set_agenda_cycle(void (*f)(void), unsigned cycle) { steps += cycle; return 1; }\n");
  build();
  EXPECT_TRUE(has(modules(), "library(e_motors_fast.c)")) << modules();
  EXPECT_FALSE(has(modules(), "library(e_agenda")) << modules();
}

TEST_F(Built, functions_of_two_drivers_of_one_device_are_refused) {
  struct Case {
    const char *headers, *calls, *expected;  // expected: "" builds
  };
  for (const Case& c : {
           Case{"motor_led/e_motors.h", "e_init_motors(); e_set_speed(100, 0);",
                "motors: got e_set_speed() of motor_led/advance_one_timer/e_motors.c, but "
                "motor_led/e_motors.c is "
                "linked, expected functions of one of them; the robot's linker refuses both: multiple "
                "definition of "},
           Case{"motor_led/advance_one_timer/e_motors.h", "e_init_motors(); e_set_speed(100, 0);", ""},
           Case{"motor_led/e_led.h", "e_set_led(1, 1); e_blink_led0();", "LEDs: got e_blink_led0() of"},
           Case{"a_d/advance_ad_scan/e_prox.h", "e_calibrate_ir(); e_init_prox();", "proximity sensors: got"},
           // the two drivers of the converter share no name
           Case{"a_d/advance_ad_scan/e_ad_conv.h", "e_init_ad_scan(1); e_init_ad();", ""},
       }) {
    file("main.c",
         std::string("#include <") + c.headers + ">\nint main(void) { " + c.calls + " for (;;) ; }\n");
    const std::string told = build(!*c.expected);
    EXPECT_TRUE(has(told, c.expected)) << told;
  }
  // what the program has itself is nobody's
  file("main.c",
       "#include <motor_led/e_motors.h>\nvoid e_set_speed(int a, int b) { e_set_speed_left(a - b); }\n"
       "int main(void) { e_init_motors(); e_set_speed(100, 0); for (;;) ; }\n");
  build();
}

// the robot's linker takes a file of the library whole
TEST_F(Built, part_of_a_driver_beside_the_rest_of_the_librarys_is_refused) {
  struct Case {
    const char *headers, *own, *calls, *expected;  // expected: "" builds
  };
  const char* const kLeds = "motor_led/advance_one_timer/e_led.h";
  for (const Case& c : {
           Case{
               kLeds, "void e_set_led(unsigned n, unsigned v) { LATA = n; }",
               "e_set_led(1, 1); e_led_clear();",
               "other.c: error: e_set_led(): got a second definition, expected one; the library's "
               "motor_led/advance_one_timer/e_led.c has it too and is linked for e_led_clear(), which main.c "
               "calls: the robot's linker refuses that; define e_led_clear() as well, or give your function "
               "another name"},
           Case{"motor_led/e_led.h", "void e_set_led(unsigned n, unsigned v) { LATA = n; }", "e_led_clear();",
                "the library's motor_led/e_led.c has it too and is linked for e_led_clear()"},
           Case{"motor_led/e_motors.h", "void e_set_speed_left(int v) { LATA = v; }", "e_set_speed_right(1);",
                "e_set_speed_left(): got a second definition"},
           Case{"utility/utility.h", "void wait(long n) { while (n--) ; }", "wait(9); LATA = getselector();",
                "the library's utility/utility.c has it too and is linked for getselector()"},
           Case{"motor_led/advance_one_timer/e_agenda.h",
                "void __attribute__((interrupt, auto_psv)) _T2Interrupt(void) { IFS0bits.T2IF = 0; }",
                "e_start_agendas_processing();", "_T2Interrupt(): got a second definition"},
           Case{"uart/e_uart_char.h", "int e_uart1_sending(void) { return 0; }",
                "e_send_uart1_char(\"a\", 1);", "the library's uart/e_uart1_tx_char.s has it too"},
           // whole, weak, of other files, or not in older copies
           Case{kLeds,
                "void e_set_led(unsigned n, unsigned v) { LATA = n; } void e_led_clear(void) { LATA = 0; }",
                "e_set_led(1, 1); e_led_clear();", ""},
           Case{kLeds, "void e_set_led(unsigned n, unsigned v) { LATA = n; }", "e_set_led(1, 1);", ""},
           Case{kLeds,
                "static void e_set_led(unsigned n, unsigned v) { LATA = n; } void f(void) { e_set_led(1, 1); "
                "}",
                "f(); e_led_clear();", ""},
           Case{kLeds, "void __attribute__((weak)) e_set_led(unsigned n, unsigned v) { LATA = n; }",
                "e_led_clear();", ""},
           Case{kLeds, "void snake_led(void) { LATA = 0; }", "snake_led(); e_led_clear();", ""},
           Case{"utility/utility.h", "void wait(long n) { while (n--) ; }", "wait(9);", ""},
           Case{"uart/e_uart_char.h", "int e_uart1_sending(void) { return 0; }",
                "char c; e_init_uart1(); e_getchar_uart1(&c);", ""},
           Case{"motor_led/advance_one_timer/e_motors.h", "void e_init_port(void) { LATA = 0; }",
                "e_init_port(); e_init_motors(); e_set_speed_left(1);", ""},
       }) {
    file("other.c", std::string("#include <p30F6014A.h>\n") + c.own + "\n");
    file("main.c", std::string("#include <p30F6014A.h>\n#include <") + c.headers +
                       ">\nvoid f(void);\nint main(void) { " + c.calls + " for (;;) ; }\n");
    const std::string told = build(!*c.expected);
    EXPECT_TRUE(has(told, c.expected)) << c.own << ": " << told;
  }
}

// both are whole objects on the robot, so nothing lets one of the two handlers go; a driver of which nothing is
// called is no driver, whatever its settings' file asks for
TEST_F(Built, two_drivers_of_the_library_with_one_handler_are_refused) {
  const std::string fast = "e_poxxxx_launch_capture(picture); while (!e_poxxxx_is_img_ready());",
                    slow =
                        "e_po3030k_config_cam(0, 0, 160, 160, 8, 8, GREY_SCALE_MODE); "
                        "e_po3030k_launch_capture(picture); while (!e_po3030k_is_img_ready());";
  struct Case {
    const char *motors, *camera;
    std::string calls;
    std::vector<std::string> expected;  // none: builds
  };
  for (const Case& c : {
           Case{"motor_led/e_motors.h",
                "fast_2_timer/e_poxxxx.h",
                "e_init_motors(); " + fast,
                {"error: _T5Interrupt(): got a second handler of this interrupt, expected one; the first is "
                 "in "
                 "library(",
                 "library(e_motors.c)", "library(e_timers.c)", "take a form of one that has another timer"}},
           Case{"motor_led/e_motors.h",
                "slow_3_timer/e_po3030k.h",
                "e_init_motors(); " + slow,
                {"_T4Interrupt(): got a second", "_T5Interrupt(): got a second"}},
           Case{"motor_led/e_motors.h", "fast_2_timer/e_poxxxx.h", "e_init_motors();", {}},
           Case{"motor_led/advance_one_timer/e_motors.h",
                "fast_2_timer/e_poxxxx.h",
                "e_init_motors(); " + fast,
                {}},
           Case{"motor_led/advance_one_timer/e_motors.h",
                "slow_3_timer/e_po3030k.h",
                "e_init_motors(); " + slow,
                {}},
       })
    for (const char* hal : {"sim", "dspic"}) {
      file("main.c", std::string("#include <") + c.motors + ">\n#include <camera/" + c.camera +
                         ">\nchar picture[900];\nint main(void) { " + c.calls + " for (;;) ; }\n");
      const std::string told = build(c.expected.empty(), hal);
      for (const std::string& part : c.expected) EXPECT_TRUE(has(told, part)) << part << "\n" << told;
    }
}

std::uint32_t vector_word(const dspic::FirmwareFile& image, unsigned irq, bool is_alternate = false) {
  return image.words.at((is_alternate ? 0x84 : 0x04) + 2 * (8 + irq));
}

// XC16: the number of an interrupt is its vector's, 0 for INT0
TEST_F(Built, a_handler_may_name_its_vector_by_number) {
  struct Case {
    const char *attributes, *name;  // of the vector's handler
    unsigned irq;
    bool is_alternate;
  };
  for (const Case& c : {
           Case{"interrupt(irq(3))", "_T1Interrupt", 3, false},
           Case{"__interrupt__(__irq__(3))", "_T1Interrupt", 3, false},
           Case{"interrupt(irq(3), save(kept)), auto_psv", "_T1Interrupt", 3, false},
           Case{"__interrupt__(__save__(kept), irq(TIMER_4)), no_auto_psv, shadow", "_T4Interrupt", 21,
                false},
           Case{"interrupt(irq(45))", "_Interrupt45", 45, false},
           Case{"interrupt(altirq(11))", "_AltADCInterrupt", 11, true},
       })
    for (const char* storage : {"", "static "}) {
      file("main.c", std::string("#define TIMER_4 (20 + 1)\nint kept, calls;\n") + storage +
                         "void __attribute__((" + c.attributes +
                         ")) mine(void);\nvoid mine(void) { calls++; }\nint main(void) { return calls; }\n");
      const std::string told = build();
      EXPECT_FALSE(has(told, "warning")) << c.attributes << told;
      const dspic::FirmwareFile made = image();
      const std::uint32_t at = made.functions.at(c.name);
      EXPECT_EQ(vector_word(made, c.irq, c.is_alternate), at) << c.attributes;
      EXPECT_NE(vector_word(made, c.irq, !c.is_alternate), at) << c.attributes;
    }
  // one function may serve both tables, and be called by its own name elsewhere
  file("main.c",
       "int calls; void __attribute__((interrupt(irq(3), altirq(7)))) mine(void) { calls++; }\n"
       "int main(void) { return calls; }\n");
  file("other.c", "extern void mine(void); void (*kept)(void) = mine;\n");
  build();
  const dspic::FirmwareFile made = image();
  EXPECT_EQ(vector_word(made, 3), made.functions.at("_T1Interrupt"));
  EXPECT_EQ(vector_word(made, 7, true), made.functions.at("_T1Interrupt"));
  EXPECT_EQ(place_of("_mine"), made.functions.at("_T1Interrupt"));
}

TEST_F(Built, a_second_handler_of_a_vector_and_numbers_without_one_are_refused) {
  const std::string main = " int main(void) { return 0; }\n", head = "void __attribute__((interrupt(";
  struct Case {
    std::string one, other, expected;
  };
  const std::string range = ", expected one of the vector table, 0 to 53 (3 is T1's)";
  for (const Case& c : {
           Case{head + "irq(3)))) a(void) {}\nvoid _T1Interrupt(void) {}\n" + main, "",
                "main.c:1: error: a(): got a second handler of interrupt 3, expected one; the first is "
                "_T1Interrupt() in line 2"},
           Case{head + "irq(3)))) a(void) {}\n" + head + "irq(3)))) b(void) {}\n" + main, "",
                "main.c:2: error: b(): got a second handler of interrupt 3, expected one; the first is "
                "_T1Interrupt() in line 1"},
           Case{head + "irq(3)))) a(void) {}\n" + main, "void _T1Interrupt(void) {}\n",
                "_T1Interrupt(): got a second definition"},
           Case{head + "altirq(3)))) a(void) {}\n" + main, head + "altirq(3)))) b(void) {}\n",
                "_AltT1Interrupt(): got a second definition"},
           Case{head + "irq(54)))) a(void) {}\n" + main, "",
                "main.c:1:31: error: irq: got interrupt 54" + range},
           Case{head + "altirq(-1)))) a(void) {}\n" + main, "", "altirq: got interrupt -1" + range},
           Case{"int n; " + head + "irq(n)))) a(void) {}\n" + main, "",
                "irq: got no number known here" + range},
       }) {
    file("main.c", c.one);
    file("other.c", c.other);
    const std::string told = build(false);
    EXPECT_TRUE(has(told, c.expected)) << c.expected << "\n" << told;
  }
}

TEST_F(Built, an_image_is_asked_for_by_the_name_of_its_elf_or_hex) {
  file("main.c", "int main(void) { return 0; }\n");
  for (int time = 0; time < 2; ++time) build(true, "dspic", "y.hex");  // the second takes the first's place
  for (const char* name : {"y.elf", "y.hex", "y.lst", "y.map"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_EQ(text_at(folder / "y.elf").substr(1, 3), "ELF");
  EXPECT_EQ(text_at(folder / "y.hex").substr(0, 1), ":");
  file("a_file", "");
  struct Case {
    const char *hal, *output, *expected;
  };
  for (const Case& c : {Case{"dspic", "x.txt", "x.txt: -o: got the ending .txt, expected .elf or .hex"},
                        Case{"sim", "x.hex",
                             "x.hex: -o: got .hex with --hal sim, whose image no robot takes, expected --hal "
                             "dspic, or .elf"},
                        Case{"dspic", "prog/a_file/x.elf", "prog/a_file/x.elf: image: got the folder"}}) {
    const std::string told = build(false, c.hal, c.output);
    EXPECT_TRUE(has(told, c.expected)) << told;
    EXPECT_FALSE(has(told, "half")) << told;
  }
}

// XC16 has its preprocessor read a .S file, not a .s file
TEST_F(Built, assembler_in_upper_case_is_preprocessed) {
  file("main.c", "extern int limit(void); int main(void) { return limit(); }\n");
  file("inc/limit.h",
       "#define LIMIT 0x471\n#ifdef __ASSEMBLER__\n#define FUNCTION(name) .global _##name\n#endif\n");
  file(
      "limit.S",
      "#include <p30F6014A.inc>\n#include \"inc/LIMIT.H\"\n; don't mind\nFUNCTION(limit)\n#if "
      "defined(__dsPIC30F6014A__) && LIMIT > 1\n_limit: mov #LIMIT, w0 // comment\n        return\n#endif\n");
  build();
  const dspic::FirmwareFile made = image();
  EXPECT_EQ(made.words.at(made.functions.at("limit")), 0x204710u);
  struct Case {
    const char *text, *expected;
  };
  for (const Case& c :
       {Case{"#include \"inc/limit.h\"\nFUNCTION(limit)\n_limit: mov #LIMIT, w99\n", "limit.S:3:"},
        Case{"\n#include \"nowhere.h\"\n", "limit.S:2:10: fatal error: 'nowhere.h' file not found"},
        Case{"#error of the program\n", "limit.S:1:2: error: of the program"}}) {
    file("limit.S", c.text);
    const std::string told = build(false);
    EXPECT_TRUE(has(told, c.expected)) << told;
  }
}

TEST_F(Built, assembler_of_a_project_named_like_ours_is_taken) {
  file("main.c",
       "extern int e_getchar_uart1(char *);\nint main(void) { char c; return e_getchar_uart1(&c); }\n");
  file("e_uart1_rx_char.s",
       "        .global _e_getchar_uart1\n_e_getchar_uart1: mov #0x4711, w0\n        return\n"
       "        .global __U1RXInterrupt\n__U1RXInterrupt: bclr _IFS0, #9\n        retfie\n");
  build();
  const dspic::FirmwareFile made = image();
  EXPECT_EQ(made.words.at(made.functions.at("e_getchar_uart1")), 0x247110u);
  EXPECT_FALSE(has(modules(), "library(e_uart1")) << modules();
}

// the handler's half of a driver, which nobody calls by name, comes with the other half
TEST_F(Built, handler_in_assembler_comes_with_its_driver) {
  file("main.c",
       "#include <camera/fast_2_timer/e_poxxxx.h>\nint main(void) { e_poxxxx_init_cam(); for (;;) ; }\n");
  file("lib/camera/fast_2_timer/e_timers.c",
       "int line_of_camera;\nvoid e_poxxxx_init_cam(void) { line_of_camera = 1; }\n");
  file("lib/camera/fast_2_timer/e_interrupt.s",
       "        .global __T4Interrupt\n__T4Interrupt: inc _line_of_camera\n        bclr _IFS1, #5\n        "
       "retfie\n");
  file("lib/codec/e_isr_dci.s", "        .global __DCIInterrupt\n__DCIInterrupt: retfie\n");
  build();
  EXPECT_TRUE(has(modules(), "e_interrupt.s")) << modules();
  EXPECT_FALSE(has(modules(), "e_isr_dci.s")) << modules();
  EXPECT_FALSE(has(modules(), "library(e_timers")) << modules();
}

TEST_F(Built, c_in_upper_case_is_no_cxx) {
  file("MAIN.C", "int main(void) { int class = 3, new; new = class; return new; }\n");
  build();
}

TEST_F(Built, hex_begins_with_an_extended_address_record) {
  file("main.c", "int main(void) { return 0; }\n");
  build();
  EXPECT_EQ(beside("hex").substr(0, 16), ":020000040000FA\n");
}

}  // namespace
