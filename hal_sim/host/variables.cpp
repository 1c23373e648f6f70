// SPDX-License-Identifier: MIT
#include "hal_sim/host/variables.h"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <gelf.h>

#include <cmath>
#include <cstring>
#include <set>
#include <vector>

namespace host {

namespace {

/// One definition found under a name.
struct Definition {
  Dwarf_Die die;
  std::string file, function;  // of the compilation unit; of the enclosing function, "" outside
  bool external = false;
};

struct Search {
  std::string name, scope;
  std::vector<Definition> found;
};

std::string base_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string name_of(Dwarf_Die* die) {
  const char* name = dwarf_diename(die);
  return name ? name : "";
}

bool type_of(Dwarf_Die* die, Dwarf_Die* type) {
  Dwarf_Attribute attribute;
  if (!dwarf_attr_integrate(die, DW_AT_type, &attribute) || !dwarf_formref_die(&attribute, type))
    return false;
  // typedef, const and volatile say nothing about the bytes
  return dwarf_peel_type(type, type) == 0;
}

/// The function of a static whose own entry lost its name, which clang does to functions that are inlined
/// everywhere: the symbol is called FUNCTION.NAME.
std::string function_of(Dwarf_Die* die, const std::string& name, std::uintptr_t address) {
  Elf* elf = dwarf_getelf(dwarf_cu_getdwarf(die->cu));
  Elf_Scn* section = nullptr;
  while (elf && (section = elf_nextscn(elf, section))) {
    GElf_Shdr header;
    if (!gelf_getshdr(section, &header) || header.sh_type != SHT_SYMTAB || header.sh_entsize == 0) continue;
    Elf_Data* data = elf_getdata(section, nullptr);
    for (std::size_t i = 0; i < header.sh_size / header.sh_entsize; ++i) {
      GElf_Sym symbol;
      if (!gelf_getsym(data, static_cast<int>(i), &symbol) || symbol.st_value != address) continue;
      const std::string whole = elf_strptr(elf, header.sh_link, symbol.st_name);
      const std::size_t dot = whole.find('.');
      if (dot != std::string::npos && whole.compare(dot + 1, name.size(), name) == 0)
        return whole.substr(0, dot);
    }
  }
  return "?";
}

/// Collects the variables of that name in a unit and its functions. `function`: "" outside of all, "?"
/// unknown.
void search(Dwarf_Die* parent, const std::string& file, const std::string& function, Search& s) {
  Dwarf_Die die;
  if (dwarf_child(parent, &die) != 0) return;
  do {
    const int tag = dwarf_tag(&die);
    if (tag == DW_TAG_subprogram) {
      search(&die, file, name_of(&die).empty() ? "?" : name_of(&die), s);
    } else if (tag == DW_TAG_lexical_block) {
      search(&die, file, function, s);
    } else if (tag == DW_TAG_variable && name_of(&die) == s.name && dwarf_hasattr(&die, DW_AT_location)) {
      Dwarf_Attribute location;
      Dwarf_Op* ops = nullptr;
      size_t count = 0;
      // locals have no fixed place
      if (!dwarf_attr(&die, DW_AT_location, &location) || dwarf_getlocation(&location, &ops, &count) != 0 ||
          count == 0 || ops[0].atom != DW_OP_addr)
        continue;
      const std::string inside = function == "?" ? function_of(&die, s.name, ops[0].number) : function;
      const bool in_scope =
          s.scope.empty() || s.scope == inside || s.scope == base_name(file) ||
          (file.size() > s.scope.size() &&
           file.compare(file.size() - s.scope.size() - 1, std::string::npos, "/" + s.scope) == 0);
      if (in_scope) s.found.push_back({die, file, inside, dwarf_hasattr(&die, DW_AT_external) != 0});
    }
  } while (dwarf_siblingof(&die, &die) == 0);
}

/// The definition that a name without scope means: a global, then a static of the program's own files, then
/// one inside a function. Several of the nearest kind: ambiguous.
std::string choose(const Search& s, const std::string& expression, Definition& out) {
  int best = 99;
  std::set<std::string> places;
  for (const Definition& d : s.found) {
    const bool library = d.file.find("hal_sim/") != std::string::npos;
    const int rank = (library ? 10 : 0) + (d.external ? 0 : d.function.empty() ? 1 : 2);
    if (rank > best) continue;
    if (rank < best) places.clear();
    best = rank;
    out = d;
    places.insert((d.function.empty() ? base_name(d.file) : d.function) + ":" + s.name);
  }
  if (places.empty())
    return "got '" + expression + "', expected a variable of the firmware that has a fixed place" +
           (s.scope.empty() ? "" : " in '" + s.scope + "'") +
           "; one that is gone was optimised away: make it volatile";
  if (places.size() > 1) {
    std::string all;
    for (const std::string& p : places) all += (all.empty() ? "" : ", ") + p;
    return "got '" + expression + "', which there is several times, expected one of " + all;
  }
  return {};
}

/// Where a definition's bytes are: usually one piece; the optimiser may have split a struct.
struct Piece {
  std::uintptr_t offset, address, bytes;
};

bool pieces_of(Dwarf_Die* die, std::vector<Piece>& pieces) {
  Dwarf_Attribute location;
  Dwarf_Op* ops = nullptr;
  size_t count = 0;
  if (!dwarf_attr(die, DW_AT_location, &location) || dwarf_getlocation(&location, &ops, &count) != 0)
    return false;
  std::uintptr_t offset = 0;
  for (size_t i = 0; i < count; ++i) {
    if (ops[i].atom != DW_OP_addr) {
      if (ops[i].atom != DW_OP_piece) return false;
      offset += ops[i].number;  // a part that is not in memory
      continue;
    }
    Piece piece{offset, ops[i].number, ~std::uintptr_t{0} >> 1};
    if (i + 1 < count) {
      if (ops[i + 1].atom == DW_OP_plus_uconst) piece.address += ops[++i].number;
      if (i + 1 < count && ops[i + 1].atom != DW_OP_piece) return false;
      if (i + 1 < count) piece.bytes = ops[++i].number;
    }
    offset += piece.bytes;
    pieces.push_back(piece);
  }
  return !pieces.empty();
}

std::size_t size_of(Dwarf_Die* type) {
  Dwarf_Word size = 0;
  return dwarf_aggregate_size(type, &size) == 0 ? static_cast<std::size_t>(size) : 0;
}

bool number_attr(Dwarf_Die* die, unsigned attr, Dwarf_Word& value) {
  Dwarf_Attribute attribute;
  return dwarf_attr_integrate(die, attr, &attribute) && dwarf_formudata(&attribute, &value) == 0;
}

/// Follows the steps of an expression through types, from the variable's own on.
class Walk {
 public:
  Walk(Dwarf_Die type, Variable& out) : type_(type), out_(out) {}

