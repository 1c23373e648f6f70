// SPDX-License-Identifier: MIT
// One program, two HALs: the image for hal_sim is hal_dspic's but for what the simulator fills.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <sstream>

#include "compiler/build/build.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/host_places.h"
#include "dspic30/memory/program_memory.h"
#include "hal_sim/api/host_table.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;
using dspic::FirmwareFile;

/// One program linked with both.
struct Pair {
  FirmwareFile sim, dspic;
  cc::BuildResult of_sim, of_dspic;

  std::string notes() const {
    std::string all;
    for (const std::string& note : of_sim.notes) all += note + "\n";
    return all;
  }
  std::string errors() const {
    std::string all;
    for (const auto* result : {&of_sim, &of_dspic})
      for (const std::string& error : result->errors) all += error + "\n";
    return all;
  }
};

/// Of this process: programs one after the other, and their objects.
struct Workplace {
  fs::path path = fs::temp_directory_path() / ("twinpuck-host-link-" + std::to_string(getpid()));
  ~Workplace() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

const fs::path& workplace() {
  static const Workplace place;
  return place.path;
}

/// `cache`: of objects; empty: what builds of controllers have.
Pair linked(const fs::path& folder, const fs::path& cache) {
  Pair pair;
  cc::BuildOptions options;
  options.source_dir = folder;
  options.cache_dir = cache;
  for (const char* hal : {"sim", "dspic"}) {
    const bool is_sim = hal == std::string("sim");
    options.hal = hal;
    options.output = workplace() / (hal + std::string(".elf"));
    (is_sim ? pair.of_sim : pair.of_dspic) = cc::build_image(options);
    std::ostringstream bytes;
    bytes << std::ifstream(options.output, std::ios::binary).rdbuf();
    std::string error;
    FirmwareFile& file = is_sim ? pair.sim : pair.dspic;
    EXPECT_TRUE(dspic::load_firmware(bytes.str(), options.output.string(), file, error)) << error;
    EXPECT_EQ(dspic::hal_of(file), hal);
  }
  EXPECT_EQ(pair.of_dspic.compiled, 0);  // the same objects
  return pair;
}

Pair program(const std::string& text, const std::string& other = "") {
  const fs::path folder = workplace() / "program";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "main.c") << text;
  if (!other.empty()) std::ofstream(folder / "other.c") << other;
  Pair pair = linked(folder, workplace() / "cache");
  EXPECT_EQ(pair.errors(), "");
  return pair;
}

/// What both HALs say of a program with an array of `bytes`, errors and warnings; "": nothing.
std::string said_of(const std::string& head, const std::string& body, unsigned bytes, bool sanitize = false) {
  const fs::path folder = workplace() / "sizes";
  fs::create_directories(folder);
  std::ofstream(folder / "main.c") << head << "char b[" << bytes << "];\nint main(void) { " << body
                                   << " b[0] = 1; while (1); }\n";
  std::string first;
  for (const char* hal : {"sim", "dspic"}) {
    cc::BuildOptions options;
    options.source_dir = folder;
    options.cache_dir = workplace() / "cache";
    options.hal = hal;
    options.output = workplace() / (hal + std::string("-sizes.elf"));
    options.sanitize = sanitize;
    const cc::BuildResult result = cc::build_image(options);
    std::string said;
    for (const auto* list : {&result.errors, &result.warnings})
      for (const std::string& line : *list) said += line.substr(0, line.find("; largest:")) + "\n";
    if (result.ok) said += "left " + std::to_string(result.ram_bytes) + "\n";
    if (hal == std::string("sim"))
      first = said;
    else
      EXPECT_EQ(said, first) << bytes;
  }
  return first;
}

