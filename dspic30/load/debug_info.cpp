// SPDX-License-Identifier: MIT
#include "dspic30/load/debug_info.h"

#include <dwarf.h>
#include <elfutils/libdw.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace dspic {

namespace {

constexpr int kDeepest = 64;
constexpr int kFramePointer = 14;

using Entry = Dwarf_Die;

std::uint32_t offset_of(const Entry& entry) {
  return static_cast<std::uint32_t>(dwarf_dieoffset(const_cast<Entry*>(&entry)));
}
/// An entry's own attribute.
std::optional<Dwarf_Attribute> find(const Entry& entry, unsigned attribute) {
  Dwarf_Attribute found;
  if (!dwarf_attr(const_cast<Entry*>(&entry), attribute, &found)) return std::nullopt;
  return found;
}
bool has(const Entry& entry, unsigned attribute) {
  return dwarf_hasattr(const_cast<Entry*>(&entry), attribute) != 0;
}
std::optional<std::uint32_t> number(const Entry& entry, unsigned attribute) {
  auto found = find(entry, attribute);
  Dwarf_Word value = 0;
  if (!found || dwarf_formudata(&*found, &value) != 0) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}
/// Empty: it has none.
std::string text(const Entry& entry, unsigned attribute) {
  auto found = find(entry, attribute);
  const char* const value = found ? dwarf_formstring(&*found) : nullptr;
  return value ? value : "";
}
/// The entry that an attribute refers to.
std::optional<Entry> target(const Entry& entry, unsigned attribute) {
  auto found = find(entry, attribute);
  Entry to;
  if (!found || !dwarf_formref_die(&*found, &to)) return std::nullopt;
  return to;
}
template <class Visit>
void each_inner(const Entry& entry, const Visit& visit) {
  Entry inner;
  if (dwarf_child(const_cast<Entry*>(&entry), &inner) != 0) return;
  do visit(inner);
  while (dwarf_siblingof(&inner, &inner) == 0);
}
/// Operations of a location that is one for all of the code; none: it is no such thing.
std::vector<Dwarf_Op> location(const Entry& entry, unsigned attribute) {
  auto found = find(entry, attribute);
  Dwarf_Op* operations = nullptr;
  std::size_t count = 0;
  if (!found || dwarf_getlocation(&*found, &operations, &count) != 0) return {};
  return {operations, operations + count};
}
/// The first address of its code; 0: it has none here.
std::uint32_t begin_of(const Entry& entry) {
  Dwarf_Addr base, begin, end;
  const bool has_code = dwarf_ranges(const_cast<Entry*>(&entry), 0, &base, &begin, &end) > 0;
  return has_code ? static_cast<std::uint32_t>(begin) : 0;
}

template <class Visit>
void each_unit(Elf* elf, const Visit& visit) {
  Dwarf* const dwarf = dwarf_begin_elf(elf, DWARF_C_READ, nullptr);
  Dwarf_CU* unit = nullptr;
  Entry top;
  while (dwarf && dwarf_get_units(dwarf, unit, &unit, nullptr, nullptr, &top, nullptr) == 0)
    if (dwarf_tag(&top) == DW_TAG_compile_unit) visit(top);
  dwarf_end(dwarf);
}

class Reader {
 public:
  explicit Reader(DebugInfo& out) : out_(out) {}

  void read_unit(const Entry& top) {
    types_.clear();
    points_.clear();
    functions_.clear();
    file_ = text(top, DW_AT_name);
    lines_ = number(top, DW_AT_stmt_list).value_or(0);
    scope(top, 0, 0, kFramePointer, 0);
    for (std::size_t i = 0; i < points_.size(); ++i) {  // what they point to may hold more of them
      const auto [pointer, entry] = points_[i];
      const int to = type_of(entry);
      out_.types[static_cast<std::size_t>(pointer)].element = to;
    }
  }

 private:
  // --- types

  int type_of(const Entry& entry, int depth = 0) {
    const auto type = target(entry, DW_AT_type);
    return type ? type_at(*type, depth) : 0;
  }

