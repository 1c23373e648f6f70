// SPDX-License-Identifier: MIT
// What people typed is never lost: files that others write meanwhile, line ends,
// encodings, links, recordings.
#include <sys/stat.h>

#include <thread>

#include "hal_sim/inputs/recording.h"
#include "hal_sim/twin/world_file.h"
#include "programs/team/team.h"
#include "tests/viewer/driven_world.h"
#include "viewer/document.h"
#include "viewer/text_file.h"

namespace {

using namespace viewer_test;
namespace fs = std::filesystem;

class LostWork : public DrivenWorld {
 protected:
  static Json source(Page& page) {
    return page.good({{"do", "source"}, {"program", "drive"}, {"file", "main.c"}});
  }
  static Json write_source(Page& page, const std::string& text, const Json& base, bool overwrite = false) {
    return page.ask({{"do", "write_source"},
                     {"program", "drive"},
                     {"file", "main.c"},
                     {"text", text},
                     {"base", base},
                     {"overwrite", overwrite}});
  }
};

// --- lines and encodings

struct Kept {
  const char* name;
  std::string bytes, shown, typed, written;
};

class TextFiles : public ::testing::TestWithParam<Kept> {};

TEST_P(TextFiles, keep_what_nobody_changed) {
  const Kept& k = GetParam();
  EXPECT_EQ(viewer::plain_text(k.bytes).text, k.shown);
  EXPECT_EQ(viewer::bytes_like(k.bytes, k.shown), k.bytes) << "saved as it was read";
  EXPECT_EQ(viewer::bytes_like(k.bytes, k.typed), k.written);
}

INSTANTIATE_TEST_SUITE_P(
    Of, TextFiles,
    ::testing::Values(
        Kept{"plain", "a\nb\n", "a\nb\n", "a\nx\nb\n", "a\nx\nb\n"},
        Kept{"windows", "a\r\nb\r\n", "a\nb\n", "a\nx\nb\n", "a\r\nx\r\nb\r\n"},
        Kept{"old_mac", "a\rb\r", "a\nb\n", "b\n", "b\r"},
        Kept{"mixed", "a\r\nb\nc\r\nd", "a\nb\nc\nd", "a\nb\nc\nnew\nd", "a\r\nb\nc\r\nnew\r\nd"},
        Kept{"marked", "\xEF\xBB\xBFint x;\n", "int x;\n", "int y;\n", "\xEF\xBB\xBFint y;\n"},
        Kept{"latin", "// vit\xE9sse\n", "// vit\xC3\xA9sse\n", "// vit\xC3\xA9sse \xC3\xA0\n",
             "// vit\xE9sse \xE0\n"},
        Kept{"unicode", "// \xE2\x86\x92\n", "// \xE2\x86\x92\n", "// \xE2\x86\x90\n", "// \xE2\x86\x90\n"},
        Kept{"no_end", "a", "a", "a\nb", "a\nb"}, Kept{"empty", "", "", "a\n", "a\n"},
        Kept{"nul", std::string("a\0b\n", 4), std::string("a\0b\n", 4), "c\n", "c\n"}),
    [](const auto& info) { return info.param.name; });

TEST(TextFilesOf, latin_refuse_what_they_cannot_hold) {
  EXPECT_EQ(viewer::bytes_like("\xE9", "\xC3\xBF"), "\xFF");
  try {
    viewer::bytes_like("\xE9\n", "\xE2\x86\x92 there\n");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(),
                 "text: got '\xE2\x86\x92', expected characters of Latin-1, as the file is written in");
  }
}

// --- sources

TEST_F(LostWork, a_source_is_written_only_over_what_was_read) {
  Page page(open("world.toml"));
  const Json read_ = source(page);
  EXPECT_EQ(read_.at("writable"), true);
  EXPECT_EQ(read_.at("encoding"), "utf-8");
  // without having read it, nobody writes it
  EXPECT_TRUE(write_source(page, "int help;", "").contains("conflict"));
  write("drive/main.c", "// another editor\n");
  const Json refused = write_source(page, "// mine\n", read_.at("base"));
  EXPECT_EQ(refused.at("conflict").at("text"), "// another editor\n") << refused;
  EXPECT_EQ(read("drive/main.c"), "// another editor\n");
  const Json told = page.event("disk");
  EXPECT_EQ(told.at("base"), refused.at("conflict").at("base"));
  // over what is there now, or over anything
  EXPECT_TRUE(write_source(page, "// mine\n", told.at("base")).contains("ok"));
  EXPECT_EQ(read("drive/main.c"), "// mine\n");
  EXPECT_TRUE(write_source(page, "// at last\n", "", true).contains("ok"));
  EXPECT_EQ(read("drive/main.c"), "// at last\n");
}