// 8192 bytes of RAM: what variables leave holds the heap of 512 bytes, if anybody asks for it, and 16 of stack
TEST(HeapAndStack, have_room_of_their_own_or_nothing_is_linked) {
  const std::string agenda = "#include <motor_led/advance_one_timer/e_agenda.h>\nvoid f(void) {}\n",
                    heap = "#include <stdlib.h>\n";
  struct Case {
    const char* what;
    std::string head, body;
    unsigned bytes;
    const char* says;
  };
  const Case cases[] = {
      {"nothing_of_a_heap", "", "", 8176, "left 8176"},
      {"no_stack", "", "", 8178,
       "no room for the stack: got 14 bytes that variables leave in one piece, "
       "expected at least 16"},
      {"nothing_left", "", "", 8192, "no room for the stack: got 0 bytes"},
      {"malloc_with_room", heap, "char *p = malloc(10); p[0] = 1;", 7600, "left 8113"},
      {"malloc_without_stack", heap, "char *p = malloc(10); p[0] = 1;", 7670,
       "no room for the stack: got 8 bytes that variables and the heap of 512 bytes leave in one piece"},
      {"malloc_without_room", heap, "char *p = malloc(10); p[0] = 1;", 7700,
       "no room for the heap: got 490 bytes that variables leave in one piece, expected at least 512 for "
       "main()"},
      {"agenda_with_room", agenda, "e_activate_agenda(f, 10);", 7500, "left 8019"},
      {"agenda_without_room", agenda, "e_activate_agenda(f, 10);", 7750,
       "no room for the heap: got 434 bytes that variables leave in one piece, expected at least 512 for "
       "e_activate_agenda()"},
  };
  for (const Case& c : cases)
    EXPECT_NE(said_of(c.head, c.body, c.bytes).find(c.says), std::string::npos)
        << c.what << ": " << said_of(c.head, c.body, c.bytes);
  // of an image to be checked the gaps behind variables go first
  EXPECT_NE(said_of(heap, "char *p = malloc(10); p[0] = 1;", 7700, true).find("no room for the heap"),
            std::string::npos);
}

/// The host's function at a program address; -1: none.
int host_function(const FirmwareFile& file, std::uint32_t address) {
  const auto word = file.words.find(address), next = file.words.find(address + 2);
  if (word == file.words.end() || next == file.words.end() || word->second >> 16 != 4) return -1;
  const std::uint32_t to = next->second << 16 | (word->second & 0xFFFF);
  return dspic::is_host_place(to) ? int(to - dspic::kHostStart) / 2 : -1;
}

bool is_filled(const FirmwareFile& file, const std::string& function) {
  const auto at = file.functions.find(function);
  if (at == file.functions.end()) {
    ADD_FAILURE() << function << " is not linked";
    return false;
  }
  const int index = host_function(file, at->second);
  if (index >= 0) {
    EXPECT_EQ(api::kHostFunctions[index].name, function);
  }
  return index >= 0;
}

std::uint32_t vector_of(const FirmwareFile& file, int vector) {
  return file.words.at(4 + 2 * unsigned(vector));
}
constexpr int kT2 = 8 + 6, kAdc = 8 + 11;  // [DS70143 table 5-1]

/// Whatever is in both lies at the same place, and only drivers are missing in one.
void expect_same_places(const Pair& pair, const std::string& name) {
  std::set<std::pair<std::string, std::uint32_t>> there;  // files may have static ones of one name
  for (const auto& f : pair.dspic.code.functions) there.insert({f.name, f.begin});
  for (const auto& f : pair.sim.code.functions)
    EXPECT_EQ(there.count({f.name, f.begin}), 1u) << name << ": " << f.name;
  for (const auto& [symbol, address] : pair.sim.objects) {
    ASSERT_EQ(pair.dspic.objects.count(symbol), 1u) << name << ": " << symbol;
    EXPECT_EQ(pair.dspic.objects.at(symbol), address) << name << ": " << symbol;
  }
  // each word is the same, or of a driver: a GOTO to the host, nothing, or a vector
  for (const auto& [address, word] : pair.sim.words) {
    const bool is_goto = host_function(pair.sim, address) >= 0 || host_function(pair.sim, address - 2) >= 0;
    const auto there = pair.dspic.words.find(address);
    ASSERT_NE(there, pair.dspic.words.end()) << name << std::hex << ": " << address;
    if (!is_goto && address >= 0x100) {
      EXPECT_EQ(there->second, word) << name << std::hex << ": " << address;
    }
  }
}

