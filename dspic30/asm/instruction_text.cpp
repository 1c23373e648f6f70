// SPDX-License-Identifier: MIT
#include "dspic30/asm/instruction_text.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string_view>

#include "dspic30/asm/expression.h"

namespace dspic::assembly {

namespace {

constexpr std::int64_t kLastAddress = 0x7FFFFE;

std::string hex(std::int64_t value) {
  char text[32];
  std::snprintf(text, sizeof text, "%s0x%llX", value < 0 ? "-" : "",
                static_cast<unsigned long long>(std::llabs(value)));
  return text;
}

// --- reading operands

// "w12" -> 12; -1: no register
int register_number(const std::string& text) {
  if (text.size() < 2 || text.size() > 3 || (text[0] != 'w' && text[0] != 'W')) return -1;
  int n = 0;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] < '0' || text[i] > '9') return -1;
    n = 10 * n + text[i] - '0';
  }
  return n < 16 && !(text.size() == 3 && n < 10) ? n : -1;
}

std::string without_blanks(const std::string& text) {
  std::string packed;
  for (const char c : text)
    if (c != ' ' && c != '\t') packed += c;
  return packed;
}

// what stands between the brackets; false: not that
bool read_indirect(const std::string& inside, Written& out) {
  out.kind = Written::Indirect;
  const auto plain = [&](const std::string& name, unsigned mode) {
    const int n = register_number(name);
    out.mode = mode;
    out.n = static_cast<unsigned>(n);
    return n >= 0;
  };
  const std::string text = without_blanks(inside);
  const std::size_t size = text.size();
  if (plain(text, 1)) return true;
  if (size > 2 && text.compare(size - 2, 2, "--") == 0 && plain(text.substr(0, size - 2), 2)) return true;
  if (size > 2 && text.compare(size - 2, 2, "++") == 0 && plain(text.substr(0, size - 2), 3)) return true;
  if (text.compare(0, 2, "--") == 0 && plain(text.substr(2), 4)) return true;
  if (text.compare(0, 2, "++") == 0 && plain(text.substr(2), 5)) return true;
  const std::size_t sign = inside.find_first_of("+-");
  if (sign == std::string::npos || !plain(without_blanks(inside.substr(0, sign)), 6)) return false;
  const int offset = register_number(trimmed(inside.substr(sign + 1)));
  if (offset >= 0 && inside[sign] == '+') {
    out.m = static_cast<unsigned>(offset);
    return true;
  }
  out.kind = Written::IndirectLiteral;
  out.text = inside.substr(sign);
  return true;
}

Written read_operand(const std::string& text) {
  Written out;
  out.text = text;
  // Its form alone says what it is; which row it fits, fits() says.
  if (const int n = register_number(text); n >= 0) {
    out.kind = Written::Register;
    out.n = static_cast<unsigned>(n);
  } else if (lower(text) == "wreg") {
    out.kind = Written::Wreg;
  } else if (!text.empty() && text[0] == '#') {
    out.kind = Written::Immediate;
    out.text = text.substr(1);
  } else if (!text.empty() && text[0] == '[') {
    const std::size_t close = text.find(']');
    if (close == std::string::npos || !read_indirect(text.substr(1, close - 1), out)) return {};
    const std::string rest = without_blanks(text.substr(close + 1));
    if (rest.empty()) return out;
    if (out.mode != 1 || rest.size() != 3 || rest[1] != '=' || (rest[0] != '+' && rest[0] != '-') ||
        rest[2] < '0' || rest[2] > '9')
      return {};
    out.kind = Written::Stepped;
    out.step = (rest[0] == '-' ? -1 : 1) * (rest[2] - '0');
  } else if (const std::size_t star = text.find('*'); star != std::string::npos) {
    const int a = register_number(trimmed(text.substr(0, star))),
              b = register_number(trimmed(text.substr(star + 1)));
    if (a >= 0 && b >= 0) {
      out.kind = Written::Multiplied;
      out.n = static_cast<unsigned>(a);
      out.m = static_cast<unsigned>(b);
    }
  }
  return out;
}

// --- does an operand look like what the row wants?

