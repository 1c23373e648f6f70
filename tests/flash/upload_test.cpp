// SPDX-License-Identifier: MIT
// twinpuck flash against a simulated robot that runs hal_dspic/bootloader: what was said to be good drives,
// on any line.
#include "flash/upload.h"

#include <cstdlib>
#include <deque>
#include <random>
#include <sstream>

#include "compiler/build/build.h"
#include "dspic30/memory/program_memory.h"
#include "tests/chip/chip_fixture.h"
#include "tests/support/wording.h"

namespace {

using firmware_test::Robot;
using State = flash::Upload::State;

// says its name and steps both motors, 500 steps/s; 12 rows of other words lie about in flash,
// as a larger program's
std::string program(char name) {
  std::string text = R"(
    config __FOSC, 0xFFE6
__reset: mov #0x800, w15
    mov #7, w0
    mov w0, U1BRG
    bset U1MODE, #15
    bset U1STA, #10
    mov.b #')" + std::string(1, name) +
                     R"(', w2
    mov w2, U1TXREG
    mov #0xFF00, w0
    mov w0, TRISD
step: mov #0xAA, w3
    rcall put
    mov #0x69, w3
    rcall put
    mov #0x55, w3
    rcall put
    mov #0x96, w3
    rcall put
    bra step
put: mov w3, LATD
    mov #5898, w0
1:  dec w0, w0
    nop
    nop
    bra nz, 1b
    return
)";
  text += "    .section .more, code, address(0x10000)\n";
  for (int i = 0; i < 12 * 32; ++i)
    text += "    .pword " + std::to_string(i * 40503 % 0xFFFFFF + name) + "\n";
  return text;
}

dspic::FirmwareFile assembled(const std::string& text) {
  const dspic::assembly::Image image = dspic::assembly::assemble(text, "test.s");
  EXPECT_TRUE(image.is_whole()) << image.report();
  dspic::FirmwareFile file;
  file.words = image.program;
  return file;
}

class UploadTest : public chip_test::ChipTest {
 protected:
  // the robot's line in virtual time. Bytes of both directions are lost or garbled
  struct Line : flash::SerialLine {
    Line(UploadTest& test, Robot& robot, double bad_share, unsigned seed)
        : test(test), robot(robot), bad_share(bad_share), random(seed) {}

    // -1: lost
    int through(std::uint8_t byte) {
      if (std::uniform_real_distribution<>()(random) >= bad_share) return byte;
      ++spoiled;
      return random() % 2 ? -1 : byte ^ static_cast<int>(1 + random() % 255);
    }
    bool write(const std::vector<std::uint8_t>& bytes) override {
      if (cut_after < static_cast<int>(bytes.size())) {
        cut_after = 0;
        return false;
      }
      cut_after -= static_cast<int>(bytes.size());
      std::string out;
      for (const std::uint8_t b : bytes)
        if (const int byte = through(b); byte >= 0) out += static_cast<char>(byte);
      robot.uart(1).send(out);
      return true;
    }
    std::optional<std::uint8_t> read(double seconds) override {
      const double end = now_s() + seconds;
      while (true) {
        const std::string text = robot.uart(1).text();
        while (taken < text.size())
          if (const int byte = through(static_cast<std::uint8_t>(text[taken++])); byte >= 0)
            return static_cast<std::uint8_t>(byte);
        if (now_s() >= end) return std::nullopt;
        test.run_for(std::min(0.002, std::max(end - now_s(), 0.0001)));
      }
    }
    double now_s() const override { return test.now_s(); }

    UploadTest& test;
    Robot& robot;
    double bad_share;
    std::mt19937 random;
    std::size_t taken = robot.uart(1).text().size();
    int spoiled = 0, cut_after = 1 << 30;  // bytes
  };