constexpr const char* kBoth = R"(
#include <p30F6014A.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
extern int e_mic_scan[3][MIC_SAMP_NB];
extern unsigned int tickAdcIsr;
extern unsigned char updateAccI2CCounter;
int own[100] = {1, 2, 3}, counter;
const int table[20] = {7, 8, 9};
int (*steps)(void) = e_get_steps_left;
void turn(void) { e_set_speed_left(table[counter++ % 20] + own[counter % 100] + (*steps)()); }
int main(void) {
  e_init_port();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  e_activate_agenda(turn, 10);
  e_start_agendas_processing();
  for (;;) {
    if (tickAdcIsr & 1) updateAccI2CCounter |= 4;
    tickAdcIsr++;
    own[5] = e_mic_scan[1][7] + e_get_prox(3);
  }
}
)";

TEST(TwoHals, drivers_are_filled_and_all_else_stays_where_it_is) {
  const Pair pair = program(kBoth);
  EXPECT_EQ(pair.notes(), "");
  for (const char* function : {"e_init_motors", "e_set_speed_left", "e_get_steps_left", "run_left_motor",
                               "e_activate_agenda", "e_start_agendas_processing", "e_init_ad_scan"}) {
    EXPECT_TRUE(is_filled(pair.sim, function)) << function;
    EXPECT_FALSE(is_filled(pair.dspic, function)) << function;
  }
  EXPECT_FALSE(is_filled(pair.sim, "e_init_port"));
  expect_same_places(pair, "both");
  // nobody's handlers, as without drivers; the others' vectors are the same
  for (const int vector : {kT2, kAdc}) {
    EXPECT_EQ(vector_of(pair.sim, vector), vector_of(pair.sim, 8 + 1)) << vector;
    EXPECT_NE(vector_of(pair.dspic, vector), vector_of(pair.dspic, 8 + 1)) << vector;
  }
  for (const char* inner : {"_T2Interrupt", "_ADCInterrupt", "fire", "set_half"}) {
    EXPECT_EQ(pair.sim.functions.count(inner), 0u) << inner;
    EXPECT_EQ(pair.dspic.functions.count(inner), 1u) << inner;
  }
  EXPECT_EQ(pair.sim.objects.count("agendas"), 0u);
  EXPECT_EQ(pair.dspic.objects.count("agendas"), 1u);
}

// readings are filled with the scan, but for what the program has of its own, or where the scan is the chip's
TEST(TwoHals, readings_are_filled_where_they_are_the_librarys) {
  const std::string text = kBoth, used = "void (*more_)(void) = more;\n";
  const Pair pair =
      program(text + "void more(void) { e_calibrate_ir(); own[1] = e_get_ambient_light(2); }\n" + used);
  EXPECT_TRUE(is_filled(pair.sim, "e_get_prox"));
  EXPECT_TRUE(is_filled(pair.sim, "e_get_ambient_light"));
  EXPECT_FALSE(is_filled(pair.sim, "e_calibrate_ir"));
  EXPECT_FALSE(is_filled(pair.dspic, "e_get_prox"));
  expect_same_places(pair, "readings");
  const Pair own =
      program(text + "int __attribute__((noinline)) e_get_prox(unsigned int n) { return table[n]; }\n");
  EXPECT_EQ(own.notes(), "");
  EXPECT_FALSE(is_filled(own.sim, "e_get_prox"));
  EXPECT_TRUE(is_filled(own.sim, "e_init_ad_scan"));
  expect_same_places(own, "its own reading");
  const Pair chips = program(text + "void more(void) { ADCON1bits.ADON = 0; }\n" + used);
  EXPECT_NE(chips.notes(), "");
  EXPECT_FALSE(is_filled(chips.sim, "e_get_prox"));
}

// the pointer in RAM has the function's own address, in both: its start value is read from the image
TEST(TwoHals, pointers_to_filled_functions_are_the_same) {
  const Pair pair = program(kBoth);
  EXPECT_EQ(pair.sim.functions.at("e_get_steps_left"), pair.dspic.functions.at("e_get_steps_left"));
  EXPECT_TRUE(is_filled(pair.sim, "e_get_steps_left"));
}