bool is_accumulator(const Written& o) {
  return o.kind == Written::Plain && (lower(o.text) == "a" || lower(o.text) == "b");
}

bool is_pointer(const Written& o, bool y_space, unsigned& code) {
  for (code = 0; code < 16; ++code) {
    const PrefetchMode mode = prefetch_mode(code, y_space);
    if (!mode.on || mode.pointer != static_cast<int>(o.n)) continue;
    if (mode.by_index ? o.kind == Written::Indirect && o.mode == 6 && o.m == 12
                      : (mode.step == 0 && o.kind == Written::Indirect && o.mode == 1) ||
                            (o.kind == Written::Stepped && o.step == mode.step))
      return true;
  }
  return false;
}

bool is_prefetch_target(const Written& o) { return o.kind == Written::Register && o.n >= 4 && o.n <= 7; }

bool fits_prefetch(const std::vector<Written>& all, std::size_t& at, Fields& f) {
  f.i = f.j = 4;
  unsigned code;
  for (const bool y_space : {false, true}) {
    if (at >= all.size() || !is_pointer(all[at], y_space, code)) continue;
    if (at + 1 >= all.size() || !is_prefetch_target(all[at + 1])) return false;
    (y_space ? f.j : f.i) = code;
    (y_space ? f.y : f.x) = all[at + 1].n - 4;
    at += 2;
  }
  return true;
}

bool fits_write_back(const std::vector<Written>& all, std::size_t& at, Fields& f) {
  f.a = 2;
  if (at == all.size()) return true;
  const Written& o = all[at];
  if (o.n != 13) return false;
  if (o.kind == Written::Register)
    f.a = 0;
  else if (o.kind == Written::Stepped && o.step == 2)
    f.a = 1;
  else
    return false;
  ++at;
  return true;
}

bool fits_distance(const std::vector<Written>& all, std::size_t& at, Fields& f) {
  if (at + 3 > all.size() || !is_pointer(all[at], false, f.i) || !is_pointer(all[at + 1], true, f.j) ||
      !is_prefetch_target(all[at + 2]))
    return false;
  f.x = all[at + 2].n - 4;
  at += 3;
  return true;
}

bool fits_product(const Written& o, Fields& f) {
  for (f.m = 0; f.m < 7; ++f.m) {
    int a, b;
    product_registers(f.m, a, b);
    const int n = static_cast<int>(o.n), m = static_cast<int>(o.m);
    if (a && ((n == a && m == b) || (n == b && m == a))) return true;
  }
  return false;
}

bool set(unsigned& field, unsigned value) {
  field = value;
  return true;
}

// one operand; what must be evaluated is left for encode()
bool fits(Operand kind, const Written& o, Fields& f) {
  switch (kind) {
    case Operand::File:
    case Operand::FileWord:
      return o.kind == Written::Plain && !is_accumulator(o);
    case Operand::Branch:
    case Operand::Target:
    case Operand::DoEnd:
      return o.kind == Written::Plain;
    case Operand::Wreg:
      return o.kind == Written::Wreg;
    case Operand::Literal:
    case Operand::LiteralTwice:
    case Operand::FileBit:
    case Operand::Bit:
    case Operand::Shift4:
    case Operand::Shift6:
      return o.kind == Written::Immediate;
    case Operand::Wb:
      return o.kind == Written::Register && set(f.w, o.n);
    case Operand::Rs:
      return o.kind == Written::Register && set(f.s, o.n);
    case Operand::Rd:
      return o.kind == Written::Register && set(f.d, o.n);
    case Operand::RsPair:
      return o.kind == Written::Register && o.n % 2 == 0 && set(f.s, o.n / 2);
    case Operand::RdPair:
      return o.kind == Written::Register && o.n % 2 == 0 && set(f.d, o.n / 2);
    case Operand::Source:
      return (o.kind == Written::Register || (o.kind == Written::Indirect && o.mode < 6)) &&
             set(f.p, o.mode) && set(f.s, o.n);
    case Operand::Destination:
      return (o.kind == Written::Register || (o.kind == Written::Indirect && o.mode < 6)) &&
             set(f.q, o.mode) && set(f.d, o.n);
    case Operand::SourceOffset:
      if (o.kind == Written::Indirect && o.mode == 6) f.w = o.m;
      return (o.kind == Written::Register || o.kind == Written::Indirect) && set(f.g, o.mode) &&
             set(f.s, o.n);
    case Operand::DestinationOffset:
      if (o.kind == Written::Indirect && o.mode == 6) {
        if (f.g == 6 && f.w != o.m) return false;  // one Wb for both
        f.w = o.m;
      }
      return (o.kind == Written::Register || o.kind == Written::Indirect) && set(f.h, o.mode) &&
             set(f.d, o.n);
    case Operand::SourceLiteral:
      return o.kind == Written::IndirectLiteral && set(f.s, o.n);
    case Operand::DestinationLiteral:
      return o.kind == Written::IndirectLiteral && set(f.d, o.n);
    case Operand::Accumulator:
      return is_accumulator(o) && set(f.A, lower(o.text) == "b");
    case Operand::Product:
      return o.kind == Written::Multiplied && fits_product(o, f);
    case Operand::Square:
      return o.kind == Written::Multiplied && o.n == o.m && o.n >= 4 && o.n <= 7 && set(f.m, o.n - 4);
    case Operand::Dividend:
      return o.kind == Written::Register && set(f.v, o.n);
    case Operand::DividendLong:
      return o.kind == Written::Register && set(f.v, o.n) && set(f.t, o.n + 1);
    case Operand::DividendF:
      return o.kind == Written::Register && set(f.t, o.n);
    default:
      return false;
  }
}

