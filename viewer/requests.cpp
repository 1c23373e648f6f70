// SPDX-License-Identifier: MIT
#include "viewer/requests.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "hal_sim/inputs/inputs.h"
#include "sim_core/base/did_you_mean.h"
#include "viewer/frame.h"
#include "viewer/names.h"

namespace viewer {

namespace {

using Json = nlohmann::json;

// 2^64: the largest whole number is this to a double, and of others only whole ones of JSON are not beyond
constexpr double kBeyondWhole = 18446744073709551616.0;

// shapes of fields that come more than once
Field text(const char* name, const char* does, bool needed = true) {
  return {name, FieldType::Text, needed, 0, 0, "", "", does};
}
Field flag(const char* name, const char* does) { return {name, FieldType::Flag, false, 0, 0, "", "", does}; }
Field whole(const char* name, double least, double most, const char* does, bool needed = true,
            const char* unit = "") {
  return {name, FieldType::Integer, needed, least, most, unit, "", does};
}
Field number(const char* name, double least, double most, const char* unit, const char* does,
             bool needed = true) {
  return {name, FieldType::Number, needed, least, most, unit, "", does};
}
Field other(const char* name, FieldType type, const char* does, bool needed = true,
            const char* choices = "") {
  return {name, type, needed, 0, 0, "", choices, does};
}
Field robot(bool needed = true) { return text("robot", "its name", needed); }
const Field kAnew = flag("anew", "the run may begin anew for it");
const Field kOverwrite = flag("overwrite", "whatever lies there now");

// A row a request; requests.h says what the columns are.
std::vector<Request> make_requests() {
  return {
      {"play", Right::Steer, {}, "", "goes on"},
      {"pause", Right::Steer, {}, "", "stands still"},
      {"step",
       Right::Steer,
       {other("unit", FieldType::Choice,
              "tick, unless it says so: of the physics; control: to the next multiple of the world's "
              "`time_step`; interrupt: until `robot` has served one",
              false, "tick|control|interrupt"),
        whole("count", 1, 10000, "how many", false), robot(false)},
       "",
       "steps, then stands still"},
      {"speed",
       Right::Steer,
       {other("factor", FieldType::Any, "simulated seconds a second, above 0, or \"max\"")},
       "",
       "how fast it goes"},
      {"restart",
       Right::Steer,
       {whole("seed", 0, kBeyondWhole, "of the new run", false), flag("play", "goes on at once")},
       "",
       "a new run from time 0"},
      {"steer", Right::Look, {}, "", "from now on this client does, and others look"},
      {"state", Right::Look, {}, "`state`, with `digest` and `clicks`", ""},
      {"subscribe",
       Right::Look,
       {other("names", FieldType::Names, "up to 256")},
       "`subscription`, `units`",
       "values in every frame, in this order"},
      {"rays",
       Right::Look,
       {other("robots", FieldType::Names, "")},
       "",
       "rays of their proximity sensors in every frame"},
      {"look", Right::Look, {text("robot", "its name; empty: none")}, "", "`look` events of this robot"},
      {"trace",
       Right::Look,
       {text("robot", "its name; empty: none"),
        other("signals", FieldType::Names, "the usual ones without", false)},
       "",
       "`trace` events of this robot"},
      {"floor",
       Right::Look,
       {},
       "`width`, `height`, `rgb`",
       "the picture on the floor: three bytes a pixel from the north-west on, base64"},

      {"edit",
       Right::Steer,
       {other("op", FieldType::Choice, "see below", false,
              "set|add|remove|copy|paste|add_inner|remove_inner|text"),
        whole("thing", 0, 1e9, "id of a piece of the file", false),
        other("values", FieldType::Object, "keys and values; null takes a key away", false),
        text("path", "of a table: box, robot.part", false), whole("index", 0, 1e6, "from 0", false),
        text("text", "of the whole file, or pieces", false),
        text("base", "of the text that it was made of", false), number("dx", -1000, 1000, "m", "east", false),
        number("dy", -1000, 1000, "m", "north", false),
        other("edits", FieldType::List, "many at once: all or none", false),
        whole("group", 0, 2147483647, "edits of one group other than 0 are undone together", false), kAnew},
       "`thing`, `things`: ids of what is new; `conflict`",
       "the world file's text"},
      {"undo", Right::Steer, {kAnew}, "`done`", ""},
      {"redo", Right::Steer, {kAnew}, "`done`", ""},
      {"reload", Right::Steer, {kAnew}, "", "what is on the disk becomes the text"},
      {"text_of",
       Right::Look,
       {other("things", FieldType::Integers, "ids of pieces")},
       "`text`",
       "as they are written"},
      {"save",
       Right::Steer,
       {kOverwrite},
       "`file`; `conflict` or `readonly`",
       "the file is the old or the new one at every instant"},
      {"save_as",
       Right::Steer,
       {text("name", "of a file that ends in .toml, in the world's folder"), kOverwrite},
       "`file`; `readonly`",
       ""},
      {"worlds", Right::Look, {}, "`here`, `examples`: `file` and `title` of each", "what can be opened"},
      {"open",
       Right::Steer,
       {text("file", "one of `worlds`"), flag("discard", "what is not saved goes")},
       "`unsaved`",
       "another world in this view"},
      {"new_world",
       Right::Steer,
       {text("name", "as with save_as"), flag("discard", "what is not saved goes")},
       "`unsaved`",
       "an empty arena, saved and opened"},
      {"source",
       Right::Look,
       {text("program", "its name"), text("file", "one of its files")},
       "`text`, `base`, `writable`, `encoding`",
       "a controller's source; its lines end with LF here"},
      {"write_source",
       Right::Steer,
       {text("program", "its name"), text("file", "one of its files"), text("text", ""),
        text("base", "of what was read", false), kOverwrite},
       "`base`; `conflict` or `readonly`",
       "written with the file's own line ends and encoding, and built"},

      {"debug",
       Right::Steer,
       {text("robot", "its name; empty: no more")},
       "",
       "the run is repeated under the debugger, and stands where it stood"},
      {"dap",
       Right::Steer,
       {other("message", FieldType::Object, "`command`, `arguments` of the Debug Adapter Protocol")},
       "`body`",
       "to the debugger"},

      {"move",
       Right::Touch,
       {robot(false), whole("body", 0, 1e6, "number in frames", false), number("x", -1000, 1000, "m", ""),
        number("y", -1000, 1000, "m", ""), number("heading", -1e6, 1e6, "rad", "")},
       "",
       "put there, at rest; the file stays"},
      {"type",
       Right::Touch,
       {robot(), whole("port", 1, 2, "of its UARTs"),
        text("bytes", "each character is one byte, up to U+00FF")},
       "",
       "bytes to a serial line, at its baud rate"},
      {"selector", Right::Touch, {robot(), whole("position", 0, 15, "")}, "", ""},
      {"battery",
       Right::Touch,
       {robot(), number("volts", inputs::kLeastBatteryV, inputs::kMostBatteryV, "V", "")},
       "",
       "charged to this"},
      {"key",
       Right::Touch,
       {robot(), whole("key", 0, 63, "of RC5"), number("hold", 0, 60, "s", "0.1 without", false),
        whole("address", 0, 31, "of RC5, 0 without", false)},
       "",
       "of a remote control"},
      {"set",
       Right::Touch,
       {robot(), text("variable", "global or static, in C"), number("value", 0, 0, "", "")},
       "",
       "a variable gets a value"},
      {"write",
       Right::Touch,
       {robot(), whole("address", 0, 65535, ""), whole("bytes", 1, 8, ""),
        whole("value", 0, kBeyondWhole, "lowest byte first")},
       "",
       "data memory or registers"},
      {"reset", Right::Touch, {robot()}, "", "its reset button"},
      {"sensor",
       Right::Touch,
       {robot(), text("name", ""), number("value", 0, 0, "", "")},
       "",
       "defines a virtual sensor"},
      {"faults", Right::Touch, {text("text", "of a file of faults")}, "", "adds its faults and stimuli"},
      {"end_fault", Right::Touch, {whole("fault", 0, 1e6, "its number, from 0")}, "", "ends it"},
      {"lamp",
       Right::Touch,
       {whole("lamp", 0, 1e6, "its number, from 0"),
        {"on", FieldType::Flag, true, 0, 0, "", "", ""},
        number("intensity", 0, 1e4, "W/m2", "the world's without", false)},
       "",
       "switches a lamp"},
  };
}

// A row an event: its name, its members, when it comes.
std::vector<Event> make_events() {
  return {
      {"hello",
       {{"version", "number", "of the protocol"},
        {"you", "number", "this client's number, as in `steering`"},
        {"revision", "number", "of the world"},
        {"state", "State", ""},
        {"world", "World", ""},
        {"programs", "Program[]", ""},
        {"problems", "string[]", "why no world runs"},
        {"diagnoses", "Diagnosis[]", ""},
        {"traps", "Trap[]", "so far"},
        {"names", "string[]", "that can be subscribed to, without the robot's name"},
        {"schema", "Schema", "sections, keys, units, ranges of the world file"}},
       "once, first"},
      {"world",
       {{"revision", "number", "frames of this world have it, too"}, {"world", "World", ""}},
       "what stands where, `elements` of the file, `problems` with the `id` of what they are about"},
      {"world_changed",
       {{"revision", "number", "likewise"}, {"changes", "WorldChanges", "to the world as it was"}},
       "after an edit of pieces"},
      {"state", {{"state", "State", ""}}, "whenever it has changed, but for the time"},
      {"programs", {{"programs", "Program[]", ""}}, "which robots run what, files, findings of compilers"},
      {"problems", {{"problems", "string[]", "empty: it runs"}}, "a run could not begin, or can again"},
      {"disk",
       {{"program", "string | undefined", "without: the world"},
        {"file", "string", ""},
        {"base", "string | null", "of what is there now; null: it is gone"}},
       "a file is another one on the disk"},
      {"serial",
       {{"robot", "string", ""},
        {"port", "number", "1, 2; 0: the console of programs for Webots"},
        {"time_s", "number", ""},
        {"text", "string", "each character is a byte"}},
       "bytes of a serial line"},
      {"trap", trap_members(), "a program was stopped"},
      {"diagnoses",
       {{"diagnoses", "Diagnosis[]", "all of the run"}},
       "what board and chip say of the programs has changed"},
      {"says", {{"text", "string", ""}}, "a supervisor, or the simulator"},
      {"trace",
       {{"robot", "string", ""},
        {"until", "number", "s"},
        {"signals", "[string, number][]", "name and bits"},
        {"spans", "[number, number, number, string][]",
         "kind (0 busy, 1 waiting, 2 handler, 3 waiting in a handler, 4 agenda), begin, end in s, name"},
        {"waits", "boolean", "does the program wait at `until`?"},
        {"changes", "[number, number, number][]", "signal's number, time in s, value"},
        {"lost", "number", "how many there were beyond 4000"}},
       "what happened since the one before"},
      {"look",
       {{"robot", "string", ""},
        {"time_s", "number", ""},
        {"hal", "string", ""},
        {"place", "Place", "where its program stands"},
        {"parts", "PartLook[]", "what its parts show"},
        {"camera", "Camera | undefined",
         "`at` in m, in the robot's frame; `edges`: tangents left, right, low, high"},
        {"picture", "Picture | undefined", "the last that the program got"}},
       "at most ten a second, when it is another one than the last"},
      {"building", {{"program", "string", ""}}, "a program is compiled"},
      {"built",
       {{"program", "string", ""},
        {"ok", "boolean", ""},
        {"problems", "string[]", ""},
        {"warnings", "string[]", ""},
        {"took_s", "number", ""}},
       "and its robots have it, if that went well"},
      {"dap",
       {{"name", "string", "stopped, continued, output, terminated"}, {"body", "any", ""}},
       "an event of the Debug Adapter Protocol"},
  };
}

const char* type_said(FieldType type) {
  switch (type) {
    case FieldType::Text:
      return "a text";
    case FieldType::Integer:
      return "a whole number";
    case FieldType::Number:
      return "a number";
    case FieldType::Flag:
      return "true or false";
    case FieldType::Choice:
      return "a word";
    case FieldType::Names:
      return "a list of names";
    case FieldType::Integers:
      return "a list of whole numbers";
    case FieldType::Object:
      return "an object";
    case FieldType::List:
      return "a list";
    case FieldType::Any:
      break;
  }
  return "a value";
}

std::string script_type(const Field& field) {
  std::string out;
  switch (field.type) {
    case FieldType::Text:
      return "string";
    case FieldType::Integer:
    case FieldType::Number:
      return "number";
    case FieldType::Flag:
      return "boolean";
    case FieldType::Choice:
      for (const char* c = field.choices; *c; ++c) out += *c == '|' ? "\" | \"" : std::string(1, *c);
      return "\"" + out + "\"";
    case FieldType::Names:
      return "string[]";
    case FieldType::Integers:
      return "number[]";
    case FieldType::Object:
      return "Record<string, unknown>";
    case FieldType::List:
      return "unknown[]";
    case FieldType::Any:
      break;
  }
  return "unknown";
}

bool is_choice(const Field& field, const std::string& word) {
  const std::string all = std::string("|") + field.choices + "|";
  return word.find('|') == std::string::npos && all.find("|" + word + "|") != std::string::npos;
}

bool all_are(const Json& list, bool (*is)(const Json&)) {
  if (!list.is_array()) return false;
  for (const Json& one : list)
    if (!is(one)) return false;
  return true;
}

bool fits(const Field& field, const Json& value) {
  switch (field.type) {
    case FieldType::Text:
      return value.is_string();
    case FieldType::Integer:
    case FieldType::Number: {
      if (!value.is_number()) return false;
      const double v = value.get<double>();
      if (field.type == FieldType::Integer && v != std::floor(v)) return false;
      if (v == kBeyondWhole && !value.is_number_integer()) return false;
      return std::isfinite(v) && (field.least == field.most || (v >= field.least && v <= field.most));
    }
    case FieldType::Flag:
      return value.is_boolean();
    case FieldType::Choice:
      return value.is_string() && is_choice(field, value.get<std::string>());
    case FieldType::Names:
      return all_are(value, [](const Json& one) { return one.is_string(); });
    case FieldType::Integers:
      return all_are(value, [](const Json& one) { return one.is_number_integer(); });
    case FieldType::Object:
      return value.is_object();
    case FieldType::List:
      return value.is_array();
    case FieldType::Any:
      break;
  }
  return true;
}

/// "0 to 15", "tick, control or interrupt", "a text".
std::string expected(const Field& field) {
  if (field.type == FieldType::Choice) {
    std::string out = field.choices;
    for (std::size_t at = out.rfind('|'), is_last = 1; at != std::string::npos;
         at = out.rfind('|'), is_last = 0)
      out.replace(at, 1, is_last ? " or " : ", ");
    return out;
  }
  std::string out = type_said(field.type);
  if (field.most == kBeyondWhole)
    out = fmt::format("{}, {:g} to {}", out, field.least, UINT64_MAX);
  else if (field.least < field.most)
    out = fmt::format("{}, {:g} to {:.10g}", out, field.least, field.most);
  return *field.unit ? fmt::format("{} ({})", out, field.unit) : out;
}

[[noreturn]] void unknown_field(const Request& request, const std::string& name,
                                const std::vector<std::string>& known) {
  std::string all;
  for (const std::string& field : known) all += (all.empty() ? "" : ", ") + field;
  const std::string like = sim::did_you_mean(name, known);
  throw std::runtime_error(fmt::format("{}: got '{}', expected {}{}", request.name, name.substr(0, 60),
                                       all.empty() ? "nothing else" : all,
                                       like.empty() ? "" : "; did you mean " + like + "?"));
}

std::string shortened(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

std::string type_of_member(const Member& m) {
  const std::string type = m.type;
  const std::string tail = " | undefined";
  const bool is_optional =
      type.size() > tail.size() && type.compare(type.size() - tail.size(), tail.size(), tail) == 0;
  return fmt::format("{}{}: {}", m.name, is_optional ? "?" : "",
                     is_optional ? type.substr(0, type.size() - tail.size()) : type);
}

}  // namespace

const std::vector<Request>& requests() {
  static const std::vector<Request> all = make_requests();
  return all;
}

const std::vector<Event>& events() {
  static const std::vector<Event> all = make_events();
  return all;
}

const Request* find_request(const std::string& name) {
  for (const Request& request : requests())
    if (name == request.name) return &request;
  return nullptr;
}

void check_request(const Request& request, const Json& got) {
  for (const auto& [name, value] : got.items()) {
    if (name == "do" || name == "id") continue;
    const Field* field = nullptr;
    std::vector<std::string> known;
    for (const Field& f : request.fields) {
      known.push_back(f.name);
      if (name == f.name) field = &f;
    }
    if (!field) unknown_field(request, name, known);
    if (!fits(*field, value))
      throw std::runtime_error(
          fmt::format("{}: got {}, expected {}", name, shortened(value), expected(*field)));
  }
  std::vector<std::string> needed;
  for (const Field& field : request.fields)
    if (field.needed) needed.emplace_back(field.name);
  need_fields(request, got, needed);
}

void need_fields(const Request& request, const Json& got, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    for (const Field& field : request.fields)
      if (name == field.name && !got.contains(name))
        throw std::runtime_error(fmt::format("{}: got none, expected {}", name, expected(field)));
}

namespace {

struct Op {
  const char *name, *members, *does;
};
constexpr Op kOps[] = {
    {"set", "`thing`, `values`", "keys of a piece; comments, order and the style of numbers stay"},
    {"add", "`path`, `values`", "a piece; a section that the file has not"},
    {"copy", "`thing`, *`values`*", "with the comment above it"},
    {"remove", "`thing`", ""},
    {"paste", "`text`, *`dx`*, *`dy`*", "pieces as `text_of` gives them; names that are taken become others"},
    {"add_inner", "`thing`, `path` robot.part, `values`", "plugs in a part"},
    {"remove_inner", "`thing`, `path`, `index`", "unplugs it"},
    {"text", "`text`, *`base`*", "the whole file; `base` of the text that was changed"},
};

std::string members_said(const std::vector<Member>& members) {
  std::string out;
  for (const Member& m : members)
    out += fmt::format("{}`{}`{}{}{}", out.empty() ? "" : "; ", m.name, *m.says ? " (" : "", m.says,
                       *m.says ? ")" : "");
  return out;
}

std::string types_said(const std::vector<Member>& members) {
  std::string out;
  for (const Member& m : members) out += (out.empty() ? "" : "; ") + type_of_member(m);
  return out;
}

/// "`count` (1 to 10000, how many)", in italics if it may be left out.
std::string field_said(const Field& field) {
  std::string more = field.unit;
  if (field.type == FieldType::Choice)
    more = expected(field);
  else if (field.least < field.most && field.most < 1e6)
    more = fmt::format("{:g} to {:g}{}{}", field.least, field.most, *field.unit ? " " : "", field.unit);
  if (*field.does) more += (more.empty() ? "" : ", ") + std::string(field.does);
  const char* mark = field.needed ? "" : "*";
  return fmt::format("{}`{}`{}{}", mark, field.name, mark, more.empty() ? "" : " (" + more + ")");
}

}  // namespace

std::string protocol_tables() {
  std::string out = "| `do` | further members | the answer's | does |\n|---|---|---|---|\n";
  for (const Request& request : requests()) {
    std::string members;
    for (const Field& field : request.fields) members += (members.empty() ? "" : "; ") + field_said(field);
    out += fmt::format("| `{}`{} | {} | {} | {} |\n", request.name, request.right == Right::Touch ? " †" : "",
                       members, request.answers, request.does);
  }
  out +=
      "\nMembers in *italics* may be left out. What is marked † changes the run, is written to recordings "
      "with "
      "its tick, and needs a world that runs.\n\n| event | members | |\n|---|---|---|\n";
  for (const Event& event : events())
    out += fmt::format("| `{}` | {} | {} |\n", event.name, members_said(event.members), event.when);
  out += "\n| `op` of an edit | further members | does |\n|---|---|---|\n";
  for (const Op& op : kOps) out += fmt::format("| `{}` | {} | {} |\n", op.name, op.members, op.does);
  out += "\nNames for `subscribe`, each behind a robot's name and a dot: ";
  for (const std::string& name : names_of_robots()) out += "`" + name + "` ";
  out += "`pin:D3` `reg:T2CON` `var:EXPRESSION`.\n\n| object | members | |\n|---|---|---|\n";
  for (const Shape& shape : shapes())
    out += fmt::format("| {} | {} | {} |\n", shape.name, members_said(shape.members), shape.says);
  return out + "\n" + frame_table();
}

std::string protocol_types() {
  std::string out =
      "// SPDX-License-Identifier: MIT\n// The protocol's types, made from the tables in viewer/requests.cpp "
      "and "
      "shapes.cpp by build/twinpuck-dev page.\n\n";
  for (const Shape& shape : shapes()) {
    out += fmt::format("export interface {} {{\n", shape.name);
    for (const Member& m : shape.members) out += "  " + type_of_member(m) + ";\n";
    out += "}\n";
  }
  out += "export type Schema = Record<string, Section>;\n\nexport interface Requests {\n";
  for (const Request& request : requests()) {
    std::string members;
    for (const Field& field : request.fields)
      members += fmt::format("{}{}{}: {}", members.empty() ? " " : "; ", field.name, field.needed ? "" : "?",
                             script_type(field));
    out += fmt::format("  {}: {{{}{}}};\n", request.name, members, members.empty() ? "" : " ");
  }
  out += "}\n\nexport interface Events {\n";
  for (const Event& event : events())
    out += fmt::format("  {}: {{ event: \"{}\"; {} }};\n", event.name, event.name, types_said(event.members));
  return out + "}\n";
}

}  // namespace viewer