TEST(TwoHals, registers_of_the_scan_lie_first_in_the_tables_order) {
  const Pair pair = program(kBoth);
  unsigned at = 0x800;
  for (const api::HostRegister& row : api::kHostRegisters) {
    for (const FirmwareFile* file : {&pair.sim, &pair.dspic}) {
      EXPECT_EQ(file->objects.at(row.name), at) << row.name;
      EXPECT_LE(file->object_bytes.at(row.name), row.bytes) << row.name;
    }
    at += (row.bytes + 1) & ~1u;
  }
  EXPECT_EQ(pair.sim.marks.at(dspic::kServedEndSymbol), at);
  EXPECT_EQ(pair.dspic.marks.count(dspic::kServedEndSymbol), 0u);
  EXPECT_EQ(pair.sim.marks.at(dspic::kHostTableSymbol), api::host_table_sum());
  EXPECT_EQ(pair.dspic.marks.count(dspic::kHostTableSymbol), 0u);
  for (const char* own : {"own", "counter", "steps"}) EXPECT_GE(pair.sim.objects.at(own), at) << own;
}

// served registers are near: BSET and INC reach them without a pointer
TEST(TwoHals, instructions_on_registers_name_them) {
  const Pair pair = program(kBoth);
  const std::uint32_t ticks = pair.sim.objects.at("tickAdcIsr");
  ASSERT_LT(ticks, 0x2000u);
  bool is_named = false;
  for (const auto& [address, word] : pair.sim.words)
    is_named |=
        address < dspic::kFlashEnd && (word & 0xFF2000) == 0xEC2000 && (word & 0x1FFF) == ticks;  // INC f
  EXPECT_TRUE(is_named);
}

TEST(TwoHals, program_without_drivers_has_no_registers) {
  const Pair pair = program("volatile int count;\nint main(void) { for (;;) count++; }\n");
  EXPECT_EQ(pair.sim.marks.at(dspic::kServedEndSymbol), 0x800u);
  EXPECT_EQ(pair.sim.objects.at("count"), 0x800u);
  EXPECT_EQ(pair.sim.words, pair.dspic.words);
}

struct Case {
  const char *name, *text, *notes;
  bool is_agenda_filled, is_scan_filled;
};

constexpr const char* kIncludes = R"(
#include <p30F6014A.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#define START e_init_motors(); e_set_speed_left(3); e_init_ad_scan(0)
)";

const Case kCases[] = {
    {"control register", "int main(void) { START; T2CON = 0; for (;;) ; }",
     "agenda: the chip's own driver, since main.c:8 uses T2CON\n", false, true},
    {"bit of a control register", "int main(void) { START;\n T2CONbits.TCKPS = 1; for (;;) ; }",
     "agenda: the chip's own driver, since main.c:9 uses T2CON\n", false, true},
    {"counter", "int n;\nint main(void) { START; n = TMR2; for (;;) ; }",
     "agenda: the chip's own driver, since main.c:9 uses TMR2\n", false, true},
    {"handler",
     "void __attribute__((interrupt, auto_psv)) _T2Interrupt(void) { IFS0bits.T2IF = 0; }\n"
     "int main(void) { START; for (;;) ; }",
     "agenda: the chip's own driver, since main.c:8 has _T2Interrupt()\n", false, true},
    {"converter", "int main(void) { START; ADCON1bits.ADON = 0; for (;;) ; }",
     "scan: the chip's own driver, since main.c:8 uses ADCON1\n", true, false},
    {"converter's result", "int n;\nint main(void) { START; n = ADCBUF0; for (;;) ; }",
     "scan: the chip's own driver, since main.c:9 uses ADCBUF0\n", true, false},
    {"both", "int main(void) { START; PR2 = 100; ADCHS = 0; for (;;) ; }",
     "agenda: the chip's own driver, since main.c:8 uses PR2\n"
     "scan: the chip's own driver, since main.c:8 uses ADCHS\n",
     false, false},
    {"inner variable",
     "extern void* volatile hal_running_agenda;\n"
     "int main(void) { START; hal_running_agenda = 0; for (;;) ; }",
     "agenda: the chip's own driver, since main.c:9 uses hal_running_agenda\n", false, true},
    {"clock of the C library",
     "#include <time.h>\nlong n;\nint main(void) { START; n = time(0); for (;;) ; }",
     "agenda: the chip's own driver, since library(time.c) uses T2CON\n", false, true},
    {"function in a variable's place",
     "int selector(void) { return 3; }\nint main(void) { START; return selector(); }",
     "scan: the chip's own driver, since main.c:8 has selector\n", true, false},
    {"larger variable in its place", "int tickAdcIsr[2];\nint main(void) { START; return tickAdcIsr[1]; }",
     "scan: the chip's own driver, since main.c has tickAdcIsr\n", true, false},
    {"variable where registers lie",
     "int n __attribute__((address(0x810)));\nint main(void) { START; return n++; }",
     "scan: the chip's own driver, since main.c has a variable at 0x0810\n", true, false},
    // --- what keeps nobody from filling them
    {"code that is never called",
     "void never(void) { T2CON = 0; ADCON1 = 0; }\nint main(void) { START; for (;;) ; }", "", true, true},
    {"other timers and bits of interrupts",
     "int main(void) { START; T3CON = 0x8000; IEC0bits.T2IE = 0;\n"
     "IPC1bits.T2IP = 2; ADPCFG = 0xFFFF; for (;;) ; }",
     "", true, true},
    {"variable of the program in a register's place",
     "int selector = 5;\nint main(void) { START; return selector; }", "", true, true},
    {"smaller one, uninitialised", "char selector;\nint main(void) { START; return selector; }", "", true,
     true},
};

