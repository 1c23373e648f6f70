// SPDX-License-Identifier: MIT
// What pages are told is so: times of steps, problems of worlds and programs, robots that do not fit,
// requests that are wrong.
#include "tests/viewer/driven_world.h"
#include "tools/dev/doc_part.h"
#include "twinpuck_paths.h"
#include "viewer/programs.h"
#include "viewer/requests.h"

namespace {

using namespace viewer_test;

using Shown = DrivenWorld;

TEST_F(Shown, a_control_step_is_to_the_next_multiple) {
  Page page(open("world.toml"));
  const auto time_s = [&] { return page.good({{"do", "state"}}).at("state").at("time_s").get<double>(); };
  const double tick_s = 1.0 / 512;
  steps(page, 100);
  EXPECT_GE(time_s(), 3.2 - 1e-9);
  EXPECT_LT(time_s(), 3.2 + tick_s);
  page.good({{"do", "step"}});
  steps(page, 1);
  EXPECT_GE(time_s(), 3.232 - 1e-9);
  EXPECT_LT(time_s(), 3.232 + tick_s);
}

TEST_F(Shown, findings_of_compilers_have_places) {
  const auto is = [](const std::string& line, const char* kind, const char* file, int at, int column,
                     const char* text) {
    const viewer::Finding f = viewer::finding_of(line, "error");
    EXPECT_EQ(f.kind, kind) << line;
    EXPECT_EQ(f.file, file) << line;
    EXPECT_EQ(f.line, at) << line;
    EXPECT_EQ(f.column, column) << line;
    EXPECT_EQ(f.text, text) << line;
  };
  is("/x/main.c:3:5: error: expected ';'", "error", "/x/main.c", 3, 5, "expected ';'");
  is("/x/a b.c:12: warning: odd", "warning", "/x/a b.c", 12, 0, "odd");
  is("/x/main.c:3:5: note: from here", "note", "/x/main.c", 3, 5, "from here");
  is("firmware: got 'x', expected a controller", "error", "", 0, 0,
     "firmware: got 'x', expected a controller");
  is("", "error", "", 0, 0, "");
}

TEST_F(Shown, a_program_that_does_not_compile_is_told_whoever_comes_when) {
  write("drive/main.c", "int main(void) { return 1 }\n");
  Page page(open("world.toml"));
  Json hello = page.event("hello");
  ASSERT_FALSE(hello.at("problems").empty());
  const Json finding = hello.at("programs").at(0).at("findings").at(0);
  EXPECT_EQ(finding.at("file"), "main.c") << finding;
  EXPECT_EQ(finding.at("line"), 1);
  EXPECT_EQ(hello.at("programs").at(0).at("ok"), false);
  EXPECT_EQ(hello.at("state").at("runs"), false);
  // mended by whatever editor, it runs
  write("drive/main.c", kDrive);
  page.event("problems", [](const Json& e) { return e.at("problems").empty(); });
  page.event("programs", [](const Json& e) { return e.at("programs").at(0).at("ok") == true; });
  // one that is broken while it runs stays with its findings, also for who comes later
  write("drive/main.c", std::string(kDrive) + "int broken( {\n");
  page.event("built", [](const Json& e) { return e.at("ok") == false; });
  Page later(view());
  hello = later.event("hello");
  EXPECT_EQ(hello.at("state").at("runs"), true);
  EXPECT_EQ(hello.at("programs").at(0).at("findings").at(0).at("kind"), "error");
}

TEST_F(Shown, a_robot_that_does_not_fit_has_its_place_and_no_body) {
  Page page(open("world.toml"));
  const Json world = page.event("hello").at("world");
  EXPECT_EQ(world.at("robots").at(0).at("body"), 0);
  const int robot = world.at("robots").at(0).at("id");
  page.good({{"do", "edit"}, {"op", "set"}, {"thing", robot}, {"values", {{"position", {0.8, 0.1}}}}});
  const Json broken = page.event("world").at("world");
  ASSERT_FALSE(broken.at("problems").empty()) << "it stands in the wall";
  EXPECT_EQ(broken.at("problems").at(0).at("id"), robot);
  EXPECT_NEAR(broken.at("robots").at(0).at("position").at(0).get<double>(), 0.8, 1e-9);
  // a robot that the running world does not have
  page.good({{"do", "undo"}});
  page.good({{"do", "edit"},
             {"op", "add"},
             {"path", "robot"},
             {"values", {{"name", "new"}, {"position", {0.8, 0.1}}}}});
  const Json more =
      page.event("world", [](const Json& e) { return e.at("world").at("robots").size() == 2; }).at("world");
  EXPECT_EQ(more.at("robots").at(0).at("body"), 0);
  EXPECT_EQ(more.at("robots").at(1).at("body"), -1);
}

// --- changes

/// Pieces that the last event told whole; -1: it told all.
int pieces_told(Page& page) {
  const Json event = page.event("world");
  if (!event.contains("changes")) return -1;
  int told = 0;
  for (const char* name : {"things", "robots"})
    told += static_cast<int>(event.at("changes").at(name).at("fresh").size());
  return told;
}

TEST_F(Shown, an_edit_tells_what_became_other_and_no_more) {
  write("world.toml",
        std::string(kWorld) +
            "\n[[ball]]\nname = \"ball\"\nradius = 0.02\nmovable = true\nposition = [0, 0.2]\n");
  Page page(open("world.toml"));
  Json world = page.event("hello").at("world");
  const int wall = thing(world, "wall"), ball = thing(world, "ball");
  const int arena = world.at("arena").at("id"), robot = world.at("robots").at(0).at("id");
  const Json here{{"position", {0.7, 0.1}}};
  struct Row {
    Json edit;
    int told;  // pieces; -1: all
  };
  const std::vector<Row> rows = {
      {{{"op", "set"}, {"thing", wall}, {"values", here}}, 1},
      {{{"op", "set"}, {"thing", ball}, {"values", {{"position", {0.1, 0.2}}}}}, 1},
      // a line more, so that all behind it stand one further down
      {{{"op", "set"}, {"thing", wall}, {"values", {{"heading", 10}}}}, 1},
      {{{"op", "set"}, {"thing", wall}, {"values", {{"heading", nullptr}}}}, 1},
      {{{"op", "add"}, {"path", "box"}, {"values", {{"position", {-0.8, 0.3}}, {"size", {0.1, 0.1, 0.1}}}}},
       1},
      {{{"op", "copy"}, {"thing", wall}, {"values", {{"position", {0.3, 0.3}}}}}, 1},
      {{{"do", "undo"}}, 0},
      {{{"do", "redo"}}, 1},
      // a movable thing more: others have other bodies
      {{{"op", "paste"}, {"text", "[[ball]]\nradius = 0.01\nmovable = true\nposition = [0.5, -0.4]\n"}}, 2},
      {{{"op", "remove"}, {"thing", ball}}, 1},
      {{{"op", "set"}, {"thing", robot}, {"values", {{"position", {-0.6, 0}}}}}, 1},
      {{{"op", "set"}, {"thing", arena}, {"values", {{"size", {2.5, 1.5}}}}}, -1},
      {{{"op", "set"}, {"thing", wall}, {"values", {{"position", {-0.6, 0}}}}}, -1},  // over the robot
      {{{"op", "set"}, {"thing", wall}, {"values", here}}, -1},
      {{{"op", "copy"}, {"thing", robot}, {"values", {{"name", "two"}, {"position", {-0.6, 0.3}}}}}, -1},
      {{{"op", "add"}, {"path", "material"}, {"values", {{"name", "paint"}, {"colour", {1, 0, 0}}}}}, -1},
      {{{"op", "set"}, {"thing", wall}, {"values", {{"material", "paint"}}}}, 1},
      {{{"op", "text"}, {"text", "# \u00e4\n" + std::string(kWorld)}}, -1},
      {{{"op", "text"}, {"text", "# \u00e4\n" + std::string(kWorld) + "\n# the end"}}, 1},
  };
  for (const Row& row : rows) {
    Json request = row.edit;
    if (!request.contains("do")) request["do"] = "edit";
    page.good(request);
    EXPECT_EQ(pieces_told(page), row.told) << request;
    // it is what somebody sees who comes now
    Page other(view());
    EXPECT_EQ(page.world(), other.event("hello").at("world")) << request;
  }
}

// --- the table

std::string text_of(const std::string& file) {
  std::ifstream in(TWINPUCK_SOURCE_DIR + file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(Requests, are_in_docs_and_in_the_page_as_they_are) {
  const std::string page = text_of("/docs/connecting.md");
  EXPECT_EQ(dev::with_doc_part(page, "requests", viewer::protocol_tables()), page)
      << "run build/twinpuck-dev page docs/connecting.md";
  EXPECT_EQ(text_of("/viewer/page/src/link/protocol_types.ts"), viewer::protocol_types())
      << "run build/twinpuck-dev page viewer/page/src/link/protocol_types.ts";
}

struct Wrong {
  const char* name;
  Json request;
  const char* message;
};

TEST(Requests, that_are_wrong_say_what_was_expected) {
  const Wrong table[] = {
      {"step", {{"unit", "furlong"}}, "unit: got \"furlong\", expected tick, control or interrupt"},
      {"step", {{"count", 0}}, "count: got 0, expected a whole number, 1 to 10000"},
      {"step", {{"count", 1.5}}, "count: got 1.5, expected a whole number, 1 to 10000"},
      {"step", {{"counts", 1}}, "step: got 'counts', expected unit, count, robot; did you mean count?"},
      {"subscribe", Json::object(), "names: got none, expected a list of names"},
      {"subscribe", {{"names", {1}}}, "names: got [1], expected a list of names"},
      {"move",
       {{"robot", "r"}, {"x", "a"}, {"y", 0}, {"heading", 0}},
       "x: got \"a\", expected a number, -1000 to 1000 (m)"},
      {"battery", {{"robot", "r"}, {"volts", 5}}, "volts: got 5, expected a number, 3 to 4.2 (V)"},
      {"lamp", {{"lamp", 0}, {"on", 1}}, "on: got 1, expected true or false"},
      {"play", {{"fast", true}}, "play: got 'fast', expected nothing else"},
      {"dap", {{"message", "x"}}, "message: got \"x\", expected an object"},
  };
  for (const Wrong& wrong : table) {
    std::string told;
    try {
      viewer::check_request(*viewer::find_request(wrong.name), wrong.request);
    } catch (const std::runtime_error& e) {
      told = e.what();
    }
    EXPECT_EQ(told, wrong.message);
  }
}

TEST_F(Shown, what_a_request_of_that_kind_needs_is_told_in_our_words) {
  Page page(open("world.toml"));
  const int wall = thing(page.event("hello").at("world"), "wall");
  const std::string thing_said = "thing: got none, expected a whole number, 0 to 1000000000";
  const std::string values_said = "values: got none, expected an object";
  const std::string path_said = "path: got none, expected a text";
  const std::string text_said = "text: got none, expected a text";
  const std::pair<Json, std::string> table[] = {
      {{{"do", "move"}, {"x", 0}, {"y", 0}, {"heading", 0}}, "robot: got none, expected a text"},
      {{{"do", "move"}, {"body", 9}, {"x", 0}, {"y", 0}, {"heading", 0}}, "body: got 9, expected 0 to 0"},
      {{{"do", "lamp"}, {"lamp", 0}, {"on", true}}, "lamp: got 0, expected none: there is no lamp"},
      {{{"do", "end_fault"}, {"fault", 0}}, "fault: got 0, expected none: there is no fault"},
      {{{"do", "restart"}, {"seed", -3}}, "seed: got -3, expected a whole number, 0 to 18446744073709551615"},
      {{{"do", "restart"}, {"seed", 1e20}},
       "seed: got 1e+20, expected a whole number, 0 to 18446744073709551615"},
      {{{"do", "edit"}},
       "op: got none, expected set, add, remove, copy, paste, add_inner, remove_inner or text"},
      {{{"do", "edit"}, {"op", "set"}, {"values", Json::object()}}, thing_said},
      {{{"do", "edit"}, {"op", "set"}, {"thing", wall}}, values_said},
      {{{"do", "edit"}, {"op", "add"}, {"values", Json::object()}}, path_said},
      {{{"do", "edit"}, {"op", "add"}, {"path", "box"}}, values_said},
      {{{"do", "edit"}, {"op", "remove"}}, thing_said},
      {{{"do", "edit"}, {"op", "copy"}}, thing_said},
      {{{"do", "edit"}, {"op", "add_inner"}, {"thing", wall}, {"values", Json::object()}}, path_said},
      {{{"do", "edit"}, {"op", "add_inner"}, {"thing", wall}, {"path", "robot.part"}}, values_said},
      {{{"do", "edit"}, {"op", "remove_inner"}, {"thing", wall}, {"path", "robot.part"}},
       "index: got none, expected a whole number, 0 to 1000000"},
      {{{"do", "edit"}, {"op", "text"}}, text_said},
      {{{"do", "edit"}, {"op", "paste"}}, text_said},
      {{{"do", "edit"}, {"edits", {{{"op", "remove"}}}}}, thing_said},
      {{{"do", "edit"}, {"edits", {{{"op", "remove"}, {"thing", "x"}}}}},
       "thing: got \"x\", expected a whole number, 0 to 1000000000"},
      {{{"do", "edit"}, {"edits", {7}}}, "edits: got 7, expected an object"},
  };
  for (const auto& [request, said] : table) EXPECT_EQ(page.refusal(request), said) << request;
  page.good({{"do", "restart"}, {"seed", UINT64_MAX}});
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("seed"), UINT64_MAX);
}

TEST_F(Shown, every_request_of_the_table_is_one_of_the_session) {
  Page page(open("world.toml"));
  page.event("hello");
  for (const viewer::Request& request : viewer::requests()) {
    Json asked{{"do", request.name}};
    for (const viewer::Field& field : request.fields) {
      if (!field.needed) continue;
      switch (field.type) {
        case viewer::FieldType::Text:
          asked[field.name] = "";
          break;
        case viewer::FieldType::Integer:
        case viewer::FieldType::Number:
        case viewer::FieldType::Any:
          asked[field.name] = field.least < field.most ? field.most : 1;
          break;
        case viewer::FieldType::Flag:
          asked[field.name] = true;
          break;
        case viewer::FieldType::Choice:
          asked[field.name] = "x";
          break;
        case viewer::FieldType::Object:
          asked[field.name] = Json::object();
          break;
        default:
          asked[field.name] = Json::array();
      }
    }
    // of these the table does not say that one of several is needed
    if (request.name == std::string("edit")) asked.update({{"op", "text"}, {"text", ""}});
    if (request.name == std::string("move")) asked["robot"] = "";
    const Json answer = page.ask(asked);
    EXPECT_EQ(answer.value("error", "").find("do: got"), std::string::npos) << answer;
    EXPECT_EQ(answer.value("error", "").find("got none, expected"), std::string::npos) << answer;
  }
  EXPECT_EQ(page.refusal({{"do", "stepp"}}),
            "do: got 'stepp', expected a request of docs/connecting.md; did you mean step?");
  for (const char* hostile : {"[]", "{\"do\": 5}", "{\"do\": null}", "nonsense", "{}"}) {
    page.send_raw(1, hostile);
  }
  EXPECT_TRUE(page.good({{"do", "state"}}).contains("state"));
}

}  // namespace