  UploadTest() {
    std::ifstream in(std::string(TWINPUCK_SOURCE_DIR) + "/hal_dspic/bootloader/bootloader.s");
    std::stringstream text;
    text << in.rdbuf();
    bootloader_ = text.str();
  }
  flash::UploadPlan plan(char name) {
    flash::UploadPlan result;
    std::string error;
    EXPECT_TRUE(flash::plan_upload(assembled(program(name)), "p.hex", result, error)) << error;
    return result;
  }
  flash::Upload upload(Line& line, char name, flash::UploadSettings settings = {}) {
    return flash::upload(line, plan(name), settings, [](const char*, int, int) {});
  }
  std::uint32_t flash(std::uint32_t address) { return runner().program().read(address); }
  bool holds(const flash::UploadPlan& plan) {
    for (const auto& [address, row] : plan.rows)
      for (std::uint32_t i = 0; i < 32; ++i) {
        const std::uint32_t at = address + 2 * i;
        const std::uint32_t wanted = at >= flash::kBootloaderUser && at < flash::kBootloaderEntry
                                         ? plan.way_in[(at - flash::kBootloaderUser) / 2]
                                         : row[i];
        if (flash(at) != wanted) return false;
      }
    return true;
  }
  std::string bootloader_;
};

TEST_F(UploadTest, a_program_is_written_read_back_and_drives) {
  Robot& robot = add_robot(hex(bootloader_));
  Line line(*this, robot, 0, 1);
  const flash::Upload result = upload(line, 'A');
  EXPECT_EQ(result.state, State::Verified) << result.why;
  EXPECT_EQ(result.repeated, 0);
  EXPECT_TRUE(holds(plan('A')));
  const std::size_t before = robot.uart(1).text().size();
  run_for(0.5);
  EXPECT_TRUE(robot.led(6)) << "the end of an upload lights LED 6";
  run_for(3);
  EXPECT_EQ(robot.uart(1).text().substr(before), "A");
  EXPECT_GT(robot.distance_m(), 0.05);
  expect_no_traps();
}

// the old program is whole or gone: a line that dies in the middle leaves a robot that waits
// for the next upload
TEST_F(UploadTest, a_line_that_dies_leaves_no_half_program) {
  Robot& robot = add_robot(hex(bootloader_));
  Line first(*this, robot, 0, 1);
  ASSERT_EQ(upload(first, 'A').state, State::Verified);
  run_for(0.1);  // its last frame arrives
  for (const int bytes : {150, 700, 1400, 2500, 3100}) {
    runner().restart();
    Line line(*this, robot, 0, 2);
    line.cut_after = bytes;
    const flash::Upload result = upload(line, 'B');
    EXPECT_TRUE(result.state == State::Refused || result.state == State::Unknown) << bytes;
    EXPECT_EQ(result.why, "the serial line is gone");
    runner().restart();
    const std::size_t before = robot.uart(1).text().size();
    run_for(3);
    const std::string said = robot.uart(1).text().substr(before);
    // cut off before the first frame was through, the robot has its old program, all of it
    if (bytes > 300 || !said.empty()) {
      EXPECT_EQ(said, bytes > 300 ? "" : "A") << "after " << bytes << " bytes";
    }
    EXPECT_EQ(said == "A", holds(plan('A'))) << "after " << bytes << " bytes";
  }
  runner().restart();
  Line again(*this, robot, 0, 3);
  EXPECT_EQ(upload(again, 'C').state, State::Verified);
  EXPECT_TRUE(holds(plan('C')));
}

// 1 % of all bytes of both directions: what is said to be verified is so. UPLOADS=100 tries as many
TEST_F(UploadTest, bad_lines_are_repeated_until_all_is_right) {
  Robot& robot = add_robot(hex(bootloader_));
  int verified = 0, spoiled = 0;
  const char* more = std::getenv("UPLOADS");
  const int uploads = more ? std::atoi(more) : 3;
  for (int seed = 1; seed <= uploads; ++seed) {
    runner().restart();
    Line line(*this, robot, 0.01, static_cast<unsigned>(seed));
    const char name = static_cast<char>('A' + seed % 26);
    const flash::Upload result = upload(line, name);
    spoiled += line.spoiled;
    verified += result.state == State::Verified;
    if (result.state == State::Verified) {
      EXPECT_TRUE(holds(plan(name))) << "seed " << seed;
      EXPECT_GT(result.repeated, 0);
    } else {
      EXPECT_NE(result.state, State::Written);
      EXPECT_NE(result.why, "");
      runner().restart();
    }
    // whatever runs now is whole
    const std::size_t before = robot.uart(1).text().size();
    run_for(5);
    const std::string said = robot.uart(1).text().substr(before);
    if (result.state == State::Verified) {
      EXPECT_EQ(said, std::string(1, name));
    }
    if (!said.empty()) {
      EXPECT_TRUE(holds(plan(said[0]))) << "seed " << seed << ": " << said << " runs";
    }
  }
  std::cout << verified << " of " << uploads << " uploads verified, the others refused\n";
  EXPECT_GE(4 * verified, 3 * uploads);
  EXPECT_GT(spoiled, 10 * uploads);
}