class TwoHalsCase : public ::testing::TestWithParam<Case> {};

TEST_P(TwoHalsCase, driver_by_driver) {
  const Case& c = GetParam();
  const Pair pair = program(std::string(kIncludes) + c.text + "\n");
  std::string notes = pair.notes();
  for (std::size_t at; (at = notes.find((workplace() / "program/").string())) != std::string::npos;)
    notes.erase(at, (workplace() / "program/").string().size());
  EXPECT_EQ(notes, c.notes) << c.name;
  EXPECT_EQ(is_filled(pair.sim, "e_init_motors"), c.is_agenda_filled) << c.name;
  EXPECT_EQ(is_filled(pair.sim, "e_init_ad_scan"), c.is_scan_filled) << c.name;
  EXPECT_EQ(pair.sim.functions.count("_ADCInterrupt"), c.is_scan_filled ? 0u : 1u) << c.name;
  EXPECT_EQ(pair.sim.marks.at(dspic::kServedEndSymbol) > 0x800, c.is_scan_filled) << c.name;
  EXPECT_TRUE(pair.of_dspic.notes.empty()) << c.name;
  expect_same_places(pair, c.name);
}
INSTANTIATE_TEST_SUITE_P(All, TwoHalsCase, ::testing::ValuesIn(kCases), [](const auto& of) {
  std::string name = of.param.name;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
});

// the scan's variable is the program's, where the scan writes it: with its start value
TEST(TwoHals, variable_in_a_registers_place_lies_there) {
  const Pair pair =
      program(std::string(kIncludes) + "int selector = 5;\nint main(void) { START; return selector; }\n");
  for (const FirmwareFile* file : {&pair.sim, &pair.dspic}) EXPECT_EQ(file->objects.at("selector"), 0x804u);
}

// all of a copied driver is the copy's, and nothing of the library's is there to fill
TEST(TwoHals, copy_of_a_driver_is_the_programs) {
  const std::string motors =
      "void e_init_motors(void) {}\nint left;\nvoid e_set_speed_left(int v) { left = v; }\n";
  const Pair pair = program(std::string(kIncludes) + "int main(void) { START; for (;;) ; }\n", motors);
  EXPECT_TRUE(wording::reads(
      pair.notes(), "agenda: the program's own driver, since …/program/other.c:1 has e_init_motors()"));
  EXPECT_FALSE(is_filled(pair.sim, "e_init_motors"));
  EXPECT_TRUE(is_filled(pair.sim, "e_init_ad_scan"));
  expect_same_places(pair, "copy");
}

