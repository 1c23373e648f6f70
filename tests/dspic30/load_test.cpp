// SPDX-License-Identifier: MIT
// Program files: what is read, and what is said about broken ones.
#include <gtest/gtest.h>

#include <map>

#include "dspic30/load/firmware_file.h"
#include "tests/support/wording.h"

namespace {

using dspic::FirmwareFile;

std::string error_of(const std::string& text) {
  FirmwareFile file;
  std::string error;
  EXPECT_FALSE(dspic::load_firmware(text, "x.hex", file, error));
  return error;
}

// goto 0x100: words 0x040100 at 0 and 0x000000 at 2; EEPROM word 0 = 0x1234 at 0x7FF000; FOSC
constexpr const char* kHex =
    ":080000000001040000000000F3\n"
    ":0200000400FFFB\n"
    ":04E000003412000 0D6\n";

std::string good_hex() {
  return ":080000000001040000000000F3\r\n"
         ":0200000400FFFB\n"
         ":04E000003412FF00D7\n"
         ":0200000401F009\n"
         ":04000000E6FF000017\n"
         ":00000001FF\n";
}

TEST(Hex, words_stand_at_half_their_byte_address) {
  FirmwareFile file;
  std::string error;
  ASSERT_TRUE(dspic::load_firmware(good_hex(), "x.hex", file, error)) << error;
  EXPECT_EQ(file.words.size(), 4u);
  EXPECT_EQ(file.words[0], 0x040100u);
  EXPECT_EQ(file.words[2], 0u);
  EXPECT_EQ(file.words[0x7FF000], 0xFF1234u);
  EXPECT_EQ(file.words[0xF80000], 0x00FFE6u);
}

TEST(Hex, comes_back_from_what_is_written) {
  FirmwareFile file, again;
  std::string error;
  ASSERT_TRUE(dspic::load_firmware(good_hex(), "x.hex", file, error)) << error;
  for (std::uint32_t a = 0x100; a < 0x150; a += 2) file.words[a] = a * 77;
  ASSERT_TRUE(dspic::load_firmware(dspic::to_hex(file), "y.hex", again, error)) << error;
  EXPECT_EQ(again.words, file.words);
}

TEST(Hex, a_record_runs_on_over_64_kilobytes_but_a_segment_wraps_round) {
  FirmwareFile linear, segment;
  std::string error;
  const std::string record = ":10FFF80001000000020000000300000004000000EF\n:00000001FF\n";
  ASSERT_TRUE(dspic::load_firmware(":020000040000FA\n" + record, "x.hex", linear, error)) << error;
  EXPECT_EQ(linear.words,
            (std::map<std::uint32_t, std::uint32_t>{{0x7FFC, 1}, {0x7FFE, 2}, {0x8000, 3}, {0x8002, 4}}));
  ASSERT_TRUE(dspic::load_firmware(":020000020000FC\n" + record, "x.hex", segment, error)) << error;
  EXPECT_EQ(segment.words,
            (std::map<std::uint32_t, std::uint32_t>{{0, 3}, {2, 4}, {0x7FFC, 1}, {0x7FFE, 2}}));
  FirmwareFile both;
  ASSERT_TRUE(dspic::load_firmware(":020000020000FC\n:020000040000FA\n" + record, "x.hex", both, error))
      << error;
  EXPECT_EQ(both.words, linear.words) << "the newer record counts";
}

TEST(Hex, what_is_wrong_is_named_with_its_line) {
  EXPECT_EQ(error_of(":080000000001040000000000F4\n:00000001FF\n"),
            "x.hex: line 1: checksum got 0xf4, expected 0xf3");
  EXPECT_EQ(error_of(":080000000001040000000000F3\n"),
            "x.hex: the file ends without an end record (:00000001FF); is it cut off?");
  EXPECT_EQ(error_of(":08000000000104\n"), "x.hex: line 1: got 7 bytes, expected 13");
  EXPECT_EQ(error_of(kHex), "x.hex: line 3: column 16: expected pairs of hexadecimal digits");
  EXPECT_EQ(error_of(":00000001FF\n"), "x.hex: there is no program in it");
  EXPECT_EQ(error_of(":020000040003F7\n:0400000000000000FC\n:00000001FF\n"),
            "x.hex: line 2: address 0x018000 is in no memory of this chip");
  EXPECT_EQ(error_of(":0400000000010400F7\n:0400000000020400F6\n:00000001FF\n"),
            "x.hex: line 2: address 0x000000 comes a second time, with another value");
  EXPECT_EQ(error_of(":00000009F7\n"), "x.hex: line 1: record type got 0x09, expected 0x00 to 0x05");
}

// whatever it is, it is named, with what was expected
TEST(Image, what_is_none_is_named) {
  const std::string elf(
      "\x7f"
      "ELF\1\1\1",
      7);
  const struct {
    std::string bytes, says;
  } kFiles[] = {
      {"", "an empty file"},
      {"hello", "a file that is neither Intel HEX nor ELF"},
      {"\x36\x12 and more", "a COFF of the dsPIC, as MPLAB C30 made by default"},
      {elf, "an ELF file that has been cut off"},
      {elf + std::string(11, '\0') + std::string("\x3e\0", 2), "a program or library of this PC"},
      {elf + std::string(11, '\0') + std::string("\x28\0", 2), "an ELF file of another machine (number 40)"},
  };
  for (const auto& file : kFiles) {
    const std::string error = error_of(file.bytes);
    EXPECT_EQ(
        error.find("x.hex: firmware image: got " + file.says + ", expected the .hex or .elf of a dsPIC30F; "),
        0u)
        << error;
  }
  EXPECT_TRUE(
      wording::reads(error_of("\x36\x12"),
                     "x.hex: firmware image: got a COFF of the dsPIC, as MPLAB C30 made by default, expected "
                     "the .hex or .elf of a dsPIC30F; take the .hex that was made beside it"));
}

// --- ELF

struct Section {
  std::string name;
  unsigned type, flags, address, segment_address;
  std::string bytes;
};

void put(std::string& out, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> 8 * i);
}

