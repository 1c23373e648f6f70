// SPDX-License-Identifier: MIT
// Objects in XC16's file layout: each byte of data in two octets, labels of code in program addresses,
// addends in the places themselves. This one is made here, octet by octet, and linked with a program of ours.
#include <elf.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "compiler/build/build.h"
#include "compiler/cache/object_cache.h"
#include "dspic30/load/firmware_file.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

constexpr unsigned kHandleInData = 11, kFileOfMove = 7, kLiteral16 = 8, kRelativeBranch = 28, kUnknown = 52;

class VendorObject {
 public:
  VendorObject() : names_(1, '\0') {
    sections_.push_back({});
    symbols_.push_back({});
  }

  /// Words of code, four octets each, or words of data, a byte in two octets.
  unsigned section(const std::string& name, const std::vector<unsigned>& words, bool code) {
    std::string bytes;
    for (const unsigned w : words)
      for (int i = 0; i < 4; ++i) bytes += char(code ? w >> 8 * i : i % 2 ? 0 : w >> 4 * i);
    const unsigned flags = SHF_ALLOC | (code ? SHF_EXECINSTR : SHF_WRITE);
    sections_.push_back({name, SHT_PROGBITS, flags, bytes, 0, 0});
    return unsigned(sections_.size()) - 1;
  }
  unsigned symbol(const std::string& name, unsigned section, unsigned value, unsigned kind) {
    Elf32_Sym s{};
    s.st_name = Elf32_Word(names_.size());
    names_ += name + '\0';
    s.st_value = value;
    s.st_info = ELF32_ST_INFO(STB_GLOBAL, kind);
    s.st_shndx = Elf32_Half(section);
    symbols_.push_back(s);
    return unsigned(symbols_.size()) - 1;
  }
  void relocate(unsigned section, unsigned offset, unsigned type, unsigned symbol) {
    const Elf32_Rel r{offset, ELF32_R_INFO(symbol, type)};
    relocations_[section].append(reinterpret_cast<const char*>(&r), sizeof r);
  }

  /// As the older C30 makes them: the header names no chip, a symbol says who wrote it.
  void make_c30() {
    flags_ = 0;
    symbol("__C30ELF", SHN_ABS, 1, STT_NOTYPE);
  }

  std::string file() {
    for (const auto& [of, bytes] : relocations_)
      sections_.push_back({".rel" + sections_[of].name, SHT_REL, 0, bytes, 0, of});
    const unsigned table = unsigned(sections_.size());
    sections_.push_back(
        {".symtab", SHT_SYMTAB, 0,
         std::string(reinterpret_cast<const char*>(symbols_.data()), symbols_.size() * sizeof(Elf32_Sym)),
         table + 1, 1});
    sections_.push_back({".strtab", SHT_STRTAB, 0, names_, 0, 0});
    sections_.push_back({".shstrtab", SHT_STRTAB, 0, "", 0, 0});
    std::string titles(1, '\0'), body;
    std::vector<Elf32_Shdr> headers;
    for (auto& s : sections_) {
      Elf32_Shdr h{};
      h.sh_name = s.name.empty() ? 0 : Elf32_Word(titles.size());
      if (!s.name.empty()) titles += s.name + '\0';
      h.sh_type = s.type;
      h.sh_flags = s.flags;
      h.sh_info = s.info;
      h.sh_link = s.type == SHT_REL ? table : s.link;
      h.sh_addralign = 2;
      h.sh_entsize = s.type == SHT_REL ? sizeof(Elf32_Rel) : s.type == SHT_SYMTAB ? sizeof(Elf32_Sym) : 0;
      if (s.name == ".shstrtab") s.bytes = titles;
      h.sh_offset = Elf32_Off(sizeof(Elf32_Ehdr) + body.size());
      h.sh_size = Elf32_Word(s.bytes.size());
      body += s.bytes;
      headers.push_back(h);
    }
    Elf32_Ehdr e{};
    std::memcpy(e.e_ident, ELFMAG, SELFMAG);
    e.e_ident[EI_CLASS] = ELFCLASS32;
    e.e_ident[EI_DATA] = ELFDATA2LSB;
    e.e_ident[EI_VERSION] = EV_CURRENT;
    e.e_type = ET_REL;
    e.e_machine = 118;  // dsPIC30F
    e.e_version = EV_CURRENT;
    e.e_flags = flags_;
    e.e_ehsize = sizeof e;
    e.e_shentsize = sizeof(Elf32_Shdr);
    e.e_shoff = Elf32_Off(sizeof e + body.size());
    e.e_shnum = Elf32_Half(headers.size());
    e.e_shstrndx = Elf32_Half(headers.size() - 1);
    std::string all(reinterpret_cast<const char*>(&e), sizeof e);
    all += body;
    return all.append(reinterpret_cast<const char*>(headers.data()), headers.size() * sizeof(Elf32_Shdr));
  }

