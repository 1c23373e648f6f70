// SPDX-License-Identifier: MIT
#include "dspic30/load/debug_info.h"

#include <cstdlib>
#include <mutex>

#include "dspic30/load/cursor.h"
#include "dspic30/load/dwarf.h"

namespace dspic {

namespace {

using namespace dwarf;

constexpr int kDeepest = 64;

struct Value {
  unsigned form = 0;
  std::uint32_t number = 0;
  std::string text;
  DebugInfo::Section block;
};
/// One entry: its tag, attributes, and the entries in it.
struct Entry {
  unsigned tag = 0;
  std::map<unsigned, Value> attributes;
  std::vector<std::uint32_t> inner;  // offsets
  const Value* find(unsigned attribute) const {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? nullptr : &found->second;
  }
  std::uint32_t number(unsigned attribute, std::uint32_t otherwise = 0) const {
    const Value* const value = find(attribute);
    return value ? value->number : otherwise;
  }
};

class Reader {
 public:
  Reader(DebugInfo& out, const std::map<std::string, DebugInfo::Section>& sections)
      : out_(out), sections_(sections) {}

  void read() {
    each_unit([&](std::uint32_t unit, Cursor& c) { read_unit(unit, c); });
  }
  std::map<std::uint32_t, std::string> folders() {
    std::map<std::uint32_t, std::string> all;
    each_unit([&](std::uint32_t unit, Cursor& c) {
      const Entry* top = read_entries(unit, c, true);
      const Value *const lines = top ? top->find(kStatements) : nullptr, *const folder =
                                                                             top ? top->find(kCompileFolder)
                                                                                 : nullptr;
      if (lines && folder) all[lines->number] = folder->text;
    });
    return all;
  }

 private:
  template <class Visit>
  void each_unit(const Visit& visit) {
    const DebugInfo::Section info = section(".debug_info");
    Cursor all(info.bytes, info.size);
    while (all.left() > 11) {
      const auto unit = static_cast<std::uint32_t>(info.size - all.left());
      const std::uint32_t length = all.number(4);
      if (length < 7 || length > all.left()) return;
      Cursor inner = all.part(length);
      visit(unit, inner);
    }
  }

  struct Shape {
    unsigned tag = 0;
    bool has_inner = false;
    std::vector<std::pair<unsigned, unsigned>> attributes;
  };

  DebugInfo::Section section(const char* name) const {
    const auto found = sections_.find(name);
    return found == sections_.end() ? DebugInfo::Section{} : found->second;
  }
  Cursor at(const char* name, std::uint32_t offset) const {
    const DebugInfo::Section s = section(name);
    return offset < s.size ? Cursor(s.bytes + offset, s.size - offset) : Cursor(nullptr, 0);
  }

  std::map<unsigned, Shape> shapes(std::uint32_t offset) const {
    std::map<unsigned, Shape> all;
    Cursor c = at(".debug_abbrev", offset);
    while (const std::uint32_t code = c.leb()) {
      Shape& shape = all[code];
      shape.tag = c.leb();
      shape.has_inner = c.byte() != 0;
      shape.attributes.clear();
      while (!c.is_at_end()) {
        const unsigned attribute = c.leb(), form = c.leb();
        if (!attribute && !form) break;
        shape.attributes.emplace_back(attribute, form);
      }
    }
    return all;
  }