// the agenda beside the fast agenda: the robot's linker refuses the second handler, and so do both HALs
TEST(TwoHals, library_driver_on_the_same_timer) {
  const fs::path folder = workplace() / "two-agendas";
  fs::create_directories(folder);
  std::ofstream(folder / "main.c")
      << "#include <motor_led/advance_one_timer/e_motors.h>\n"
         "#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>\n"
         "void f(void) {}\n"
         "int main(void) { e_init_motors(); e_set_speed_left(1); e_configure_timer(1); "
         "e_activate_agenda(f, 10); for (;;) ; }\n";
  cc::BuildOptions options;
  options.source_dir = folder;
  options.cache_dir = workplace() / "cache";
  for (const char* hal : {"sim", "dspic"}) {
    options.hal = hal;
    options.output = workplace() / "two-agendas.elf";
    const cc::BuildResult result = cc::build_image(options);
    std::string errors;
    for (const std::string& error : result.errors) errors += error + "\n";
    EXPECT_FALSE(result.ok) << hal;
    EXPECT_NE(errors.find("_T2Interrupt(): got a second handler of this interrupt"), std::string::npos)
        << errors;
    EXPECT_NE(errors.find("e_agenda_fast.c"), std::string::npos) << errors;
    EXPECT_NE(errors.find("e_agenda.c"), std::string::npos) << errors;
  }
}

// more code than a RCALL reaches: calls go by handles, which lead to the function's place
TEST(TwoHals, far_calls_find_filled_functions) {
  std::string text = kIncludes;
  for (int i = 0; i < 24; ++i)
    text += "void f" + std::to_string(i) + "(volatile int* p) {\n" + [] {
      std::string lines;
      for (int k = 0; k < 320; ++k) lines += "  p[" + std::to_string(k % 7) + "] += p[3] ^ 12345;\n";
      return lines;
    }() + "  e_set_speed_left(p[0]);\n}\n";
  text += "volatile int a[8];\nint main(void) {\n  START;\n";
  for (int i = 0; i < 24; ++i) text += "  f" + std::to_string(i) + "(a);\n";
  const Pair pair = program(text + "  for (;;) ;\n}\n");
  EXPECT_TRUE(is_filled(pair.sim, "e_set_speed_left"));
  expect_same_places(pair, "far");
}

TEST(TwoHals, every_controller_lies_at_the_same_places) {
  int controllers = 0;
  for (const char* place : {"firmware", "firmware/lab"})
    for (const auto& folder : fs::directory_iterator(fs::path(TWINPUCK_SOURCE_DIR) / place)) {
      const std::string name = folder.path().filename().string();
      if (!fs::exists(folder.path() / "main.c") && !fs::exists(folder.path() / (name + ".c"))) continue;
      const Pair pair = linked(folder.path(), "");
      EXPECT_EQ(pair.errors(), "") << name;
      expect_same_places(pair, name);
      EXPECT_EQ(pair.of_sim.size_report, pair.of_dspic.size_report) << name;
      ++controllers;
    }
  EXPECT_GE(controllers, 20);
}

// what does not fit the chip does not link for hal_sim either, and a stack without room is told
TEST(TwoHals, limits_are_the_chips) {
  const fs::path folder = workplace() / "large";
  fs::create_directories(folder);
  std::ofstream(folder / "main.c") << kIncludes
                                   << "char big[7300];\nint main(void) { START; return big[3]; }\n";
  cc::BuildOptions options;
  options.source_dir = folder;
  options.cache_dir = workplace() / "cache";
  options.output = workplace() / "large.elf";
  for (const char* hal : {"sim", "dspic"}) {
    options.hal = hal;
    const cc::BuildResult result = cc::build_image(options);
    ASSERT_FALSE(result.errors.empty()) << hal;
    EXPECT_TRUE(wording::reads(result.errors[0],
                               "link: error: RAM: no room for big, 7300 bytes in 0x0800 to 0x27FF; largest: "
                               "big 7300, e_mic_scan 600, e_acc_scan 300, e_ambient_and_reflected_ir 20, "
                               "e_ambient_ir 20, left_wheel 6, right_wheel 6, agendas 2"));
  }
}

}  // namespace