TEST_F(LostWork, a_source_that_is_gone_is_told_and_can_be_written_again) {
  Page page(open("world.toml"));
  const Json base = source(page).at("base");
  fs::remove(folder_ / "drive/main.c");
  EXPECT_TRUE(page.event("disk").at("base").is_null());
  EXPECT_TRUE(write_source(page, "// x\n", base).at("conflict").at("text").is_null());
  EXPECT_TRUE(write_source(page, "// x\n", base, true).contains("ok"));
  EXPECT_EQ(read("drive/main.c"), "// x\n");
}

TEST_F(LostWork, protected_files_stay_as_they_are) {
  ::chmod(path("drive/main.c").c_str(), 0444);
  ::chmod(path("world.toml").c_str(), 0444);
  Page page(open("world.toml"));
  const Json before = source(page);
  EXPECT_EQ(before.at("writable"), false);
  EXPECT_EQ(write_source(page, "// mine\n", before.at("base")).value("readonly", false), true);
  EXPECT_EQ(write_source(page, "// mine\n", before.at("base"), true).value("readonly", false), true);
  const Json world = page.event("hello").at("world");
  page.good(
      {{"do", "edit"}, {"op", "set"}, {"thing", thing(world, "wall")}, {"values", {{"position", {0.5, 0}}}}});
  EXPECT_EQ(page.ask({{"do", "save"}}).value("readonly", false), true);
  EXPECT_EQ(read("world.toml"), kWorld);
  EXPECT_EQ(read("drive/main.c"), kDrive);
}

// --- the world file

TEST_F(LostWork, a_world_is_saved_only_over_what_was_read) {
  Page page(open("world.toml"));
  const Json world = page.event("hello").at("world");
  const auto drag = [&](double x) {
    page.good(
        {{"do", "edit"}, {"op", "set"}, {"thing", thing(world, "wall")}, {"values", {{"position", {x, 0}}}}});
  };
  drag(0.5);
  const std::string theirs = std::string(kWorld) + "# another editor\n";
  write("world.toml", theirs);
  EXPECT_EQ(page.event("disk").at("file"), "world.toml");
  const Json refused = page.ask({{"do", "save"}});
  EXPECT_EQ(refused.at("conflict").at("text"), theirs);
  EXPECT_EQ(read("world.toml"), theirs);
  // reloaded, which can be undone
  page.good({{"do", "reload"}});
  page.event("world", [&](const Json& e) { return e.at("world").at("text") == theirs; });
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("saved"), true);
  page.good({{"do", "undo"}});
  drag(0.6);
  page.good({{"do", "save"}});
  EXPECT_NE(read("world.toml").find("0.60"), std::string::npos);
  write("world.toml", theirs);
  drag(0.7);
  page.good({{"do", "save"}, {"overwrite", true}});
  EXPECT_NE(read("world.toml").find("0.70"), std::string::npos);
}

TEST_F(LostWork, a_world_keeps_its_line_ends_its_mark_and_its_numbers) {
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : std::string(kWorld)) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  windows.replace(windows.find("[0.80, 0.00]"), 12, "[+0.80, 0.00]");
  write("world.toml", windows);
  Page page(open("world.toml"));
  const Json world = page.event("hello").at("world");
  EXPECT_EQ(world.at("text").get<std::string>().find('\r'), std::string::npos);
  const Json edit{{"do", "edit"},
                  {"op", "set"},
                  {"thing", thing(world, "wall")},
                  {"values", {{"position", {0.8, 0.25}}}}};
  page.good(edit);
  page.good({{"do", "save"}});
  windows.replace(windows.find("0.00]"), 5, "0.25]");
  EXPECT_EQ(read("world.toml"), windows);
  // a number that was written with its sign has one again
  Json again = edit;
  again["values"]["position"] = {0.3, 0.25};
  page.good(again);
  page.good({{"do", "save"}});
  EXPECT_NE(read("world.toml").find("[+0.30, 0.25]"), std::string::npos) << read("world.toml");
}