  bool read_value(Cursor& c, unsigned form, Value& v) const {
    v.form = form;
    const auto block = [&](std::size_t size) {
      v.block.bytes = c.here();
      v.block.size = std::min(size, c.left());
      c.part(size);
    };
    switch (form) {
      case kAddr:
        v.number = c.number(address_bytes_);
        return true;
      case kData1:
      case kFlag:
      case kRef1:
        v.number = c.number(1);
        break;
      case kData2:
      case kRef2:
        v.number = c.number(2);
        break;
      case kData4:
      case kRef4:
      case kSecOffset:
      case kRefAddr:
        v.number = c.number(4);
        break;
      case kData8:
      case kRef8:
        v.number = c.number(8);
        break;
      case kSdata:
        v.number = static_cast<std::uint32_t>(c.signed_leb());
        return true;
      case kUdata:
      case kRefUdata:
        v.number = c.leb();
        break;
      case kFlagPresent:
        v.number = 1;
        return true;
      case kString:
        v.text = c.text();
        return true;
      case kStrp:
        v.text = at(".debug_str", c.number(4)).text();
        return true;
      case kBlock1:
        block(c.number(1));
        return true;
      case kBlock2:
        block(c.number(2));
        return true;
      case kBlock4:
        block(c.number(4));
        return true;
      case kBlock:
      case kExprloc:
        block(c.leb());
        return true;
      default:
        return false;
    }
    // references within a unit count from its beginning
    if (form == kRef1 || form == kRef2 || form == kRef4 || form == kRef8 || form == kRefUdata)
      v.number += unit_;
    return true;
  }

  /// All of a unit, or its first alone; null: it is none that can be read.
  const Entry* read_entries(std::uint32_t unit, Cursor& c, bool first_alone) {
    const std::size_t all = c.left() + 4;
    unit_ = unit;
    const unsigned version = c.number(2);
    if (version < 2 || version > 4) return nullptr;
    const auto known = shapes(c.number(4));
    address_bytes_ = c.byte();
    entries_.clear();
    std::vector<std::uint32_t> open;  // entries that are not ended
    std::uint32_t first = 0;
    while (!c.is_at_end()) {
      const auto offset = static_cast<std::uint32_t>(unit + all - c.left());
      const std::uint32_t code = c.leb();
      if (code == 0) {
        if (!open.empty()) open.pop_back();
        continue;
      }
      const auto shape = known.find(code);
      if (shape == known.end() || open.size() > kDeepest) break;
      Entry& entry = entries_[offset];
      entry.tag = shape->second.tag;
      if (!open.empty()) entries_[open.back()].inner.push_back(offset);
      if (!first) first = offset;
      for (const auto& [attribute, form] : shape->second.attributes)
        if (!read_value(c, form, entry.attributes[attribute])) return nullptr;
      if (first_alone) break;
      if (shape->second.has_inner) open.push_back(offset);
    }
    const auto top = entries_.find(first);
    return top == entries_.end() || top->second.tag != kCompileUnit ? nullptr : &top->second;
  }

  void read_unit(std::uint32_t unit, Cursor& c) {
    const Entry* const top = read_entries(unit, c, false);
    types_.clear();
    points_.clear();
    functions_.clear();
    if (!top) return;
    if (const Value* name = top->find(kName)) file_ = name->text;
    low_ = 2 * (top->number(kLowPc) / 2);
    lines_ = top->number(kStatements);
    scope(*top, 0, 0, 14, 0);
    for (std::size_t i = 0; i < points_.size(); ++i) {  // what they point to may hold more of them
      const auto [pointer, offset] = points_[i];
      const int to = type_of(entries_.at(offset));
      out_.types[static_cast<std::size_t>(pointer)].element = to;
    }
  }

  // --- types

  int type_of(const Entry& entry, int depth = 0) {
    const Value* const type = entry.find(kType);
    return type ? type_at(type->number, depth) : 0;
  }