TEST_F(UploadTest, a_line_that_is_too_bad_is_refused_and_the_robot_waits) {
  Robot& robot = add_robot(hex(bootloader_));
  Line line(*this, robot, 0.2, 1);
  flash::UploadSettings settings;
  settings.tries = 3;
  const flash::Upload result = upload(line, 'A', settings);
  EXPECT_NE(result.state, State::Verified);
  EXPECT_NE(result.state, State::Written);
  EXPECT_NE(result.why, "");
  const std::size_t before = robot.uart(1).text().size();
  run_for(4);
  EXPECT_EQ(robot.uart(1).text().substr(before), "");
}

TEST_F(UploadTest, the_bootloader_keeps_its_own_rows) {
  Robot& robot = add_robot(hex(bootloader_));
  run_for(0.01);
  const std::uint32_t entry = flash(flash::kBootloaderEntry), extension = flash(0x17EC0);
  for (const std::uint32_t row : {0x17EC0u, 0x17F40u, 0x17F80u, 0x17FC0u}) {
    runner().restart();
    flash::UploadPlan p = plan('A');
    p.rows[row].fill(0x123456);
    Line line(*this, robot, 0, 1);
    flash::UploadSettings settings;
    settings.tries = 5;
    const flash::Upload result = flash::upload(line, p, settings, [](const char*, int, int) {});
    EXPECT_EQ(result.state, State::Refused);
    EXPECT_TRUE(wording::reads(
        result.why,
        "row … was not taken in 5 tries, 5 of them answered 'N'; the bootloader protects this row"));
  }
  EXPECT_EQ(flash(flash::kBootloaderEntry), entry);
  EXPECT_EQ(flash(0x17EC0), extension);
}

// --- people's uploaders: models of two, which know flash by halves of 64 KB of the .hex

/// What such an uploader makes of a .hex: octets by twice the address, a half each.
struct OfPeople {
  std::map<std::uint32_t, std::vector<std::uint8_t>> halves;
  bool has_crashed = false;

  /// `drops`: data before the first extended-address record are left out; else there is no place for them.
  static OfPeople read(const std::string& hex, bool drops) {
    OfPeople made;
    std::vector<std::uint8_t>* half = nullptr;
    bool is_beyond = false;  // configuration words
    std::istringstream lines(hex);
    for (std::string line; std::getline(lines, line);) {
      const auto byte = [&](std::size_t i) { return std::stoul(line.substr(1 + 2 * i, 2), nullptr, 16); };
      const std::size_t length = byte(0), address = byte(1) << 8 | byte(2), type = byte(3);
      if (type == 4) {
        const std::uint32_t upper = static_cast<std::uint32_t>(byte(4) << 8 | byte(5));
        is_beyond = upper >= 4;
        half = is_beyond ? nullptr : &made.halves[upper << 16];
      } else if (type == 0 && half) {
        half->resize(std::max(half->size(), address + length), 0xFF);
        for (std::size_t i = 0; i < length; ++i)
          (*half)[address + i] = static_cast<std::uint8_t>(byte(4 + i));
      } else if (type == 0 && !is_beyond && !drops) {
        made.has_crashed = true;
        return made;
      }
    }
    return made;
  }

  /// The way into the bootloader at 0, the way into the program where the bootloader looks for it.
  void lead_in() {
    constexpr std::uint32_t kUser = 2 * 0x17F00;
    std::vector<std::uint8_t>& first = halves[0];
    first.resize(std::max<std::size_t>(first.size(), 8), 0xFF);
    std::vector<std::uint8_t>& user = halves[kUser];
    user.assign(120, 0xFF);
    const std::uint8_t way_in[] = {first[0], first[1], 0x04, 0, first[4], 0, 0, 0};
    std::copy(std::begin(way_in), std::end(way_in), user.begin() + 112);
    const std::uint8_t bootloader[] = {0x40, 0x7F, 0x04, 0, 0x01, 0, 0, 0};
    std::copy(std::begin(bootloader), std::end(bootloader), first.begin());
  }