  std::string step_into(const std::string& member) {
    if (!find_member(type_, 0, member))
      return "no member '" + member + "' in " +
             (name_of(&type_).empty() ? "it" : "'" + name_of(&type_) + "'");
    dimension_ = 0;
    return {};
  }

  std::string step_at(long index) {
    if (dwarf_tag(&type_) != DW_TAG_array_type) return "it is no array";
    std::vector<Dwarf_Word> counts;
    Dwarf_Die child;
    if (dwarf_child(&type_, &child) == 0) do {
        if (dwarf_tag(&child) != DW_TAG_subrange_type) continue;
        Dwarf_Word n = 0;
        if (!number_attr(&child, DW_AT_count, n) && number_attr(&child, DW_AT_upper_bound, n)) ++n;
        counts.push_back(n);
      } while (dwarf_siblingof(&child, &child) == 0);
    const std::size_t d = static_cast<std::size_t>(dimension_);
    if (d >= counts.size()) return "it has only " + std::to_string(counts.size()) + " dimension(s)";
    if (index < 0 || static_cast<Dwarf_Word>(index) >= counts[d])
      return "index " + std::to_string(index) + ", expected 0 to " +
             std::to_string(static_cast<long>(counts[d]) - 1);
    Dwarf_Die element;
    if (!type_of(&type_, &element)) return "its elements have no known type";
    std::size_t row = size_of(&element);
    for (std::size_t k = d + 1; k < counts.size(); ++k) row *= counts[k];
    offset_ += row * static_cast<std::size_t>(index);
    bytes_ = row;
    if (++dimension_ == static_cast<int>(counts.size())) {
      type_ = element;
      dimension_ = 0;
    }
    return {};
  }