// as XC16's linker writes it: a segment for each section, addresses in units of the program counter
std::string elf(const std::vector<Section>& given, unsigned machine = 118, unsigned flags = 31,
                unsigned type = 2) {
  std::vector<Section> sections{{"", 0, 0, 0, 0, ""}};
  sections.insert(sections.end(), given.begin(), given.end());
  std::string names;
  std::vector<unsigned> name_at;
  sections.push_back({".shstrtab", 3, 0, 0, 0, ""});
  for (const Section& s : sections) {
    name_at.push_back(static_cast<unsigned>(names.size()));
    names += s.name + '\0';
  }
  sections.back().bytes = names;
  const unsigned head = 52, segments = static_cast<unsigned>(given.size());
  std::string body, table, program;
  unsigned at = head + 32 * segments;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Section& s = sections[i];
    for (const std::uint64_t v : {std::uint64_t{name_at[i]}, std::uint64_t{s.type}, std::uint64_t{s.flags},
                                  std::uint64_t{s.address}, std::uint64_t{at}, std::uint64_t{s.bytes.size()},
                                  std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{4}, std::uint64_t{0}})
      put(table, v, 4);
    if (i > 0 && i <= given.size())
      for (const std::uint64_t v :
           {std::uint64_t{1}, std::uint64_t{at}, std::uint64_t{s.address}, std::uint64_t{s.segment_address},
            std::uint64_t{s.bytes.size()}, std::uint64_t{s.bytes.size()}, std::uint64_t{5}, std::uint64_t{4}})
        put(program, v, 4);
    body += s.bytes;
    at += static_cast<unsigned>(s.bytes.size());
  }
  std::string out(
      "\x7f"
      "ELF\x01\x01\x01",
      7);
  out.resize(16);
  put(out, type, 2);
  put(out, machine, 2);
  for (const std::uint64_t v :
       {std::uint64_t{1}, std::uint64_t{0x100}, std::uint64_t{head}, std::uint64_t{at}, std::uint64_t{flags}})
    put(out, v, 4);
  for (const std::uint64_t v :
       {std::uint64_t{52}, std::uint64_t{32}, std::uint64_t{segments}, std::uint64_t{40},
        std::uint64_t{sections.size()}, std::uint64_t{sections.size() - 1}})
    put(out, v, 2);
  return out + program + body + table;
}