  /// False: a row was not taken.
  bool send(flash::SerialLine& line) const {
    bool is_there = false;
    for (int i = 0; i < 100 && !is_there; ++i) {
      line.write({0xC1});
      is_there = line.read(0.05) == std::optional<std::uint8_t>('q') &&
                 line.read(0.05) == std::optional<std::uint8_t>('K');
    }
    for (const auto& [begin, octets] : halves)
      for (std::size_t at = 0; is_there && at < octets.size(); at += 128) {
        const std::size_t row = (begin + at) / 2;
        std::vector<std::uint8_t> frame = {static_cast<std::uint8_t>(row),
                                           static_cast<std::uint8_t>(row >> 8),
                                           static_cast<std::uint8_t>(row >> 16), 0x60};
        for (std::size_t i = 0; i < 128; ++i)
          if (i % 4 < 3) frame.push_back(at + i < octets.size() ? octets[at + i] : 0xFF);
        unsigned sum = 0;
        for (const std::uint8_t b : frame) sum += b;
        frame.push_back(static_cast<std::uint8_t>(-sum));
        line.write(frame);
        if (line.read(0.5) != std::optional<std::uint8_t>('K')) return false;
      }
    line.write({0x95, 0, 0, 0xFF});
    return is_there;
  }
};

/// What `twinpuck build` writes for the robot: a C program that says its name, with the
/// library's bank of sounds.
std::string linked_hex(char name) {
  const std::filesystem::path folder =
      std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests/flash-linked" / std::string(1, name);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "main.c") << "#include <motor_led/e_init_port.h>\n#include <uart/e_uart_char.h>\n"
                                      "#include <codec/e_sound.h>\n"
                                      "int main(void) { e_init_port(); e_init_uart1(); e_send_uart1_char(\"" +
                                          std::string(1, name) +
                                          "\", 1); e_init_sound(); e_play_sound(0, 2112); while (1); }\n";
  cc::BuildOptions options;
  options.source_dir = folder;
  options.output = folder / "x.elf";
  options.cache_dir = folder / "cache";
  const cc::BuildResult built = cc::build_image(options);
  EXPECT_TRUE(built.ok);
  std::ifstream in(folder / "x.hex", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// one drops what stands before the first extended-address record, the other fails there
TEST_F(UploadTest, uploaders_that_people_have_write_our_hex_whole) {
  Robot& robot = add_robot(hex(bootloader_));
  for (const bool is_linked : {false, true})
    for (const bool drops : {true, false}) {
      const char name = static_cast<char>((is_linked ? 'C' : 'A') + !drops);
      SCOPED_TRACE(name);
      const std::string text = is_linked ? linked_hex(name) : dspic::to_hex(assembled(program(name)));
      dspic::FirmwareFile file;
      std::string error;
      ASSERT_TRUE(dspic::load_hex(text, "x.hex", file, error)) << error;
      OfPeople uploader = OfPeople::read(text, drops);
      ASSERT_FALSE(uploader.has_crashed);
      uploader.lead_in();
      Line line(*this, robot, 0, 1);
      ASSERT_TRUE(uploader.send(line));
      run_for(0.1);
      int wrong = 0, words = 0;
      for (const auto& [address, word] : file.words)  // but for the way in
        if (address >= 4 && address < dspic::kFlashEnd) {
          wrong += flash(address) != word;
          ++words;
        }
      EXPECT_EQ(wrong, 0);
      EXPECT_GT(words, is_linked ? 19000 : 100);
      const std::size_t before = robot.uart(1).text().size();
      run_for(3);
      EXPECT_EQ(robot.uart(1).text().substr(before), std::string(1, name));
      // they need that record: without it half of the program is gone, or all
      const std::string cut = text.substr(text.find('\n') + 1);
      EXPECT_TRUE(drops ? OfPeople::read(cut, drops).halves[0].empty()
                        : OfPeople::read(cut, drops).has_crashed);
      runner().restart();
    }
}

// no answer, or a program that talks
TEST_F(UploadTest, silence_is_told) {
  Robot& robot = add_robot(hex("__reset: bra __reset\n"));
  Line line(*this, robot, 0, 1);
  flash::UploadSettings settings;
  settings.wait_s = 2;
  const flash::Upload result = upload(line, 'A', settings);
  EXPECT_EQ(result.state, State::Untouched);
  EXPECT_EQ(result.why, "got no answer for 2 s, expected a bootloader's answer (0x71 0x4B)");
}

// --- what goes into the robot, and what does not

std::string problem_of(const dspic::FirmwareFile& file) {
  flash::UploadPlan plan;
  std::string error;
  EXPECT_FALSE(flash::plan_upload(file, "p.hex", plan, error));
  return error;
}

TEST(UploadPlan, the_way_in_is_the_programs_and_the_reset_vector_the_bootloaders) {
  dspic::FirmwareFile file;
  file.words = {{0, 0x040200},     {2, 0}, {0x200, 0x37FFFF}, {0x17F10, 0x123456}, {0x7FF000, 0xFF1234},
                {0xF80000, 0xFFE6}};
  flash::UploadPlan plan;
  std::string error;
  ASSERT_TRUE(flash::plan_upload(file, "p.hex", plan, error)) << error;
  ASSERT_EQ(plan.rows.size(), 3u);
  EXPECT_EQ(plan.rows[0][0], 0x047F40u);
  EXPECT_EQ(plan.rows[0][1], 0x000001u);
  EXPECT_EQ(plan.rows[0][2], 0xFFFFFFu);
  EXPECT_EQ(plan.rows[0x200][0], 0x37FFFFu);
  EXPECT_EQ(plan.rows[0x17F00][0], 0u) << "a lost byte does not make it the end";
  EXPECT_EQ(plan.rows[0x17F00][8], 0x123456u) << "what the program has there stays";
  EXPECT_EQ(plan.rows[0x17F00][28], 0xEB0000u);
  EXPECT_EQ(plan.way_in, (std::array<std::uint32_t, 4>{0x040200, 0, 0xFFFFFF, 0xFFFFFF}));
  EXPECT_EQ(plan.notes.size(), 2u);
}

TEST(UploadPlan, a_file_with_a_bootloader_in_it_brings_its_program_only) {
  dspic::FirmwareFile file;
  file.words = {{0, 0x047F40},       {2, 1},       {0x200, 0x37FFFF},
                {0x17F38, 0x040200}, {0x17F3A, 0}, {0x17F40, 0x123456}};
  flash::UploadPlan plan;
  std::string error;
  ASSERT_TRUE(flash::plan_upload(file, "p.hex", plan, error)) << error;
  EXPECT_EQ(plan.way_in[0], 0x040200u);
  EXPECT_EQ(plan.rows.count(0x17F40), 0u);
  file.words.erase(0x17F38);
  EXPECT_EQ(problem_of(file),
            "p.hex: address 0x017f38: got the word 0xffffff, expected a goto to the program; is the file a "
            "bootloader only?");
}

TEST(UploadPlan, what_cannot_be_written_is_refused) {
  dspic::FirmwareFile file;
  EXPECT_EQ(problem_of(file),
            "p.hex: address 0x000000: got the word 0xffffff, expected a goto to the program");
  file.words = {{0, 0x040200}, {2, 0}, {0x17F3A, 1}};
  EXPECT_EQ(problem_of(file),
            "p.hex: address 0x017f3a: the program reaches into the bootloader's words, 0x017f38 to 0x017ffe; "
            "make it smaller");
}

// --- a bootloader of a few lines, whose answers a test spoils

struct FakeBootloader : flash::SerialLine {
  bool write(const std::vector<std::uint8_t>& bytes) override {
    for (const std::uint8_t byte : bytes) {
      if (resets_on > 0) {  // its program runs, until it has read so many lines
        heard += static_cast<char>(byte);
        if (byte == '\r') asked_s.push_back(now), --resets_on;
        continue;
      }
      if (frame.empty() && byte == 0xC1) {
        answers.insert(answers.end(), {'q', 'K'});
        continue;
      }
      frame.push_back(byte);
      if (frame.size() == 4 && frame[0] == 100) ended = true, frame.clear();
      if (frame.size() == 101) take();
    }
    return true;
  }
  void take() {
    unsigned sum = 0;
    for (const std::uint8_t byte : frame) sum += byte;
    const std::uint32_t address = frame[0] | frame[1] << 8 | frame[2] << 16;
    if (frame[3] == 0x60 && (sum & 0xFF) == 0) {
      ++writes[address];
      rows[address].assign(frame.begin() + 4, frame.end() - 1);
      answers.push_back('K');
    } else if (frame[3] == 0xFE && (sum & 0xFF) == 1 && can_read) {
      ++reads[address];
      std::vector<std::uint8_t> row = rows[address];
      if (spoils[address] > 0 && spoils[address]--) ++row[5], --row[6];  // which adds up all the same
      unsigned total = 0;
      for (const std::uint8_t byte : row) total += byte;
      answers.push_back('R');
      answers.insert(answers.end(), row.begin(), row.end());
      answers.push_back(static_cast<std::uint8_t>(0 - total));
    } else {
      answers.push_back('N');
    }
    frame.clear();
  }
  std::optional<std::uint8_t> read(double seconds) override {
    if (answers.empty()) {
      now += seconds;
      return std::nullopt;
    }
    const std::uint8_t byte = answers.front();
    answers.pop_front();
    now += 1e-4;
    return byte;
  }
  double now_s() const override { return now; }

  bool can_read = true, ended = false;
  int resets_on = 0;
  std::string heard;
  std::vector<double> asked_s;
  double now = 0;
  std::vector<std::uint8_t> frame;
  std::deque<std::uint8_t> answers;
  std::map<std::uint32_t, std::vector<std::uint8_t>> rows;
  std::map<std::uint32_t, int> writes, reads, spoils;
};

TEST(UploadRows, one_answer_that_is_wrong_is_asked_for_again_and_two_are_believed) {
  dspic::FirmwareFile file;
  file.words = {{0, 0x040200}, {2, 0}, {0x200, 0x37FFFF}, {0x240, 0x123456}};
  flash::UploadPlan plan;
  std::string error;
  ASSERT_TRUE(flash::plan_upload(file, "p.hex", plan, error)) << error;
  for (const int spoilt : {0, 1, 2}) {
    FakeBootloader robot;
    robot.spoils[0x200] = spoilt;
    std::string told;
    const flash::Upload result = flash::upload(robot, plan, {}, [&](const char* phase, int done, int total) {
      if (done == total) told += std::string(phase) + " " + std::to_string(total) + " ";
    });
    EXPECT_EQ(result.state, State::Verified) << result.why;
    EXPECT_EQ(result.repeated, spoilt == 2) << spoilt;
    EXPECT_EQ(robot.writes[0x200], spoilt == 2 ? 2 : 1) << spoilt;
    EXPECT_EQ(robot.reads[0x200], spoilt == 0 ? 1 : spoilt == 1 ? 2 : 3) << spoilt;
    EXPECT_EQ(robot.writes[0x240], 1);
    EXPECT_EQ(told, spoilt == 2 ? "written 4 verified 4 verified 4 " : "written 4 verified 4 ");
    EXPECT_TRUE(robot.ended) << "the program is begun";
    // the way in is the last that is written, at the end of the bootloader's row: goto 0x200
    const auto& row = robot.rows[flash::kBootloaderRow];
    EXPECT_EQ(std::vector<int>(row.begin() + 84, row.begin() + 90), (std::vector<int>{0, 2, 4, 0, 0, 0}));
  }
  FakeBootloader deaf;
  deaf.can_read = false;
  EXPECT_EQ(flash::upload(deaf, plan, {}, [](const char*, int, int) {}).state, State::Written);
}

// a program that begins the bootloader when it is told to: every 2 s, in case the line lost it
TEST(UploadRows, a_program_is_told_to_reset_until_its_bootloader_answers) {
  FakeBootloader robot;
  robot.resets_on = 2;
  dspic::FirmwareFile file;
  file.words = {{0, 0x040200}, {2, 0}, {0x200, 0x37FFFF}};
  flash::UploadPlan plan;
  std::string error;
  ASSERT_TRUE(flash::plan_upload(file, "p.hex", plan, error)) << error;
  flash::UploadSettings settings;
  settings.reset_text = "R\r";
  const flash::Upload result = flash::upload(robot, plan, settings, [](const char*, int, int) {});
  EXPECT_EQ(result.state, State::Verified) << result.why;
  EXPECT_EQ(robot.heard.substr(0, 3), "R\r\xC1");
  EXPECT_EQ(robot.heard.substr(robot.heard.size() - 2), "R\r");
  ASSERT_EQ(robot.asked_s.size(), 2u);
  EXPECT_EQ(robot.asked_s[0], 0);
  EXPECT_NEAR(robot.asked_s[1], 2, 0.2);
}

}  // namespace