bool fits_row(const Row& row, const std::vector<Written>& all, Choice& choice) {
  Fields& f = choice.fields;
  std::size_t at = 0;
  f.D = 1;
  for (const Operand kind : row.kinds) {
    const Written none;
    const Written& o = at < all.size() ? all[at] : none;
    bool fine = true;
    switch (kind) {
      case Operand::WregOption:
        if (at < all.size()) fine = o.kind == Written::Wreg, f.D = 0, ++at;
        break;
      case Operand::Prefetch:
        fine = fits_prefetch(all, at, f);
        break;
      case Operand::WriteBack:
        fine = fits_write_back(all, at, f);
        break;
      case Operand::Distance:
        fine = fits_distance(all, at, f);
        break;
      case Operand::Shift4:  // may be left out
        choice.operands.push_back(o.kind == Written::Immediate && at < all.size() ? o : Written{});
        if (at < all.size() && o.kind == Written::Immediate) ++at;
        continue;
      default:
        fine = at < all.size() && fits(kind, o, f);
        ++at;
    }
    if (!fine) return false;
    choice.operands.push_back(o);
  }
  return at == all.size() && (!row.legal || row.legal(f));
}

// --- mnemonics

bool takes_byte(const Row& row) {
  for (const Operand kind : row.kinds)
    if (kind == Operand::FileBit) return true;
  return row.has(&Fields::B);
}

// names of a row beside its own; the fields that the name decides
struct Candidate {
  const Row* row;
  unsigned B, Z;
  bool word_bit;  // a bit of a word in memory: 0 to 15
};

using Mnemonics = std::multimap<std::string, Candidate>;

Mnemonics make_mnemonics() {
  Mnemonics all;
  for (const Row& row : instruction_rows()) {
    const std::string name = lower(row.mnemonic);
    const bool file_bit = takes_byte(row) && !row.has(&Fields::B);
    if (row.has(&Fields::Z)) {
      all.insert({name + ".c", {&row, 0, 0, false}});
      for (const char* end : {".z", ""}) all.insert({name + end, {&row, 0, 1, false}});
      continue;
    }
    all.insert({name, {&row, 0, 0, file_bit}});
    if (name.find('.') == std::string::npos && name.find(' ') == std::string::npos)
      all.insert({name + ".w", {&row, 0, 0, file_bit}});
    if (takes_byte(row)) all.insert({name + ".b", {&row, 1, 0, false}});
    if (name == "bra c") all.insert({"bra geu", {&row, 0, 0, false}});
    if (name == "bra nc") all.insert({"bra ltu", {&row, 0, 0, false}});
    const bool is_long = row.id == Insn::Div_S_Wm_Wn_long || row.id == Insn::Div_U_Wm_Wn_long;
    if (name == "div.s" || name == "div.u") all.insert({name + (is_long ? "d" : "w"), {&row, 0, 0, false}});
  }
  for (const char* name : {"push.d", "pop.d"}) all.insert({name, {nullptr, 0, 0, false}});
  return all;
}