  std::size_t offset() const { return offset_; }

  void finish() {
    out_.bytes = dimension_ > 0 ? bytes_ : size_of(&type_);
    const int tag = dwarf_tag(&type_);
    Dwarf_Word encoding = 0;
    if (tag == DW_TAG_base_type && number_attr(&type_, DW_AT_encoding, encoding)) {
      out_.kind = encoding == DW_ATE_float                                      ? Variable::Kind::Float
                  : encoding == DW_ATE_signed || encoding == DW_ATE_signed_char ? Variable::Kind::Signed
                                                                                : Variable::Kind::Unsigned;
    } else if (tag == DW_TAG_enumeration_type) {
      Dwarf_Die under;
      Dwarf_Word of = DW_ATE_unsigned;
      if (type_of(&type_, &under)) number_attr(&under, DW_AT_encoding, of);
      out_.kind = of == DW_ATE_signed ? Variable::Kind::Signed : Variable::Kind::Unsigned;
    } else if (tag == DW_TAG_pointer_type) {
      out_.kind = Variable::Kind::Unsigned;
    }
  }

 private:
  bool find_member(Dwarf_Die aggregate, std::size_t base, const std::string& name) {
    const int tag = dwarf_tag(&aggregate);
    Dwarf_Die member;
    if ((tag != DW_TAG_structure_type && tag != DW_TAG_union_type) || dwarf_child(&aggregate, &member) != 0)
      return false;
    do {
      if (dwarf_tag(&member) != DW_TAG_member) continue;
      Dwarf_Word at = 0, bit = 0, width = 0;
      number_attr(&member, DW_AT_data_member_location, at);
      Dwarf_Die type;
      if (!type_of(&member, &type)) continue;
      const std::string member_name = name_of(&member);
      if (member_name.empty()) {
        if (find_member(type, base + at, name)) return true;
        continue;
      }
      if (member_name != name) continue;
      if (number_attr(&member, DW_AT_bit_size, width)) {
        const std::size_t unit = size_of(&type);
        out_.bits = static_cast<int>(width);
        if (number_attr(&member, DW_AT_data_bit_offset, bit)) {
          at = bit / (8 * unit) * unit;
          out_.first_bit = static_cast<int>(bit % (8 * unit));
        } else if (number_attr(&member, DW_AT_bit_offset, bit)) {
          // DWARF 2 counts from the highest bit of the storage unit
          out_.first_bit = static_cast<int>(8 * unit - bit - width);
        }
      }
      offset_ += base + at;
      type_ = type;
      return true;
    } while (dwarf_siblingof(&member, &member) == 0);
    return false;
  }