 private:
  struct Part {
    std::string name;
    unsigned type = SHT_NULL, flags = 0;
    std::string bytes;
    unsigned link = 0, info = 0;
  };
  std::vector<Part> sections_;
  std::vector<Elf32_Sym> symbols_;
  std::map<unsigned, std::string> relocations_;
  std::string names_;
  unsigned flags_ = 0x1F;  // the chip
};

const char* const kMain = R"(
extern int theirs(int), table[], (*pointer)(int);
int ours(int v) { return v + 1; }
int main(void) { return theirs(3) + table[1] + pointer(4); }
)";

/// _theirs: MOV _table+4,W1; MOV #_table+2,W2; RCALL _ours; RETURN. Data: three words, then a pointer to
/// _theirs.
VendorObject object(unsigned last_type, const char* called = "_ours") {
  VendorObject o;
  const unsigned code =
                     o.section(".text", {0, 0x800001 | 2 << 4, 0x200002 | 2 << 4, 0x070000, 0x060000}, true),
                 data = o.section(".ndata", {11, 22, 33, 0}, false), undefined = SHN_UNDEF;
  const unsigned theirs = o.symbol("_theirs", code, 2, STT_FUNC),
                 table = o.symbol("_table", data, 0, STT_OBJECT),
                 ours = o.symbol(called, undefined, 0, STT_NOTYPE);
  o.symbol("_pointer", data, 6, STT_OBJECT);
  o.relocate(code, 4, kFileOfMove, table);
  o.relocate(code, 8, kLiteral16, table);
  o.relocate(code, 12, kRelativeBranch, ours);
  o.relocate(data, 12, last_type, theirs);
  return o;
}

cc::ProcessResult link(VendorObject o, const fs::path& work) {
  fs::create_directories(work);
  const std::string compiler = std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc";
  std::ofstream(work / "theirs.o", std::ios::binary) << o.file();
  std::ofstream(work / "main.c") << kMain;
  std::ofstream(work / "start.s")
      << "        .section .text.__reset, \"ax\"\n        .global __reset\n__reset: rcall _main\n";
  for (const char* name : {"main.c", "start.s"}) {
    const auto made = cc::run_process(
        {compiler, "-c", (work / name).string(), "-o", (work / (std::string(name) + ".o")).string()});
    EXPECT_EQ(made.status, 0) << made.output;
  }
  return cc::run_process({compiler, "--link", "-o", (work / "x.elf").string(), (work / "main.c.o").string(),
                          (work / "start.s.o").string(), (work / "theirs.o").string()});
}

void expect_linked(VendorObject theirs, const fs::path& work) {
  const auto run = link(std::move(theirs), work);
  ASSERT_EQ(run.status, 0) << run.output;
  std::ostringstream bytes;
  bytes << std::ifstream(work / "x.elf", std::ios::binary).rdbuf();
  dspic::FirmwareFile file;
  std::string error;
  ASSERT_TRUE(dspic::load_firmware(bytes.str(), "x.elf", file, error)) << error;
  const unsigned at = file.functions.at("theirs"), table = file.objects.at("table"),
                 ours = file.functions.at("ours");
  EXPECT_EQ(file.objects.at("pointer"), table + 6);
  EXPECT_EQ(file.words.at(at), 0x800001u | (table + 4) / 2 << 4);
  EXPECT_EQ(file.words.at(at + 2), 0x200002u | (table + 2) << 4);
  EXPECT_EQ(file.words.at(at + 4), 0x070000u | ((ours - at - 6) / 2 & 0xFFFF));
  // start values: ..., 11, 22, 33, the function's address
  bool found = false;
  for (const auto& [address, word] : file.words)
    found |= word == 11 && file.words.at(address + 2) == 22 && file.words.at(address + 4) == 33 &&
             file.words.at(address + 6) == at;
  EXPECT_TRUE(found);
}

