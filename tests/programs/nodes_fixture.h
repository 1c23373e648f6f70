// SPDX-License-Identifier: MIT
// Nodes and fields of a twin that runs no programs: records in, records out. Worlds are .wbt texts, imported
// as `twinpuck import` does, or world files of ours.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/twin/world_file.h"
#include "import/import.h"
#include "programs/world/nodes.h"

namespace nodes_test {

namespace fs = std::filesystem;

// as WbFieldType numbers them
inline constexpr int kInt = 2, kColour = 7, kNode = 9;
constexpr int kList = 16;

struct FakeHost final : programs::SupervisorHost {
  std::unique_ptr<twin::Twin> its_twin;
  std::vector<std::string> said;
  std::vector<sim::PictureLabel> labels;

  twin::Twin& twin() override { return *its_twin; }
  void end_run(int status, const std::string& why) override {
    said.push_back("end " + std::to_string(status) + " " + why);
  }
  void reset(bool reload) override { said.push_back(reload ? "reload" : "reset"); }
  void restart_program(int robot) override { said.push_back("restart " + std::to_string(robot)); }
  void set_label(int, const sim::PictureLabel& label) override { labels.push_back(label); }
  void picture(const std::string& file) override { said.push_back("picture " + file); }
  void warn(int program, const std::string& text) override {
    said.push_back("warn " + std::to_string(program) + " " + text);
  }
  void note_custom_data(int robot, const std::string& text) override {
    said.push_back("custom " + std::to_string(robot) + " " + text);
  }
  void note_moved(int robot) override { said.push_back("moved " + std::to_string(robot)); }
  std::string device_name(int, int tag) override { return tag == 1 ? "emitter" : ""; }
  bool has(const std::string& part) const {
    for (const std::string& s : said)
      if (s.find(part) != std::string::npos) return true;
    return false;
  }
};

/// One record that came back.
struct Reply {
  int number = 0;
  std::vector<std::int64_t> ints;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

class NodesTest : public ::testing::Test {
 protected:
  /// A world file of ours.
  void open(const std::string& toml, const std::string& file = "t.toml") {
    const auto loaded = twin::parse_world(toml, file);
    ASSERT_TRUE(loaded.world) << loaded.report(file) << "\n" << toml;
    std::vector<std::string> problems;
    host_.its_twin = twin::Twin::open(*loaded.world, {}, problems);
    ASSERT_TRUE(host_.its_twin) << problems.front();
    nodes_ = std::make_unique<programs::Nodes>(host_);
  }

  /// A world of Webots, which lies beside what the import makes of it.
  void open_wbt(const std::string& wbt) {
    folder_ = fs::path(::testing::TempDir()) / ("twinpuck-nodes-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    std::ofstream(folder_ / "w.wbt") << wbt;
    wbt::Options options;
    options.file = "w.wbt";
    options.folder = options.out_folder = folder_.string();
    options.model = board::epuck_model();
    const wbt::Imported made = wbt::import_world(wbt, options);
    ASSERT_TRUE(made.errors.empty()) << made.errors.front().text;
    open(made.toml, (folder_ / "w.toml").string());
  }

  void TearDown() override {
    nodes_.reset();
    if (!folder_.empty()) fs::remove_all(folder_);
  }

  // --- records

  struct Words {
    std::vector<std::int64_t> ints;
    std::vector<double> list;
    std::string text;
  };

  /// Writes a record as a program does and reads it as the simulator does.
  template <typename Do>
  void speak(int number, const Words& words, Do act) {
    link_packet packet{};
    link_begin(&packet, number);
    std::size_t ints = 0;
    for (const char* m = link_row_of(number)->members; *m; ++m) {
      if (*m == 'i') link_int(&packet, words.ints.at(ints++));
      if (*m == 's') link_bytes(&packet, words.text.data(), words.text.size());
      if (*m == 'F') link_numbers(&packet, words.list.data(), words.list.size());
    }
    link_end(&packet);
    link_reader reader;
    link_record record;
    link_read(&reader, packet.bytes, packet.size);
    ASSERT_EQ(link_next(&reader, &record), 1) << reader.error;
    act(record);
    link_free(&packet);
  }

  Reply ask(int number, const Words& words, int program = 0, int robot = -1) {
    Reply reply;
    speak(number, words, [&](const link_record& question) {
      link_packet out{};
      nodes_->answer(question, program, robot, out);
      link_reader reader;
      link_record r;
      link_read(&reader, out.bytes, out.size);
      EXPECT_EQ(link_next(&reader, &r), 1);
      reply.number = r.number;
      int ints = 0, texts = 0;
      for (const char* m = link_row_of(r.number)->members; *m; ++m) {
        if (*m == 'i') reply.ints.push_back(r.ints[ints++]);
        if (*m == 's') reply.texts.emplace_back(r.texts[texts].bytes, r.texts[texts].size), ++texts;
        if (*m == 'F') reply.numbers.assign(r.lists[0].values, r.lists[0].values + r.lists[0].count);
      }
      EXPECT_EQ(link_next(&reader, &r), 0) << "one record";
      link_free(&out);
    });
    return reply;
  }

  void command(int number, const Words& words, int program = 0) {
    speak(number, words, [&](const link_record& r) { nodes_->carry_out(r, program, -1); });
  }

  // --- what programs do with them

  /// The number of a node; 0: NOTHING.
  int def(const std::string& name) {
    const Reply r = ask(LINK_FIND_NODE, {{2, 0}, {}, name});
    return r.number == LINK_NODE ? static_cast<int>(r.ints[0]) : 0;
  }
  int root() { return static_cast<int>(ask(LINK_FIND_NODE, {{0, 0}, {}, ""}).ints[0]); }
  int field(int node, const std::string& name, int type = 0) {
    const Reply r = ask(LINK_FIND_FIELD, {{node, -1}, {}, name});
    if (r.number != LINK_FIELD) return 0;
    EXPECT_EQ(r.ints[1], type ? type : r.ints[1]) << name;
    return static_cast<int>(r.ints[0]);
  }
  Reply get(int node, const std::string& name, int index = -1) {
    return ask(LINK_GET, {{field(node, name), index}, {}, ""});
  }
  int inner(int node, const std::string& name, int index = 0) {
    const Reply r = get(node, name, index);
    return r.number == LINK_VALUE ? static_cast<int>(r.ints[1]) : 0;
  }
  void set(int node, const std::string& name, const std::vector<double>& numbers,
           const std::string& text = "") {
    command(LINK_SET, {{field(node, name), 0, 0}, numbers, text});
  }
  std::vector<double> position(int node) { return ask(LINK_ASK_NODE, {{node, 0}, {}, ""}).numbers; }

  void expect(const std::vector<double>& got, const std::vector<double>& wanted, double by = 1e-6) {
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], by) << i;
  }

  const sim::Simulation& simulation() { return host_.its_twin->simulation(); }
  const sim::WorldDesc& world() { return host_.its_twin->world(); }
  void run(double seconds) {
    host_.its_twin->simulation().run_until(host_.its_twin->simulation().now() + sim::from_seconds(seconds));
  }

  FakeHost host_;
  std::unique_ptr<programs::Nodes> nodes_;
  fs::path folder_;
};

inline const std::string kHead = "#VRML_SIM R2023b utf8\nWorldInfo { title \"t\" basicTimeStep 16 }\n";
inline const std::string kOldHead = "#VRML_SIM V6.0 utf8\nWorldInfo { }\n";

}  // namespace nodes_test