  Dwarf_Die type_;
  Variable& out_;
  std::size_t offset_ = 0;
  std::size_t bytes_ = 0;
  int dimension_ = 0;  // of an array of several, how many are chosen
};

}  // namespace

std::string find_variable(Dwarf* dwarf, const std::string& expression, Variable& out) {
  if (!dwarf) return "got a firmware without debug information, expected one that `twinpuck build` made";
  Search s;
  std::size_t at = expression.find_first_of(".[:");
  if (const std::size_t colon = expression.find(':'); colon != std::string::npos) {
    s.scope = expression.substr(0, colon);
    at = expression.find_first_of(".[", colon + 1);
    s.name = expression.substr(colon + 1, at == std::string::npos ? at : at - colon - 1);
  } else {
    s.name = expression.substr(0, at);
  }
  Dwarf_Off offset = 0, next = 0;
  size_t header = 0;
  while (dwarf_nextcu(dwarf, offset, &next, &header, nullptr, nullptr, nullptr) == 0) {
    Dwarf_Die unit;
    if (dwarf_offdie(dwarf, offset + header, &unit)) search(&unit, name_of(&unit), "", s);
    offset = next;
  }
  Definition chosen;
  if (std::string wrong = choose(s, expression, chosen); !wrong.empty()) return wrong;
  std::vector<Piece> pieces;
  Dwarf_Die type;
  const std::string got = "got '" + expression + "', ";
  if (!pieces_of(&chosen.die, pieces) || !type_of(&chosen.die, &type))
    return got + "which the optimiser keeps in another form, expected a plain variable; make it volatile";

  out = {};
  Walk walk(type, out);
  while (at != std::string::npos && at < expression.size()) {
    std::string wrong;
    if (expression[at] == '[') {
      char* end = nullptr;
      const long index = std::strtol(expression.c_str() + at + 1, &end, 0);
      if (end == expression.c_str() + at + 1 || *end != ']') return got + "expected a number in [ ]";
      wrong = walk.step_at(index);
      at = static_cast<std::size_t>(end - expression.c_str()) + 1;
    } else if (expression[at] == '.') {
      const std::size_t stop = expression.find_first_of(".[", at + 1);
      wrong = walk.step_into(expression.substr(at + 1, stop == std::string::npos ? stop : stop - at - 1));
      at = stop;
    } else {
      return got + "expected NAME, then .MEMBER and [INDEX] as C writes them";
    }
    if (!wrong.empty()) return got + wrong;
  }
  walk.finish();
  if (out.bytes == 0) return got + "whose size is not known, expected a variable with a complete type";
  for (const Piece& p : pieces) {
    if (walk.offset() < p.offset || walk.offset() - p.offset + out.bytes > p.bytes) continue;
    out.address = p.address + (walk.offset() - p.offset);
    return {};
  }
  return got + "which the optimiser has split up, expected a plain variable; make it volatile";
}

double variable_value(const Variable& v, const char* at) {
  if (v.kind == Variable::Kind::Float) {
    if (v.bytes == sizeof(float)) {
      float f;
      std::memcpy(&f, at, sizeof f);
      return static_cast<double>(f);
    }
    double d = 0;
    if (v.bytes == sizeof d) std::memcpy(&d, at, sizeof d);
    return d;
  }
  std::uint64_t word = 0;
  std::memcpy(&word, at, std::min(v.bytes, sizeof word));
  const int width = v.bits > 0 ? v.bits : static_cast<int>(8 * std::min(v.bytes, sizeof word));
  word >>= v.first_bit;
  if (width < 64) word &= (std::uint64_t{1} << width) - 1;
  if (v.kind == Variable::Kind::Signed && (word >> (width - 1) & 1) != 0)
    return width < 64 ? static_cast<double>(static_cast<std::int64_t>(word) - (std::int64_t{1} << width))
                      : static_cast<double>(static_cast<std::int64_t>(word));
  return static_cast<double>(word);
}

void set_variable_value(const Variable& v, char* at, double value) {
  if (v.kind == Variable::Kind::Float) {
    const float f = static_cast<float>(value);
    if (v.bytes == sizeof f) std::memcpy(at, &f, sizeof f);
    if (v.bytes == sizeof value) std::memcpy(at, &value, sizeof value);
    return;
  }
  // whole numbers wrap as the variable's width does; what no 64 bits hold becomes the nearest that they do
  const double whole = std::isnan(value) ? 0 : std::trunc(value);
  const std::uint64_t number =
      whole < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(std::max(whole, -9.2e18)))
                : static_cast<std::uint64_t>(std::min(whole, 1.8e19));
  std::uint64_t word = 0;
  const std::size_t bytes = std::min(v.bytes, sizeof word);
  std::memcpy(&word, at, bytes);
  const int width = v.bits > 0 ? v.bits : static_cast<int>(8 * bytes);
  const std::uint64_t mask = (width < 64 ? (std::uint64_t{1} << width) - 1 : ~std::uint64_t{0})
                             << v.first_bit;
  word = (word & ~mask) | (number << v.first_bit & mask);
  std::memcpy(at, &word, bytes);
}

}  // namespace host