TEST_F(LostWork, copies_have_the_comments_too) {
  Page page(open("world.toml"));
  const Json world = page.event("hello").at("world");
  page.good(
      {{"do", "edit"}, {"op", "copy"}, {"thing", thing(world, "wall")}, {"values", {{"name", "second"}}}});
  const Json after =
      page.event("world", [](const Json& e) { return e.at("world").at("things").size() == 2; });
  const std::string text = after.at("world").at("text");
  EXPECT_NE(text.find("[[box]] # the wall"), text.rfind("[[box]] # the wall"));
}

TEST_F(LostWork, text_that_was_typed_on_another_text_is_not_applied) {
  Page page(open("world.toml"));
  const Json world = page.event("hello").at("world");
  const std::string typed = world.at("text").get<std::string>() + "# typed\n";
  page.good(
      {{"do", "edit"}, {"op", "set"}, {"thing", thing(world, "wall")}, {"values", {{"position", {0.5, 0}}}}});
  const Json refused =
      page.ask({{"do", "edit"}, {"op", "text"}, {"text", typed}, {"base", world.at("base")}});
  ASSERT_TRUE(refused.contains("conflict")) << refused;
  EXPECT_NE(refused.at("conflict").at("text").get<std::string>().find("0.50"), std::string::npos);
  EXPECT_TRUE(
      page.ask({{"do", "edit"}, {"op", "text"}, {"text", typed}, {"base", refused.at("conflict").at("base")}})
          .contains("ok"));
}

TEST_F(LostWork, many_edits_are_one_or_none) {
  Page page(open("world.toml"));
  const Json world = page.event("hello").at("world");
  const int wall = thing(world, "wall");
  const Json add{
      {"op", "add"}, {"path", "box"}, {"values", {{"position", {0, 0.3}}, {"size", {0.1, 0.1, 0.1}}}}};
  EXPECT_EQ(page.refusal({{"do", "edit"}, {"edits", {add, {{"op", "remove"}, {"thing", 12345}}}}}),
            "thing: got 12345, expected the id of a thing of the world");
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("saved"), true) << "none of it";
  const Json done = page.good(
      {{"do", "edit"},
       {"edits", {add, {{"op", "set"}, {"thing", wall}, {"values", {{"position", {0.7, 0}}}}}, add}}});
  EXPECT_EQ(done.at("things").size(), 3u);
  EXPECT_GT(done.at("things").at(0), 0);
  EXPECT_EQ(done.at("things").at(1), 0);
  page.good({{"do", "undo"}});
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("saved"), true) << "all of it";
}

TEST_F(LostWork, pieces_go_from_one_world_to_another) {
  write("other.toml",
        "twinpuck = 1\n[arena]\nsize = [2.0, 2.0]\n\n[[box]]\nname = \"wall\"\nposition = [0, 0.5]\nsize = "
        "[0.1, 0.1, 0.1]\n");
  std::string text;
  {
    Page page(open("world.toml"));
    const Json world = page.event("hello").at("world");
    text =
        page.good({{"do", "text_of"}, {"things", {thing(world, "wall"), world.at("robots").at(0).at("id")}}})
            .at("text");
  }
  Page page(open("other.toml"));
  page.event("hello");
  const Json pasted = page.good({{"do", "edit"}, {"op", "paste"}, {"text", text}, {"dx", -0.1}, {"dy", 0.2}});
  EXPECT_EQ(pasted.at("things").size(), 2u);
  const Json world = page.event("world").at("world");
  EXPECT_EQ(world.at("things").at(1).at("name"), "wall2") << world;
  EXPECT_NEAR(world.at("things").at(1).at("position").at(0).get<double>(), 0.7, 1e-9);
  EXPECT_NEAR(world.at("things").at(1).at("position").at(1).get<double>(), 0.2, 1e-9);
  EXPECT_EQ(world.at("robots").at(0).at("name"), "puck");
  EXPECT_EQ(page.refusal({{"do", "edit"}, {"op", "paste"}, {"text", "hello"}}),
            "text: got no piece of a world, expected [[box]], [[robot]] and the like");
}