  int type_at(std::uint32_t offset, int depth) {
    if (const auto known = types_.find(offset); known != types_.end()) return known->second;
    const auto found = entries_.find(offset);
    if (found == entries_.end() || depth > kDeepest) return 0;
    types_[offset] = 0;  // while it is being read
    const Entry& entry = found->second;
    DebugInfo::Type type;
    type.bytes = entry.number(kByteSize);
    switch (entry.tag) {
      case kTypedef:
      case kConstType:
      case kVolatileType:
        return types_[offset] = type_of(entry, depth + 1);
      case kBaseType: {
        const unsigned encoding = entry.number(kEncoding);
        type.kind = encoding == kFloatEncoding                               ? DebugInfo::Kind::Float
                    : encoding == kSignedEncoding || encoding == kSignedChar ? DebugInfo::Kind::Signed
                                                                             : DebugInfo::Kind::Unsigned;
        break;
      }
      case kEnumerationType:
        type.kind = add_enumerators(entry) ? DebugInfo::Kind::Signed : DebugInfo::Kind::Unsigned;
        if (!type.bytes) type.bytes = 2;
        break;
      case kPointerType:
        type.kind = DebugInfo::Kind::Pointer;
        type.bytes = address_bytes_ == 8 ? 8 : 2;  // the chip's are words, whatever addresses of code are
        points_.emplace_back(add(std::move(type)), offset);
        return types_[offset] = points_.back().first;
      case kArrayType:
        return types_[offset] = array(entry, depth);
      case kStructureType:
      case kUnionType:
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
    for (const std::uint32_t offset : entry.inner) {
      const Entry& inner = entries_.at(offset);
      const Value *const name = inner.find(kName), *const value = inner.find(kConstValue);
      if (inner.tag != kEnumerator || !name || !value) continue;
      const auto number = static_cast<std::int32_t>(value->number);
      has_negative |= number < 0;
      out_.enumerators.emplace(name->text, number);
    }
    return has_negative;
  }

  /// For casts; the first of a name counts.
  void note_name(const Entry& entry, std::uint32_t offset) {
    const Value* const name = entry.find(kName);
    if (!name || name->text.empty() || entry.number(kDeclaration)) return;
    out_.named.emplace((entry.tag == kTypedef ? "" : "struct ") + name->text, type_at(offset, 0));
  }

  int add(DebugInfo::Type&& type) {
    out_.types.push_back(std::move(type));
    return static_cast<int>(out_.types.size()) - 1;
  }

  int array(const Entry& entry, int depth) {
    std::vector<unsigned> counts;
    for (const std::uint32_t offset : entry.inner) {
      const Entry& range = entries_.at(offset);
      if (range.tag != kSubrangeType) continue;
      counts.push_back(range.find(kCountOf)      ? range.number(kCountOf)
                       : range.find(kUpperBound) ? range.number(kUpperBound) + 1
                                                 : 0);
    }
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
    for (const std::uint32_t offset : entry.inner) {
      const Entry& inner = entries_.at(offset);
      if (inner.tag != kMember) continue;
      DebugInfo::Member member;
      if (const Value* name = inner.find(kName)) member.name = name->text;
      member.type = type_of(inner, depth + 1);
      if (const Value* at = inner.find(kDataMemberLocation)) {
        Cursor c(at->block.bytes, at->block.size);
        member.offset = !at->block.bytes ? at->number : c.byte() == kOpPlusConst ? c.leb() : 0;
      }
      if ((member.width = static_cast<int>(inner.number(kBitSize)))) {
        const unsigned unit = std::max(1u, out_.types[static_cast<std::size_t>(member.type)].bytes);
        if (const Value* bit = inner.find(kDataBitOffset)) {
          member.offset = bit->number / (8 * unit) * unit;
          member.bit = static_cast<int>(bit->number % (8 * unit));
        } else {  // DWARF 2 counts from the highest bit of the storage unit
          member.bit = static_cast<int>(8 * unit - inner.number(kBitOffset)) - member.width;
        }
      }
      type.members.push_back(std::move(member));
    }
  }

  // --- variables

  // `begin` to `end`: code of the innermost function or block; end 0: of none
  void scope(const Entry& entry, std::uint32_t begin, std::uint32_t end, int frame, int depth) {
    if (depth > kDeepest) return;
    for (const std::uint32_t offset : entry.inner) {
      const Entry& inner = entries_.at(offset);
      std::uint32_t from = begin, to = end;
      switch (inner.tag) {
        case kTypedef:
        case kStructureType:
        case kUnionType:
        case kEnumerationType:
          note_name(inner, offset);
          break;
        case kVariable:
        case kFormalParameter:
          add_variable(inner, begin, end, frame);
          break;
        case kSubprogram:
        case kLexicalBlock:
        case kInlinedSubroutine:
          // its code begins here; the end is an address, or a length
          if (const Value* low = inner.find(kLowPc)) {
            from = low->number;
            const Value* const high = inner.find(kHighPc);
            to = !high ? from : high->form == kAddr ? high->number : from + high->number;
          } else if (inner.tag == kSubprogram) {
            to = from = 1;  // only its statics are somewhere
          }
          if (inner.tag != kLexicalBlock) note_function(inner, offset, from, to);
          scope(inner, from, to, inner.tag == kSubprogram ? frame_of(inner) : frame, depth + 1);
          break;
        default:
          break;
      }
    }
  }

  /// What both an entry of a function and those of its copies refer to.
  std::uint32_t origin_of(const Entry& entry, std::uint32_t offset) const {
    for (const unsigned link : {kAbstractOrigin, kSpecification})
      if (const Value* to = entry.find(link)) return to->number;
    return offset;
  }

  void note_function(const Entry& entry, std::uint32_t offset, std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t origin = origin_of(entry, offset);
    const auto about = entries_.find(origin);
    const Value* const name = about == entries_.end() ? nullptr : about->second.find(kName);
    if (!name || about->second.number(kDeclaration)) return;
    const auto [known, is_new] = functions_.emplace(origin, out_.functions.size());
    if (is_new) {
      out_.functions.emplace_back();
      out_.functions.back().name = name->text;
      out_.functions.back().unit = lines_;
      out_.functions.back().file = about->second.number(kDeclaredFile);
      out_.functions.back().line = static_cast<int>(about->second.number(kDeclaredLine));
    }
    DebugInfo::Function& function = out_.functions[known->second];
    if (inlined_begin(entry, begin))
      function.inlined_at.push_back(begin);
    else if (entry.tag == kSubprogram && entry.find(kLowPc) && begin == 0)
      function.is_left_out = true;
    else if (entry.tag == kSubprogram && entry.find(kLowPc))
      function.begin = begin, function.end = end;
  }

  /// The first address of a copy in another function; false: it is no copy, or has no code.
  bool inlined_begin(const Entry& entry, std::uint32_t& begin) const {
    if (entry.tag != kInlinedSubroutine) return false;
    if (entry.find(kLowPc)) return begin != 0;
    const Value* const ranges = entry.find(kRanges);
    if (!ranges) return false;
    Cursor c = at(".debug_ranges", ranges->number);
    begin = low_ + c.number(address_bytes_);
    return begin != 0;
  }

  int frame_of(const Entry& function) const {
    const Value* const base = function.find(kFrameBase);
    if (!base || !base->block.size) return 14;
    const unsigned operation = base->block.bytes[0];
    return operation >= kOpReg0 && operation < kOpReg0 + 16     ? static_cast<int>(operation - kOpReg0)
           : operation >= kOpBreg0 && operation < kOpBreg0 + 16 ? static_cast<int>(operation - kOpBreg0)
                                                                : 14;
  }

  void add_variable(const Entry& entry, std::uint32_t begin, std::uint32_t end, int frame) {
    const Entry* about = &entry;  // where its name and type are
    for (const unsigned link : {kAbstractOrigin, kSpecification})
      if (const Value* to = entry.find(link))
        if (const auto found = entries_.find(to->number); found != entries_.end()) about = &found->second;
    const Value *const name = about->find(kName), *const location = entry.find(kLocation);
    if (!name || name->text.empty() || entry.number(kDeclaration)) return;
    DebugInfo::Variable v;
    v.name = name->text;
    v.file = file_;
    v.type = type_of(*about);
    v.begin = begin;
    v.end = end;
    v.is_static = false;
    DebugInfo::Place place;
    if (const Value* constant = entry.find(kConstValue)) {
      place.in = DebugInfo::Place::In::Value;
      place.value = static_cast<int>(constant->number);
      v.places.push_back(place);
    } else if (location && location->block.bytes) {
      if (!read_place(location->block, frame, place)) return;
      if (place.in == DebugInfo::Place::In::Memory && place.value == 0) return;  // the linker left it out
      v.is_static = place.in == DebugInfo::Place::In::Memory;
      v.places.push_back(place);
    } else if (location) {
      add_places(at(".debug_loc", location->number), frame, v);
    }
    if (!v.is_static && end <= begin) return;
    if (!v.places.empty()) out_.variables.push_back(std::move(v));
  }

  void add_places(Cursor c, int frame, DebugInfo::Variable& v) const {
    const std::uint32_t base_mark = address_bytes_ == 2 ? 0xFFFF : 0xFFFFFFFF;
    std::uint32_t base = low_;
    while (c.left() >= 2 * address_bytes_ && v.places.size() < 1000) {
      DebugInfo::Place place;
      place.begin = c.number(address_bytes_);
      place.end = c.number(address_bytes_);
      if (!place.begin && !place.end) return;
      if (place.begin == base_mark) {
        base = place.end;
        continue;
      }
      const std::size_t size = c.number(2);
      const DebugInfo::Section expression{c.here(), std::min(size, c.left())};
      c.part(size);
      place.begin += base;
      place.end += base;
      if (read_place(expression, frame, place)) v.places.push_back(place);
    }
  }

  // of one operation, but for a value
  bool read_place(DebugInfo::Section expression, int frame, DebugInfo::Place& place) const {
    using In = DebugInfo::Place::In;
    Cursor c(expression.bytes, expression.size);
    const unsigned operation = c.byte();
    if (operation == kOpAddr) {
      place.in = In::Memory;
      place.value = static_cast<int>(c.number(address_bytes_));
    } else if (operation >= kOpReg0 && operation < kOpReg0 + 16) {
      place.in = In::Register;
      place.value = static_cast<int>(operation - kOpReg0);
    } else if (operation == kOpFbreg || (operation >= kOpBreg0 && operation < kOpBreg0 + 16)) {
      place.in = In::Frame;
      place.base = operation == kOpFbreg ? frame : static_cast<int>(operation - kOpBreg0);
      place.value = c.signed_leb();
    } else {
      place.in = In::Value;
      if (operation >= kOpLit0 && operation < kOpLit0 + 32)
        place.value = static_cast<int>(operation - kOpLit0);
      else if (operation >= kOpConst1u && operation < kOpConst1u + 6)
        place.value = static_cast<int>(c.number(std::size_t{1} << (operation - kOpConst1u) / 2));
      else if (operation == kOpConsts)
        place.value = c.signed_leb();
      else if (operation == kOpConstu)
        place.value = static_cast<int>(c.leb());
      else
        return false;
      return c.byte() == kOpStackValue;
    }
    return c.is_at_end();
  }

  DebugInfo& out_;
  const std::map<std::string, DebugInfo::Section>& sections_;
  std::map<std::uint32_t, Entry> entries_;  // of the unit
  std::map<std::uint32_t, int> types_;
  std::map<std::uint32_t, std::size_t> functions_;     // of the unit, in out_
  std::vector<std::pair<int, std::uint32_t>> points_;  // pointers, and their entries
  std::string file_;
  std::uint32_t unit_ = 0, low_ = 0, lines_ = 0;
  std::size_t address_bytes_ = 4;
};

bool is_in(const DebugInfo::Variable& v, std::uint32_t pc) { return pc >= v.begin && pc < v.end; }

}  // namespace

void DebugInfo::add(const std::map<std::string, Section>& sections) { Reader(*this, sections).read(); }

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

std::map<std::uint32_t, std::string> DebugInfo::folders_in(const std::map<std::string, Section>& sections) {
  DebugInfo none;
  return Reader(none, sections).folders();
}

struct LateDebugInfo::Kept {
  std::map<std::string, std::string> bytes;
  std::once_flag read;
  DebugInfo info;
};

void LateDebugInfo::keep(const std::map<std::string, DebugInfo::Section>& sections) {
  kept_ = std::make_shared<Kept>();
  for (const auto& [name, section] : sections)
    if (name != ".debug_line" && name != ".debug_frame")
      kept_->bytes[name].assign(reinterpret_cast<const char*>(section.bytes), section.size);
}

const DebugInfo& LateDebugInfo::info() const {
  static const DebugInfo none;
  if (!kept_) return none;
  std::call_once(kept_->read, [this] {
    std::map<std::string, DebugInfo::Section> sections;
    for (const auto& [name, bytes] : kept_->bytes)
      sections[name] = {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()};
    kept_->info.add(sections);
    kept_->bytes.clear();
  });
  return kept_->info;
}

}  // namespace dspic