TEST(ChipLinker, object_of_xc16_links) {
  expect_linked(object(kHandleInData), fs::path(TWINPUCK_BUILD_DIR) / "tests" / "vendor_object");
}

// the e-puck's FFT comes with such a library
TEST(ChipLinker, object_of_the_older_c30_links_alike) {
  VendorObject theirs = object(kHandleInData);
  theirs.make_c30();
  expect_linked(std::move(theirs), fs::path(TWINPUCK_BUILD_DIR) / "tests" / "c30_object");
}

TEST(ChipLinker, objects_in_coff_are_refused_by_name) {
  const fs::path work = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "coff_object";
  fs::create_directories(work);
  std::ofstream(work / "old.o", std::ios::binary) << std::string("\x36\x12\1\0", 4) + std::string(60, '\0');
  fs::remove(work / "libold.a");
  cc::run_process({"ar", "rcS", (work / "libold.a").string(), (work / "old.o").string()});
  std::ofstream(work / "main.c") << "int old(int);\nint main(void) { return old(1); }\n";
  const std::string compiler = std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc";
  cc::run_process({compiler, "-c", (work / "main.c").string(), "-o", (work / "main.o").string()});
  std::ofstream(work / "start.s")
      << "        .section .text.__reset, \"ax\"\n        .global __reset\n__reset: rcall _main\n";
  cc::run_process({compiler, "-c", (work / "start.s").string(), "-o", (work / "start.o").string()});
  const auto alone = cc::run_process({compiler, "--link", "-o", (work / "x.elf").string(),
                                      (work / "main.o").string(), (work / "old.o").string()});
  EXPECT_NE(alone.status, 0);
  EXPECT_TRUE(wording::reads(alone.output,
                             "link: error: @/old.o: got an object in COFF, C30's first format, expected ELF; "
                             "have it compiled with -omf=elf, or give its source",
                             {{work.string(), "@"}}));
  const auto packed =
      cc::run_process({compiler, "--link", "-o", (work / "x.elf").string(), (work / "main.o").string(),
                       (work / "start.o").string(), "--library", (work / "libold.a").string()});
  EXPECT_NE(packed.status, 0);
  EXPECT_TRUE(wording::reads(
      packed.output,
      "…/coff_object/main.c:2: error: main() calls old(): got no definition, expected one in the program or "
      "the library; @/libold.a holds COFF, C30's first format, which is not read",
      {{work.string(), "@"}}));
}

// its name says which conversions the format has
TEST(ChipLinker, formatted_output_of_xc16_is_the_librarys) {
  for (const auto& [called, expected] :
       {std::pair{"__ours_0",
                  "…/vendor_printf/theirs.o: error: theirs() calls _ours_0(): got no definition, expected "
                  "one in the program or the library"},
        {"__sprintf_",
         "…/vendor_printf/theirs.o: error: theirs() calls _sprintf_(): got no definition, expected one in "
         "the program or the library"},
        {"__sprintf_0",
         "…/vendor_printf/theirs.o: error: theirs() calls sprintf(): got no definition, expected one in the "
         "program or the library"},
        {"__vfprintf_cdfFnopuxX",
         "…/vendor_printf/theirs.o: error: theirs() calls vfprintf(): got no definition, expected one in the "
         "program or the library"}}) {
    const auto run =
        link(object(kHandleInData, called), fs::path(TWINPUCK_BUILD_DIR) / "tests" / "vendor_printf");
    EXPECT_NE(run.status, 0);
    EXPECT_TRUE(wording::reads(run.output, expected));
  }
  // each of them, and a letter that is no conversion
  const std::string told = ": got no definition, expected one in the program or the library";
  for (const std::string name : {"fprintf", "fscanf", "printf", "scanf", "snprintf", "sprintf", "sscanf",
                                 "vfprintf", "vprintf", "vsnprintf", "vsprintf"})
    for (const auto& [called, expected] :
         {std::pair{"__" + name + "_cdeEfFgGinopsuxXaA0", name}, {"__" + name + "_dq", "_" + name + "_dq"}}) {
      const auto run = link(object(kHandleInData, called.c_str()),
                            fs::path(TWINPUCK_BUILD_DIR) / "tests" / "vendor_printf");
      EXPECT_TRUE(wording::reads(
          run.output, "…/vendor_printf/theirs.o: error: theirs() calls " + expected + "()" + told));
    }
}