  int type_at(const Entry& entry, int depth) {
    const std::uint32_t offset = offset_of(entry);
    if (const auto known = types_.find(offset); known != types_.end()) return known->second;
    if (depth > kDeepest) return 0;
    types_[offset] = 0;  // while it is being read
    DebugInfo::Type type;
    type.bytes = number(entry, DW_AT_byte_size).value_or(0);
    switch (dwarf_tag(const_cast<Entry*>(&entry))) {
      case DW_TAG_typedef:
      case DW_TAG_const_type:
      case DW_TAG_volatile_type:
        return types_[offset] = type_of(entry, depth + 1);
      case DW_TAG_base_type: {
        const unsigned encoding = number(entry, DW_AT_encoding).value_or(0);
        type.is_truth = encoding == DW_ATE_boolean;
        type.kind = encoding == DW_ATE_float                                      ? DebugInfo::Kind::Float
                    : encoding == DW_ATE_signed || encoding == DW_ATE_signed_char ? DebugInfo::Kind::Signed
                                                                                  : DebugInfo::Kind::Unsigned;
        break;
      }
      case DW_TAG_enumeration_type:
        type.kind = add_enumerators(entry) ? DebugInfo::Kind::Signed : DebugInfo::Kind::Unsigned;
        if (!type.bytes) type.bytes = 2;
        break;
      case DW_TAG_pointer_type:
        type.kind = DebugInfo::Kind::Pointer;
        type.bytes = 2;  // the chip's are words, whatever addresses of code are
        points_.emplace_back(add(std::move(type)), entry);
        return types_[offset] = points_.back().first;
      case DW_TAG_array_type:
        return types_[offset] = array(entry, depth);
      case DW_TAG_structure_type:
      case DW_TAG_union_type:
        type.kind = DebugInfo::Kind::Struct;
        add_members(entry, type, depth);
        break;
      default:
        return 0;
    }
    return types_[offset] = add(std::move(type));
  }

  /// True: one of them is negative.
  bool add_enumerators(const Entry& entry) {
    bool has_negative = false;
    each_inner(entry, [&](Entry& inner) {
      const std::string name = text(inner, DW_AT_name);
      const auto value = number(inner, DW_AT_const_value);
      if (dwarf_tag(&inner) != DW_TAG_enumerator || name.empty() || !value) return;
      has_negative |= static_cast<std::int32_t>(*value) < 0;
      out_.enumerators.emplace(name, static_cast<std::int32_t>(*value));
    });
    return has_negative;
  }

  /// For casts; the first of a name counts.
  void note_name(Entry& entry) {
    const std::string name = text(entry, DW_AT_name);
    if (name.empty() || has(entry, DW_AT_declaration)) return;
    out_.named.emplace((dwarf_tag(&entry) == DW_TAG_typedef ? "" : "struct ") + name, type_at(entry, 0));
  }

  int add(DebugInfo::Type&& type) {
    out_.types.push_back(std::move(type));
    return static_cast<int>(out_.types.size()) - 1;
  }

  int array(const Entry& entry, int depth) {
    std::vector<unsigned> counts;
    each_inner(entry, [&](Entry& range) {
      if (dwarf_tag(&range) != DW_TAG_subrange_type) return;
      const auto count = number(range, DW_AT_count), last = number(range, DW_AT_upper_bound);
      counts.push_back(count ? *count : last ? *last + 1 : 0);
    });
    int of = type_of(entry, depth + 1);
    for (auto count = counts.rbegin(); count != counts.rend(); ++count) {
      DebugInfo::Type type;
      type.kind = DebugInfo::Kind::Array;
      type.element = of;
      type.count = *count;
      type.bytes = out_.types[static_cast<std::size_t>(of)].bytes * *count;
      of = add(std::move(type));
    }
    return of;
  }