const Mnemonics& mnemonics() {
  static const Mnemonics all = make_mnemonics();
  return all;
}

// PUSH and POP of registers are MOV with W15, and so written in the table
void rewrite_stack(std::string& name, std::vector<Written>& operands) {
  if (operands.size() != 1 || operands[0].kind == Written::Plain) return;
  Written top;
  top.kind = Written::Indirect;
  top.n = 15;
  const std::string stem = name.substr(0, name.find('.'));
  if (stem != "push" && stem != "pop") return;
  top.mode = stem == "push" ? 3 : 4;
  operands.insert(stem == "push" ? operands.end() : operands.begin(), top);
  name = "mov" + name.substr(stem.size());
}

// "sub w3, #255" -> "sub #255, w3", as the vendor's assembler takes it
void turn_literal(const std::string& name, std::vector<Written>& operands) {
  if (operands.size() != 2 || operands[0].kind != Written::Register || operands[1].kind != Written::Immediate)
    return;
  const auto range = mnemonics().equal_range(name);
  if (std::any_of(range.first, range.second, [](const auto& c) {
        return c.second.row && std::string_view(c.second.row->operands) == "#lit10,Wn";
      }))
    std::swap(operands[0], operands[1]);
}

// "bra ltu, there" -> "bra ltu", "there"
void take_condition(std::string& name, std::vector<Written>& operands) {
  if (name != "bra" || operands.size() != 2 || operands[0].kind != Written::Plain) return;
  name += " " + lower(operands[0].text);
  operands.erase(operands.begin());
}

}  // namespace

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::string part;
  int depth = 0;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote) {
      if (c == '\\' && i + 1 < text.size())
        part += text[i++];
      else if (c == quote)
        quote = 0;
    } else if (c == '"') {
      quote = c;
    } else if (c == '\'' && i + 2 < text.size()) {
      part += text[i++];  // the character itself is no comma, nor does its closing quote open another
      if (text[i] == '\\' && i + 1 < text.size()) part += text[i++];
      if (i + 1 < text.size() && text[i + 1] == '\'') part += text[i++];
    } else if (c == '[' || c == '(') {
      ++depth;
    } else if (c == ']' || c == ')') {
      --depth;
    } else if (c == ',' && depth == 0) {
      parts.push_back(trimmed(part));
      part.clear();
      continue;
    }
    part += text[i];
  }
  if (!trimmed(part).empty() || !parts.empty()) parts.push_back(trimmed(part));
  return parts;
}

Choice choose(const std::string& mnemonic, const std::string& text, const Complaint& complain) {
  std::string name = mnemonic;
  std::vector<Written> operands;
  for (const std::string& part : split(text)) operands.push_back(read_operand(part));
  rewrite_stack(name, operands);
  take_condition(name, operands);
  turn_literal(name, operands);
  const auto range = mnemonics().equal_range(name);
  std::string forms;
  for (auto c = range.first; c != range.second; ++c) {
    if (!c->second.row) continue;
    Choice choice;
    choice.row = c->second.row;
    choice.fields.B = c->second.B;
    choice.fields.Z = c->second.Z;
    if (fits_row(*choice.row, operands, choice)) {
      choice.word_bit = c->second.word_bit;
      return choice;
    }
    forms += (forms.empty() ? "" : " | ") + std::string(choice.row->operands);
  }
  complain(forms.empty() ? "instruction: got '" + name + "', expected one of the dsPIC30F's"
                         : name + ": operands '" + text + "' fit none of: " + forms);
  return {};
}

// --- values

namespace {

class Encoder {
 public:
  Encoder(const Choice& choice, std::uint32_t address, const Value& value, const Complaint& complain)
      : choice_(choice),
        row_(*choice.row),
        f_(choice.fields),
        address_(address),
        value_(value),
        complain_(complain) {}