TEST(ChipLinker, compiler_called_by_hand_finds_its_headers) {
  const fs::path work = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "by_hand";
  fs::create_directories(work);
  std::ofstream(work / "x.c")
      << "#include <stdarg.h>\n#include <stdio.h>\n#include <p30F6014A.h>\n"
         "#include <motor_led/e_led.h>\nint main(void) { e_set_led(0, 1); return TMR1; }\n";
  const auto made = cc::run_process({std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc", "-c",
                                     (work / "x.c").string(), "-o", (work / "x.o").string()});
  EXPECT_EQ(made.status, 0) << made.output;
}

// _theirs alone is asked for; the program's own file and the archive lie in one folder
TEST(ChipLinker, archive_beside_a_program_is_linked) {
  const fs::path work = fs::temp_directory_path() / ("twinpuck-archive-" + std::to_string(getpid()));
  fs::create_directories(work / "program");
  std::ofstream(work / "theirs.o", std::ios::binary) << object(kHandleInData).file();
  std::ofstream(work / "program/main.c") << kMain;
  const auto packed =
      cc::run_process({"ar", "rc", (work / "program/libtheirs.a").string(), (work / "theirs.o").string()});
  ASSERT_EQ(packed.status, 0) << packed.output;
  cc::BuildOptions options;
  options.source_dir = work / "program";
  options.output = work / "x.elf";
  options.cache_dir = work / "cache";
  const auto built = cc::build_image(options);
  EXPECT_TRUE(built.ok) << (built.errors.empty() ? "" : built.errors[0]);
  fs::remove_all(work);
}

TEST(ChipLinker, unknown_relocation_is_named) {
  const auto run = link(object(kUnknown), fs::path(TWINPUCK_BUILD_DIR) / "tests" / "vendor_object_unknown");
  EXPECT_NE(run.status, 0);
  EXPECT_TRUE(wording::reads(run.output,
                             "link: error: …/vendor_object_unknown/theirs.o: .ndata: relocation of type 52 "
                             "to _theirs is not known here"));
}

TEST(ChipLinker, call_farther_than_rcall_reaches_goes_by_way_of_a_jump) {
  // jumps lie in the middle, and what is placed behind them is more than 32,767 words from the start
  const fs::path work = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "far_call";
  fs::create_directories(work);
  const std::string compiler = std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc";
  std::ofstream(work / "x.s") << R"(
        .section .text.__reset, "ax"
        .global __reset
__reset: rcall _far
        rcall _first
        rcall _second
        rcall _third
        .macro  fill words
        .rept   \words
        nop
        .endr
        return
        .endm
        .section .text._first, "ax"
_first: fill 10000
        .section .text._second, "ax"
_second: fill 9000
        .section .text._third, "ax"
_third: fill 9000
        .section .text._far, "ax"
        .global _far
_far:   fill 7000
)";
  const auto made = cc::run_process({compiler, (work / "x.s").string(), "-o", (work / "x.o").string()});
  ASSERT_EQ(made.status, 0) << made.output;
  const auto run =
      cc::run_process({compiler, "--link", "-o", (work / "x.elf").string(), (work / "x.o").string()});
  ASSERT_EQ(run.status, 0) << run.output;
  std::ostringstream bytes;
  bytes << std::ifstream(work / "x.elf", std::ios::binary).rdbuf();
  dspic::FirmwareFile file;
  std::string error;
  ASSERT_TRUE(dspic::load_firmware(bytes.str(), "x.elf", file, error)) << error;
  const unsigned far = file.functions.at("far");
  bool found = false;
  for (const char* name : {"_reset", "__reset"}) {
    const auto start = file.functions.find(name);
    if (start == file.functions.end()) continue;
    const unsigned target = start->second + 2 + 2 * std::int16_t(file.words.at(start->second));
    // GOTO of 24 bits in two words
    found = file.words.at(target) == (0x040000u | (far & 0xFFFE)) && file.words.at(target + 2) == far >> 16;
    if (std::abs(int(far) - int(start->second)) / 2 < 0x8000) ADD_FAILURE() << "not far: " << std::hex << far;
  }
  EXPECT_TRUE(found);
}

}  // namespace