  void add_members(const Entry& entry, DebugInfo::Type& type, int depth) {
    each_inner(entry, [&](Entry& inner) {
      if (dwarf_tag(&inner) != DW_TAG_member) return;
      DebugInfo::Member member;
      member.name = text(inner, DW_AT_name);
      member.type = type_of(inner, depth + 1);
      if (const auto offset = number(inner, DW_AT_data_member_location))
        member.offset = *offset;
      else if (const auto at = location(inner, DW_AT_data_member_location);
               !at.empty() && at[0].atom == DW_OP_plus_uconst)
        member.offset = static_cast<unsigned>(at[0].number);
      if ((member.width = static_cast<int>(number(inner, DW_AT_bit_size).value_or(0)))) {
        const unsigned unit = std::max(1u, out_.types[static_cast<std::size_t>(member.type)].bytes);
        if (const auto bit = number(inner, DW_AT_data_bit_offset)) {
          member.offset = *bit / (8 * unit) * unit;
          member.bit = static_cast<int>(*bit % (8 * unit));
        } else {  // DWARF 2 counts from the highest bit of the storage unit
          member.bit =
              static_cast<int>(8 * unit - number(inner, DW_AT_bit_offset).value_or(0)) - member.width;
        }
      }
      type.members.push_back(std::move(member));
    });
  }

  // --- variables

  // `begin` to `end`: code of the innermost function or block; end 0: of none
  void scope(const Entry& entry, std::uint32_t begin, std::uint32_t end, int frame, int depth) {
    if (depth > kDeepest) return;
    each_inner(entry, [&](Entry& inner) {
      std::uint32_t from = begin, to = end;
      const int tag = dwarf_tag(&inner);
      switch (tag) {
        case DW_TAG_typedef:
        case DW_TAG_structure_type:
        case DW_TAG_union_type:
        case DW_TAG_enumeration_type:
          note_name(inner);
          break;
        case DW_TAG_variable:
        case DW_TAG_formal_parameter:
          add_variable(inner, begin, end, frame);
          break;
        case DW_TAG_subprogram:
        case DW_TAG_lexical_block:
        case DW_TAG_inlined_subroutine:
          if (Dwarf_Addr low, high; dwarf_lowpc(&inner, &low) == 0) {
            from = to = static_cast<std::uint32_t>(low);
            if (dwarf_highpc(&inner, &high) == 0) to = static_cast<std::uint32_t>(high);
          } else if (tag == DW_TAG_subprogram) {
            to = from = 1;  // only its statics are somewhere
          }
          if (tag != DW_TAG_lexical_block) note_function(inner, from, to);
          scope(inner, from, to, tag == DW_TAG_subprogram ? frame_of(inner) : frame, depth + 1);
          break;
        default:
          break;
      }
    });
  }

  /// What both an entry of a function or variable and those of its copies refer to.
  static Entry origin_of(const Entry& entry) {
    for (const unsigned link : {DW_AT_abstract_origin, DW_AT_specification})
      if (const auto to = target(entry, link)) return *to;
    return entry;
  }

  void note_function(Entry& entry, std::uint32_t begin, std::uint32_t end) {
    const Entry about = origin_of(entry);
    const std::string name = text(about, DW_AT_name);
    if (name.empty() || has(about, DW_AT_declaration)) return;
    const auto [known, is_new] = functions_.emplace(offset_of(about), out_.functions.size());
    if (is_new) {
      out_.functions.emplace_back();
      out_.functions.back().name = name;
      out_.functions.back().unit = lines_;
      out_.functions.back().file = number(about, DW_AT_decl_file).value_or(0);
      out_.functions.back().line = static_cast<int>(number(about, DW_AT_decl_line).value_or(0));
    }
    DebugInfo::Function& function = out_.functions[known->second];
    if (dwarf_tag(&entry) == DW_TAG_inlined_subroutine) {  // a copy in another function, if it has code
      if (const std::uint32_t copy = begin_of(entry)) function.inlined_at.push_back(copy);
    } else if (has(entry, DW_AT_low_pc) && begin == 0) {
      function.is_left_out = true;
    } else if (has(entry, DW_AT_low_pc)) {
      function.begin = begin, function.end = end;
    }
  }