  std::vector<std::uint32_t> encode() {
    for (std::size_t i = 0; i < row_.kinds.size(); ++i) set(row_.kinds[i], choice_.operands[i]);
    std::vector<std::uint32_t> words{dspic::encode(row_, f_)};
    if (row_.words == 2) words.push_back(second_);
    return words;
  }

 private:
  std::int64_t ranged(const std::string& text, std::int64_t least, std::int64_t most, std::int64_t step = 1) {
    const std::int64_t v = value_(text);
    if (v < least || v > most || v % step != 0) {
      complain_(text + ": got " + hex(v) + ", expected " + hex(least) + " to " + hex(most) +
                (step > 1 ? ", even" : ""));
      return least < 0 ? 0 : least;
    }
    return v;
  }

  unsigned relative(const std::string& text, std::uint32_t next) {
    const std::int64_t target = value_(text), words = (target - static_cast<std::int64_t>(next)) / 2;
    if (target % 2 != 0 || target < 0 || target > kLastAddress)
      complain_(text + ": got " + hex(target) + ", expected an even program address");
    else if (words < -32768 || words > 32767)
      complain_(text + ": " + std::to_string(words) + " words away, expected at most 32767");
    return static_cast<unsigned>(words & 0xFFFF);
  }

  void set(Operand kind, const Written& o) {
    switch (kind) {
      case Operand::File:
        f_.f = static_cast<unsigned>(ranged(o.text, 0, 0x1FFF, is_byte() ? 1 : 2));
        break;
      case Operand::FileWord:
        f_.f = static_cast<unsigned>(ranged(o.text, 0, 0xFFFE, 2)) / 2;
        break;
      case Operand::FileBit: {
        const auto bit = static_cast<unsigned>(ranged(o.text, 0, choice_.word_bit ? 15 : 7));
        f_.f += bit / 8;
        f_.b = bit % 8;
        break;
      }
      case Operand::Bit:
        f_.b = static_cast<unsigned>(ranged(o.text, 0, f_.B ? 7 : 15));
        break;
      case Operand::Literal: {
        const auto limit = static_cast<std::int64_t>(f_.B ? std::min(255u, field_limit(row_, &Fields::k))
                                                          : field_limit(row_, &Fields::k));
        const bool may_be_negative = limit == 0xFFFF || limit == 0xFF;
        f_.k = static_cast<unsigned>(ranged(o.text, may_be_negative ? -(limit + 1) / 2 : 0, limit) & limit);
        break;
      }
      case Operand::LiteralTwice:
        f_.k = static_cast<unsigned>(ranged(o.text, 0, 0x3FFE, 2)) / 2;
        break;
      case Operand::Shift4:
        f_.r = o.text.empty() ? 0 : static_cast<unsigned>(ranged(o.text, -8, 7)) & 15;
        break;
      case Operand::Shift6:
        f_.k = static_cast<unsigned>(ranged(o.text, -16, 16)) & 63;
        break;
      case Operand::SourceLiteral:
      case Operand::DestinationLiteral:
        f_.k = static_cast<unsigned>(f_.B ? ranged(o.text, -512, 511) : ranged(o.text, -1024, 1022, 2) / 2) &
               0x3FF;
        break;
      case Operand::Branch:
        f_.n = relative(o.text, address_ + 2);
        break;
      case Operand::DoEnd:
        second_ = relative(o.text, address_ + 4);
        break;
      case Operand::Target: {
        const auto target = static_cast<std::uint32_t>(ranged(o.text, 0, kLastAddress, 2));
        f_.n = (target & 0xFFFF) / 2;
        second_ = target >> 16;
        break;
      }
      default:
        break;  // registers, known already
    }
  }

  bool is_byte() const { return f_.B || (takes_byte(row_) && !row_.has(&Fields::B) && !choice_.word_bit); }

  const Choice& choice_;
  const Row& row_;
  Fields f_;
  std::uint32_t address_;
  const Value& value_;
  const Complaint& complain_;
  std::uint32_t second_ = 0;
};

}  // namespace

std::vector<std::uint32_t> encode(const Choice& choice, std::uint32_t address, const Value& value,
                                  const Complaint& complain) {
  return Encoder(choice, address, value, complain).encode();
}

}  // namespace dspic::assembly