TEST_F(LostWork, a_section_comes_where_the_file_has_none) {
  Page page(open("world.toml"));
  page.event("hello");
  page.good({{"do", "edit"}, {"op", "add"}, {"path", "proximity"}, {"values", {{"rays", 3}}}});
  const Json world = page.event("world").at("world");
  EXPECT_NE(world.at("text").get<std::string>().find("\n[proximity]\nrays = 3\n"), std::string::npos)
      << world.at("text");
  EXPECT_TRUE(world.at("problems").empty()) << world.at("problems");
  EXPECT_EQ(page.refusal({{"do", "edit"}, {"op", "add"}, {"path", "proximity"}, {"values", {{"rays", 5}}}}),
            "path: got 'proximity', which is there once")
      << "it is there once";
}

TEST_F(LostWork, nothing_is_saved_through_a_link) {
  write("elsewhere/kept.toml", "kept");
  fs::create_symlink(folder_ / "elsewhere/kept.toml", folder_ / "link.toml");
  fs::create_symlink(folder_ / "elsewhere/none.toml", folder_ / "dangling.toml");
  Page page(open("world.toml"));
  for (const char* name : {"link.toml", "dangling.toml"})
    EXPECT_EQ(
        page.refusal({{"do", "save_as"}, {"name", name}, {"overwrite", true}}),
        "name: got '" + std::string(name) + "', which is a link, expected a file of the world's folder");
  EXPECT_EQ(read("elsewhere/kept.toml"), "kept");
  EXPECT_FALSE(fs::exists(folder_ / "elsewhere/none.toml"));
}

TEST_F(LostWork, what_writers_left_that_died_is_removed) {
  write(".#world.toml.999999999", "half");
  write(".#world.toml." + std::to_string(::getpid()), "somebody writes");
  write(".#world.toml.notes", "somebody's own");
  open("world.toml");
  EXPECT_FALSE(fs::exists(folder_ / ".#world.toml.999999999"));
  EXPECT_TRUE(fs::exists(folder_ / (".#world.toml." + std::to_string(::getpid()))));
  EXPECT_TRUE(fs::exists(folder_ / ".#world.toml.notes"));
}

TEST_F(LostWork, a_world_saved_under_another_name_is_that_one) {
  Page page(open("world.toml"));
  page.event("hello");
  page.good({{"do", "save_as"}, {"name", "mine.toml"}});
  EXPECT_NE(page.event("world").at("world").at("file").get<std::string>().find("mine.toml"),
            std::string::npos);
}

TEST_F(LostWork, another_world_opens_in_the_same_view) {
  write("other.toml", "twinpuck = 1\ntitle = \"the other\"\n[arena]\nsize = [2.0, 2.0]\n");
  write("no_world.toml", "[project]\nname = \"x\"\n");
  Page page(open("world.toml"));
  const Json world = page.event("hello").at("world");
  const Json worlds = page.good({{"do", "worlds"}});
  ASSERT_EQ(worlds.at("here").size(), 2u) << worlds;
  EXPECT_EQ(worlds.at("here").at(0).at("title"), "the other");
  EXPECT_GT(worlds.at("examples").size(), 20u);
  page.good(
      {{"do", "edit"}, {"op", "set"}, {"thing", thing(world, "wall")}, {"values", {{"position", {0.5, 0}}}}});
  const Json open_it{{"do", "open"}, {"file", path("other.toml")}};
  EXPECT_EQ(page.ask(open_it).value("unsaved", false), true);
  page.good({{"do", "save"}});
  page.good(open_it);
  page.event("world", [](const Json& e) { return e.at("world").at("title") == "the other"; });
  EXPECT_EQ(page.refusal({{"do", "open"}, {"file", "/etc/passwd"}}),
            "file: got '/etc/passwd', expected one of `worlds`");
  EXPECT_TRUE(wording::reads(page.refusal({{"do", "open"}, {"file", path("no_world.toml")}}),
                             "file: got '@/no_world.toml', expected one of `worlds`",
                             {{folder_.string(), "@"}}));
  page.good({{"do", "new_world"}, {"name", "fresh.toml"}});
  EXPECT_NE(read("fresh.toml").find("[arena]"), std::string::npos);
  EXPECT_EQ(page.refusal({{"do", "new_world"}, {"name", "world.toml"}}),
            "name: got 'world.toml', which is there already; overwrite it?")
      << "it is there";
  EXPECT_EQ(page.refusal({{"do", "new_world"}, {"name", "../out.toml"}}),
            "name: got '../out.toml', expected a file name that ends in .toml, for the world's own folder");
}