  static int frame_of(const Entry& function) {
    const auto base = location(function, DW_AT_frame_base);
    const int operation = base.empty() ? 0 : base[0].atom;
    return operation >= DW_OP_reg0 && operation <= DW_OP_reg15     ? operation - DW_OP_reg0
           : operation >= DW_OP_breg0 && operation <= DW_OP_breg15 ? operation - DW_OP_breg0
                                                                   : kFramePointer;
  }

  void add_variable(const Entry& entry, std::uint32_t begin, std::uint32_t end, int frame) {
    const Entry about = origin_of(entry);  // where its name and type are
    DebugInfo::Variable v;
    v.name = text(about, DW_AT_name);
    if (v.name.empty() || has(entry, DW_AT_declaration)) return;
    v.file = file_;
    v.type = type_of(about);
    v.begin = begin;
    v.end = end;
    v.is_static = false;
    DebugInfo::Place place;
    if (const auto constant = number(entry, DW_AT_const_value)) {
      place.in = DebugInfo::Place::In::Value;
      place.value = static_cast<int>(*constant);
      v.places.push_back(place);
    } else if (const auto operations = location(entry, DW_AT_location); !operations.empty()) {
      if (!read_place(operations.data(), operations.size(), frame, place)) return;
      if (place.in == DebugInfo::Place::In::Memory && place.value == 0) return;  // the linker left it out
      v.is_static = place.in == DebugInfo::Place::In::Memory;
      v.places.push_back(place);
    } else {
      add_places(entry, frame, v);
    }
    if (!v.is_static && end <= begin) return;
    if (!v.places.empty()) out_.variables.push_back(std::move(v));
  }

  /// Of a list, each for a part of the code.
  static void add_places(const Entry& entry, int frame, DebugInfo::Variable& v) {
    auto list = find(entry, DW_AT_location);
    Dwarf_Addr base, begin, end;
    Dwarf_Op* operations;
    std::size_t count;
    for (std::ptrdiff_t at = 0;
         list && v.places.size() < 1000 &&
         (at = dwarf_getlocations(&*list, at, &base, &begin, &end, &operations, &count)) > 0;) {
      DebugInfo::Place place;
      place.begin = static_cast<std::uint32_t>(begin);
      place.end = static_cast<std::uint32_t>(end);
      if (read_place(operations, count, frame, place)) v.places.push_back(place);
    }
  }

  // of one operation, but for a value
  static bool read_place(const Dwarf_Op* operations, std::size_t count, int frame, DebugInfo::Place& place) {
    using In = DebugInfo::Place::In;
    if (count == 0) return false;
    const int operation = operations->atom;
    place.value = static_cast<int>(operations->number);
    if (operation == DW_OP_addr) {
      place.in = In::Memory;
    } else if (operation >= DW_OP_reg0 && operation <= DW_OP_reg15) {
      place.in = In::Register;
      place.value = operation - DW_OP_reg0;
    } else if (operation == DW_OP_fbreg || (operation >= DW_OP_breg0 && operation <= DW_OP_breg15)) {
      place.in = In::Frame;
      place.base = operation == DW_OP_fbreg ? frame : operation - DW_OP_breg0;
    } else {
      place.in = In::Value;
      if (operation >= DW_OP_lit0 && operation <= DW_OP_lit31) place.value = operation - DW_OP_lit0;
      const bool is_number = (operation >= DW_OP_lit0 && operation <= DW_OP_lit31) ||
                             (operation >= DW_OP_const1u && operation <= DW_OP_consts);
      return is_number && count == 2 && operations[1].atom == DW_OP_stack_value;
    }
    return count == 1;
  }

  DebugInfo& out_;
  std::map<std::uint32_t, int> types_;              // of the unit, by place
  std::map<std::uint32_t, std::size_t> functions_;  // of the unit, in out_
  std::vector<std::pair<int, Entry>> points_;       // pointers, and their entries
  std::string file_;
  std::uint32_t lines_ = 0;
};

bool is_in(const DebugInfo::Variable& v, std::uint32_t pc) { return pc >= v.begin && pc < v.end; }

}  // namespace