const Section kCode{".text", 1, 6, 0x100, 0x100, std::string("\x00\x01\x04\x00\x00\x00\x00\x00", 8)};
const Section kConstants{".const", 1, 2 | 1u << 28, 0xA65E, 0x265E, std::string("AB\0\0", 4)};

TEST(ElfImage, code_and_constants_stand_where_the_program_counter_counts) {
  FirmwareFile file;
  std::string error;
  const Section data{".data", 1, 3, 0x900, 0x900, std::string(8, 'x')};
  ASSERT_TRUE(dspic::load_firmware(elf({kCode, kConstants, data}), "x.elf", file, error)) << error;
  EXPECT_EQ(file.words.size(), 3u);
  EXPECT_EQ(file.words[0x100], 0x040100u);
  EXPECT_EQ(file.words[0x102], 0u);
  EXPECT_EQ(file.words[0x265E], 0x4241u);  // seen at 0xA65E through the window
}

TEST(ElfImage, what_is_wrong_is_named) {
  const auto wrong = [](const std::string& bytes) {
    FirmwareFile file;
    std::string error;
    EXPECT_FALSE(dspic::load_elf(bytes, "x.elf", file, error));
    return error;
  };
  EXPECT_EQ(wrong(elf({kCode}, 3)), "x.elf: machine: got 3, expected 118 (dsPIC30F, 32 bits, little-endian)");
  EXPECT_EQ(wrong(elf({kCode}, 118, 5)), "x.elf: device: got number 5, expected 31 (30F6014A)");
  EXPECT_EQ(wrong(elf({kCode}, 118, 31, 1)), "x.elf: it is no linked program (an object file?)");
  EXPECT_EQ(wrong(elf({kCode, kCode})), "x.elf: two sections lie at program address 0x100");
  EXPECT_EQ(wrong(elf({})), "x.elf: there is no program in it");
  Section far = kCode;
  far.address = 0x20000;
  EXPECT_EQ(wrong(elf({far})), "x.elf: program address 0x20000 is in no memory of this chip");
  const std::string whole = elf({kCode, kConstants});
  for (std::size_t cut = 0; cut < whole.size(); cut += 7) EXPECT_NE(wrong(whole.substr(0, cut)), "") << cut;
}

// DWARF 2 as XC16 writes it: addresses of 4 bytes, in units of the program counter
std::string line_table() {
  std::string head("\x02\x01\xF6\xF5\x0A",
                   5);  // shortest instruction 2, is_stmt, base -10, range 245, first 10
  head += std::string("\x00\x01\x01\x01\x01\x00\x00\x00\x01", 9);
  head += std::string("/p\0\0main.c\0\1\0\0other.h\0\0\0\0\0", 27);
  std::string code("\x00\x05\x02\x00\x01\x00\x00", 7);     // at 0x100
  code += std::string("\x03\x06\x01", 3);                  // line 7
  code += std::string("\x02\x01\x03\x05\x01", 5);          // 1 instruction on: line 12
  code += std::string("\x04\x02\x02\x01\x03\x74\x01", 7);  // file 2, 1 on, 12 back: line 0
  code += std::string("\x02\x01\x00\x01\x01", 5);          // the end, 1 on
  std::string unit;
  put(unit, 2, 2);
  put(unit, head.size(), 4);
  unit += head + code;
  std::string all;
  put(all, unit.size(), 4);
  return all + unit;
}