// --- recordings

/// Digest of a recording, done again without a page.
std::string digest_of_replay(const std::string& file, std::vector<std::string>& problems) {
  auto replay = inputs::Replay::open(file, problems);
  if (!replay) return "";
  sim::LoadedWorld loaded = twin::parse_world(replay->opening.text, replay->opening.file);
  twin::Options options;
  options.world_folder = fs::path(replay->opening.file).parent_path().string();
  replay->resume(options);
  loaded.world->seed = replay->opening.seed;
  auto twin = twin::Twin::open(*loaded.world, options, problems);
  if (!twin) return "";
  inputs::Inputs inputs(*twin);
  sim::Simulation& simulation = twin->simulation();
  while (simulation.now() < replay->end()) {
    replay->apply_due(inputs, simulation.now());
    inputs.step();
  }
  replay->finish(inputs, simulation, problems);
  return problems.empty() ? "same" : problems[0];
}

TEST_F(LostWork, a_recording_with_edits_of_programs_is_shown_again_to_the_bit) {
  {
    Page page(open("world.toml", path("inputs.jsonl")));
    page.event("hello");
    steps(page, 20);
    for (const char* speed : {"speed = -400", "speed = 300", "speed = -200"}) {
      const Json now = source(page);
      std::string text = now.at("text");
      const std::size_t at = text.find("speed = ");
      text.replace(at, text.find(';', at) - at, speed);
      EXPECT_TRUE(write_source(page, text, now.at("base")).contains("ok"));
      EXPECT_TRUE(page.event("built").at("ok"));
      page.good({{"do", "type"},
                 {"robot", "puck"},
                 {"port", 1},
                 {"bytes",
                  "\xC3\xBF"
                  "ab"}});
      page.good({{"do", "selector"}, {"robot", "puck"}, {"position", 5}});
      page.good({{"do", "move"}, {"robot", "puck"}, {"x", -0.3}, {"y", 0.1}, {"heading", 0.2}});
      steps(page, 20);
    }
  }
  close();
  EXPECT_EQ(digest_of_replay(path("inputs.jsonl"), problems_), "same");
  // moved, with its images, and after the sources have become something else
  write("drive/main.c", "int main(void) { while (1); }\n");
  fs::create_directories(folder_ / "elsewhere");
  fs::rename(folder_ / "inputs.jsonl", folder_ / "elsewhere/inputs.jsonl");
  fs::rename(folder_ / "inputs.jsonl.images", folder_ / "elsewhere/inputs.jsonl.images");
  problems_.clear();
  EXPECT_EQ(digest_of_replay(path("elsewhere/inputs.jsonl"), problems_), "same");
}

TEST_F(LostWork, a_recording_that_cannot_be_written_is_said_at_once) {
  fs::create_symlink("/dev/full", folder_ / "full.jsonl");
  Page page(open("world.toml", path("full.jsonl")));
  std::string told;
  for (int look = 0; look < 200 && told.empty(); ++look) {
    told = page.good({{"do", "state"}}).at("state").at("recording").at("error");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(wording::reads(told,
                             "@/full.jsonl: --record-inputs: cannot be written: No space left on device",
                             {{folder_.string(), "@"}}));
  EXPECT_TRUE(wording::reads(view_->end(),
                             "@/full.jsonl: --record-inputs: cannot be written: No space left on device",
                             {{folder_.string(), "@"}}));
}

}  // namespace
