// SPDX-License-Identifier: MIT
#include "python/core/values_in_python.h"

#include <stdexcept>

namespace py = pybind11;

namespace python {

namespace {

using Kind = dspic::DebugInfo::Kind;

py::object number_of(const debug::CValue& value) {
  if (value.type.is_float()) return py::float_(value.real);
  const bool is_signed = value.type.stars == 0 && value.type.kind == debug::CType::Kind::Signed;
  return is_signed ? py::int_(static_cast<std::int64_t>(value.raw)) : py::int_(value.raw);
}

/// A part of an array or struct, and the text that names it.
debug::Part element(const debug::Values& values, const debug::Part& whole, unsigned index) {
  const auto& types = values.debug_info().types;
  const auto& type = types[static_cast<std::size_t>(whole.found.type)];
  debug::Part part = whole;
  part.found.type = type.element;
  part.found.offset += index * types[static_cast<std::size_t>(type.element)].bytes;
  return part;
}

debug::Part member_of(const debug::Part& whole, const dspic::DebugInfo::Member& member) {
  debug::Part part = whole;
  part.found = {whole.found.variable, member.type, whole.found.offset + member.offset, member.bit,
                member.width};
  return part;
}

py::object object_of(const debug::Values& values, const debug::Part& part) {
  const auto& type = values.debug_info().types[static_cast<std::size_t>(part.found.type)];
  if (type.kind == Kind::Array) {
    py::list list;
    for (unsigned i = 0; i < type.count; ++i) list.append(object_of(values, element(values, part, i)));
    return list;
  }
  if (type.kind == Kind::Struct) {
    py::dict dict;
    for (const auto& member : type.members) {
      const py::object inner = object_of(values, member_of(part, member));
      // an unnamed union's members stand for it
      if (!member.name.empty())
        dict[py::str(member.name)] = inner;
      else if (py::isinstance<py::dict>(inner))
        dict.attr("update")(inner);
    }
    return dict;
  }
  const auto number = values.number(part);
  return number ? number_of(*number) : py::none();
}

struct Change {
  debug::Data to;
  std::uint64_t raw;
};

/// A Python number as text of C.
std::string c_number(const std::string& what, const py::object& value) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "1" : "0";
  if (py::isinstance<py::float_>(value) || !py::hasattr(value, "__index__")) {
    if (!py::hasattr(value, "__float__"))
      throw std::invalid_argument(what + ": got " + py::repr(value).cast<std::string>() +
                                  ", expected a number");
    std::string text = py::repr(py::float_(value)).cast<std::string>();
    if (text.find_first_of("ni") != std::string::npos)
      throw std::invalid_argument(what + ": got " + text + ", expected a finite number");
    return text + "L";  // of 64 bits, as long double has them; a float is rounded once
  }
  const py::object whole = value.attr("__index__")();
  // C's widest type takes no more; a float may
  if (whole.attr("bit_length")().cast<int>() > 64)
    return py::repr(whole.attr("__float__")()).cast<std::string>();
  return py::str(whole).cast<std::string>();
}

void plan(const debug::Values& values, const std::string& expression, const py::object& value,
          std::vector<Change>& changes) {
  if (py::isinstance<py::dict>(value)) {
    for (const auto& [key, inner] : value.cast<py::dict>())
      plan(values, expression + "." + py::str(key).cast<std::string>(),
           py::reinterpret_borrow<py::object>(inner), changes);
    return;
  }
  const bool is_text = py::isinstance<py::str>(value);
  if (is_text || (py::isinstance<py::sequence>(value)) || py::hasattr(value, "tolist")) {
    if (is_text)
      throw std::invalid_argument(expression + ": got text, expected a number, bytes, a list or a dict");
    const py::object list =
        py::hasattr(value, "tolist") ? value.attr("tolist")() : py::object(py::list(value));
    if (py::isinstance<py::list>(list)) {
      debug::CValue array;
      std::string error;
      if (!values.compute(expression, debug::Want::Place, array, error)) throw std::invalid_argument(error);
      const auto& types = values.debug_info().types;
      const auto* const type =
          array.part ? &types[static_cast<std::size_t>(array.part->found.type)] : nullptr;
      const std::size_t count = py::len(list);
      if (!type || type->kind != Kind::Array || count > type->count)
        throw std::invalid_argument(
            expression + ": got " + std::to_string(count) + " values, expected " +
            (type && type->kind == Kind::Array ? "at most " + std::to_string(type->count) : "a number"));
      for (std::size_t i = 0; i < count; ++i)
        plan(values, expression + "[" + std::to_string(i) + "]", list[py::int_(i)], changes);
      return;
    }
    plan(values, expression, list, changes);
    return;
  }
  Change change{{}, 0};
  std::string error;
  if (!values.assignment(expression, c_number(expression, value), change.to, change.raw, error))
    throw std::invalid_argument(expression + ": " + error);
  changes.push_back(change);
}

}  // namespace

py::object value_of(const chip::ChipRunner& runner, const std::string& expression) {
  const debug::Values values(runner);
  debug::CValue value;
  std::string error;
  if (!values.compute(expression, debug::Want::Place, value, error)) throw std::invalid_argument(error);
  if (value.part) return object_of(values, *value.part);
  if (!values.compute(expression, debug::Want::Number, value, error)) throw std::invalid_argument(error);
  return number_of(value);
}

void assign(const chip::ChipRunner& runner, const std::string& expression, const py::object& value,
            const Write& write) {
  std::vector<Change> changes;
  plan(debug::Values(runner), expression, value, changes);
  for (const Change& change : changes) write(change.to, change.raw);
}

}  // namespace python