void DebugInfo::add(Elf* elf) {
  Reader reader(*this);
  each_unit(elf, [&](const Entry& top) { reader.read_unit(top); });
}

const DebugInfo::Place* DebugInfo::place_at(const Variable& variable, std::uint32_t pc) {
  for (const Place& place : variable.places)
    if (variable.is_static || (pc >= place.begin && pc < place.end)) return &place;
  return nullptr;
}

bool DebugInfo::find(const std::string& expression, std::uint32_t pc, Found& found, std::string& error,
                     const std::function<bool(const Variable&)>& may_be) const {
  const std::size_t stop = expression.find_first_of(".[");
  const std::string name = expression.substr(0, stop);
  // the innermost scope that holds pc, then the files', then a static of another function
  found = {};
  const auto rank = [pc](const Variable& v) {
    return is_in(v, pc) ? v.end - v.begin : v.end == 0 ? 1u << 30 : 1u << 31;
  };
  for (const Variable& v : variables)
    if (v.name == name && (v.is_static || is_in(v, pc)) && (!may_be || may_be(v)) &&
        (!found.variable || rank(v) < rank(*found.variable)))
      found.variable = &v;
  if (!found.variable) {
    error = "got '" + expression + "', expected a variable of the image that is known here";
    return false;
  }
  found.type = found.variable->type;
  for (std::size_t at = stop; at < expression.size();) {
    const std::size_t next = std::min(expression.find_first_of(".[", at + 1), expression.size());
    if (!follow(expression.substr(at, next - at), found, error)) {
      error = "got '" + expression + "', " + error;
      return false;
    }
    at = next;
  }
  return true;
}

bool DebugInfo::follow(const std::string& step, Found& found, std::string& error) const {
  const Type& type = types[static_cast<std::size_t>(found.type)];
  if (step[0] == '.') {
    if (step_into(step.substr(1), found)) return true;
    const auto of_type =
        std::find_if(named.begin(), named.end(), [&](const auto& n) { return n.second == found.type; });
    const std::string type_name =
        of_type == named.end() ? "it" : "'" + of_type->first.substr(of_type->first.find(' ') + 1) + "'";
    error = "no member '" + step.substr(1) + "' in " + type_name;
    return false;
  }
  char* end = nullptr;
  const unsigned long index = std::strtoul(step.c_str() + 1, &end, 0);
  if (step.size() < 3 || end != step.c_str() + step.size() - 1 || *end != ']')
    error = "expected a number in [ ]";
  else if (type.kind != Kind::Array)
    error = "it is no array";
  else if (index >= type.count)
    error = "index " + std::to_string(index) + ", expected 0 to " +
            std::to_string(static_cast<long>(type.count) - 1);
  else {
    found.offset += static_cast<unsigned>(index) * types[static_cast<std::size_t>(type.element)].bytes;
    found.type = type.element;
    return true;
  }
  return false;
}

bool DebugInfo::step_into(const std::string& name, Found& found, int depth) const {
  for (const Member& member : types[static_cast<std::size_t>(found.type)].members) {
    Found inner = found;
    inner.type = member.type;
    inner.offset += member.offset;
    inner.bit = member.bit;
    inner.width = member.width;
    if (member.name != name &&
        (!member.name.empty() || depth > kDeepest || !step_into(name, inner, depth + 1)))
      continue;
    found = inner;
    return true;
  }
  return false;
}

std::map<std::uint32_t, std::string> DebugInfo::folders_in(Elf* elf) {
  std::map<std::uint32_t, std::string> all;
  each_unit(elf, [&](const Entry& top) {
    if (const auto lines = number(top, DW_AT_stmt_list)) all[*lines] = text(top, DW_AT_comp_dir);
  });
  return all;
}

void read_elf(std::string& bytes, DebugInfo& into) {
  if (Elf* const elf = elf_memory(bytes.data(), bytes.size())) {
    into.add(elf);
    elf_end(elf);
  }
}

}  // namespace dspic
