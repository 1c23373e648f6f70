// SPDX-License-Identifier: MIT
// The protocol's table: what pages may ask for and what they are told. Checks, the messages of what is wrong,
// the page's types and the tables of docs are made of it.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace viewer {

enum class FieldType { Text, Integer, Number, Flag, Choice, Names, Integers, Object, List, Any };

struct Field {
  const char* name;
  FieldType type;
  bool needed;
  double least, most;   ///< of numbers; equal: any
  const char* unit;     ///< "" none
  const char* choices;  ///< "tick|control"; of Choice only
  const char* does;
};

/// Who may ask: anybody; who steers; who steers, while a world runs.
enum class Right { Look, Steer, Touch };

struct Request {
  const char* name;
  Right right;
  std::vector<Field> fields;
  const char* answers;  ///< what the answer holds beside "answer"; "" nothing
  const char* does;
};
const std::vector<Request>& requests();
/// Null: there is none of that name.
const Request* find_request(const std::string& name);
/// Throws std::runtime_error, "FIELD: got ..., expected ... (unit); did you mean ...?", for a request whose
/// fields are not what the table says.
void check_request(const Request& request, const nlohmann::json& got);
/// Throws likewise for fields of a request's kind (`op` of an edit) that are not there.
void need_fields(const Request& request, const nlohmann::json& got, const std::vector<std::string>& names);

struct Member {
  const char* name;
  const char* type;  ///< as TypeScript writes it
  const char* says;
};
struct Event {
  const char* name;
  std::vector<Member> members;
  const char* when;
};
const std::vector<Event>& events();

/// An object that events and answers hold.
struct Shape {
  const char* name;
  const char* says;
  std::vector<Member> members;
};
const std::vector<Shape>& shapes();
/// Of the shape Trap, and of the event that tells one.
std::vector<Member> trap_members();

/// Tables for docs, in Markdown.
std::string protocol_tables();
/// The same as types of TypeScript.
std::string protocol_types();

}  // namespace viewer