TEST(CodeMap, paths_of_debug_information_are_made_whole) {
  const struct {
    const char *folder, *path, *whole;
  } rows[] = {{"/p", "main.c", "/p/main.c"},
              {"/p/build", "../main.c", "/p/main.c"},
              {"/p/build", "..\\main.c", "/p/build/..\\main.c"},
              {"/p", "./a//b/./c.c", "/p/a/b/c.c"},
              {"/p", "/q/main.c", "/q/main.c"},
              {"", "main.c", "main.c"},
              {"", "../../main.c", "../../main.c"},
              {"C:\\p", "main.c", "C:/p/main.c"},
              {"C:\\p\\build", "..\\main.c", "C:/p/main.c"},
              {"/p", "C:/robot/main.c", "C:/robot/main.c"},
              {"/p", "c:\\robot\\main.c", "c:/robot/main.c"},
              {"", "a\\b.c", "a/b.c"},
              {"/p", "\\q\\b.c", "/q/b.c"},
              {"/p", "a:b.c", "/p/a:b.c"},
              {"/p", "ab\\c.c", "/p/ab\\c.c"},
              {"x", "y\\..\\z.c", "x/y\\..\\z.c"}};
  for (const auto& row : rows) EXPECT_EQ(dspic::whole_path(row.folder, row.path), row.whole) << row.path;
}

TEST(ElfImage, lines_are_read) {
  Section code = kCode;
  code.bytes = std::string(16, '\0');
  const Section lines{".debug_line", 1, 0, 0, 0, line_table()};
  FirmwareFile file;
  std::string error;
  ASSERT_TRUE(dspic::load_firmware(elf({code, lines}), "x.elf", file, error)) << error;
  EXPECT_EQ(file.code.describe(0x100), "main.c:7");
  EXPECT_EQ(file.code.describe(0x102), "main.c:12");
  EXPECT_EQ(file.code.describe(0x104), "main.c:12");  // the compiler's own
  EXPECT_EQ(file.code.describe(0x106), "0x000106");   // beyond the end
  EXPECT_EQ(file.code.describe(0x0FE), "0x0000fe");
  ASSERT_NE(file.code.line_at(0x100), nullptr);
  EXPECT_EQ(file.code.lines().files[file.code.line_at(0x100)->file], "/p/main.c");
  int found = 0;
  EXPECT_EQ(file.code.addresses_of("main.c", 8, found), std::vector<std::uint32_t>{0x102});
  EXPECT_EQ(found, 12);
  EXPECT_TRUE(file.code.addresses_of("ain.c", 7, found).empty());
  EXPECT_TRUE(file.code.addresses_of("main.c", 13, found).empty());
  for (std::size_t cut = 0; cut < lines.bytes.size(); ++cut) {  // hostile ones
    dspic::LineTable table;
    table.add(reinterpret_cast<const unsigned char*>(lines.bytes.data()), cut);
    std::string wrong = lines.bytes;
    wrong[cut] = static_cast<char>(wrong[cut] ^ 0xFF);
    table.add(reinterpret_cast<const unsigned char*>(wrong.data()), wrong.size());
    table.sort();
    table.line_at(0x102);
  }
}

TEST(FirmwareFile, kind_is_read_from_the_content) {
  EXPECT_EQ(dspic::kind_of(good_hex()), dspic::FileKind::Hex);
  EXPECT_EQ(dspic::kind_of(elf({kCode})), dspic::FileKind::Elf);
  EXPECT_EQ(dspic::kind_of(elf({kCode}, 62)), dspic::FileKind::Other);  // a PC's
  EXPECT_EQ(dspic::kind_of(""), dspic::FileKind::Other);
}

}  // namespace
