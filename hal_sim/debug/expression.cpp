// SPDX-License-Identifier: MIT
#include "hal_sim/debug/expression.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "sim_core/base/did_you_mean.h"

namespace debug {

namespace {

using ValueKind = CType::Kind;
using ImageKind = dspic::DebugInfo::Kind;

constexpr int kDeepestExpression = 40;  // brackets, signs and operators within one another
constexpr CType kInt{ValueKind::Signed, 16}, kUnsignedInt{ValueKind::Unsigned, 16},
    kDouble{ValueKind::Float, 32};

struct Operator {
  const char* text;
  int level;  // the tighter, the higher
};
// longer ones first
constexpr Operator kBinary[] = {{"<<", 8}, {">>", 8}, {"<=", 7}, {">=", 7}, {"==", 6}, {"!=", 6},
                                {"&&", 2}, {"||", 1}, {"<", 7},  {">", 7},  {"+", 9},  {"-", 9},
                                {"*", 10}, {"/", 10}, {"%", 10}, {"&", 5},  {"^", 4},  {"|", 3}};

class Expression {
 public:
  Expression(const Names& names, const std::string& text, bool is_tried)
      : names_(names), begin_(text.c_str()), at_(begin_), is_tried_(is_tried) {}

  bool run(Want want, CValue& value, std::string& error) {
    value = conditional();
    skip();
    if (ok() && *at_) fail(std::string("unexpected '") + at_ + "'");
    if (ok() && want == Want::Number) {
      truth(value);
      value = loaded(value);
    }
    error = error_;
    return ok();
  }

 private:
  bool ok() const { return error_.empty(); }
  CValue fail(const std::string& what) {
    if (ok()) error_ = what;
    return integer(kInt, 0);
  }
  /// "got 'counts[9]', WHAT": the text from `from` on.
  CValue refuse(const char* from, const std::string& what) {
    const char* end = at_;
    while (end > from && std::isspace(static_cast<unsigned char>(end[-1]))) --end;
    return fail("got '" + std::string(from, end) + "', " + what);
  }
  void skip() {
    while (std::isspace(static_cast<unsigned char>(*at_))) ++at_;
  }
  bool takes(const char* text) {
    skip();
    const std::size_t n = std::strlen(text);
    if (std::strncmp(at_, text, n) != 0) return false;
    at_ += n;
    return true;
  }
  std::string word_here() {
    skip();
    const char* end = at_;
    if (std::isalpha(static_cast<unsigned char>(*end)) || *end == '_' || *end == '$')
      while (std::isalnum(static_cast<unsigned char>(*end)) || *end == '_' || *end == '$') ++end;
    return {at_, end};
  }
  const dspic::DebugInfo& info() const { return names_.debug_info(); }

  // --- operators, from the loosest

  CValue conditional() {
    const Deeper deeper(*this);
    if (!ok()) return integer(kInt, 0);
    const CValue condition = binary(1);
    if (!ok() || !takes("?")) return condition;
    const bool holds = truth(condition);
    CValue first = without_doing(!holds, [this] { return conditional(); });
    if (ok() && !takes(":")) fail("':' is missing");
    CValue second = without_doing(holds, [this] { return conditional(); });
    if (!ok()) return first;
    first = loaded(first), second = loaded(second);
    const CValue& chosen = holds ? first : second;
    const auto is_number = [](const CValue& v) { return v.type.is_integer() || v.type.is_float(); };
    return is_number(first) && is_number(second) ? converted(chosen, common_type(first.type, second.type))
                                                 : chosen;
  }

  const Operator* operator_here() {
    skip();
    for (const Operator& o : kBinary)
      if (std::strncmp(at_, o.text, std::strlen(o.text)) == 0) return &o;
    return nullptr;
  }

  CValue binary(int level) {
    CValue left = unary();
    for (const Operator* o; ok() && (o = operator_here()) && o->level >= level;) {
      at_ += std::strlen(o->text);
      const std::string op = o->text;
      if (op == "&&" || op == "||") {
        const bool known = truth(left) == (op == "||");
        const CValue right = without_doing(known, [&] { return binary(o->level + 1); });
        if (!ok()) return left;
        left = integer(kInt, known ? op == "||" : truth(right));
      } else {
        const CValue right = binary(o->level + 1);
        if (!ok()) return left;
        left = applied(op, loaded(left), loaded(right));
      }
    }
    return left;
  }

  CValue unary() {
    const Deeper deeper(*this);
    skip();
    if (!ok()) return integer(kInt, 0);
    const char* from = at_;
    if (takes("!")) return integer(kInt, !truth(unary()));
    if (takes("+")) return negated(unary(), '+');
    if (takes("-")) return negated(unary(), '-');
    if (takes("~")) return negated(unary(), '~');
    if (takes("*")) {
      const CValue to = loaded(unary());
      return ok() ? pointed(to, from) : to;
    }
    if (at_[0] == '&' && at_[1] != '&') {
      ++at_;
      const CValue of = unary();
      return ok() ? address(of, from) : of;
    }
    if (word_here() == "sizeof") return size_of();
    if (CType type; *at_ == '(' && reads_cast(type)) {
      const CValue value = loaded(unary());
      if (!ok()) return value;
      if (value.type.kind == ValueKind::Image && value.type.stars == 0)
        return refuse(from, "expected a number or a pointer behind the cast");
      CValue cast = converted(value, type);
      if (type.stars > 0) cast.raw = cut(cast.raw, kPointerBits, false);
      return cast;
    }
    return postfix();
  }

  CValue postfix() {
    skip();
    const char* from = at_;
    CValue value = primary();
    while (ok()) {
      skip();
      if (takes("[")) {
        const CValue index = loaded(conditional());
        if (ok() && !takes("]")) fail("']' is missing");
        if (ok()) value = element(value, index, from);
      } else if (takes("->")) {
        const std::string name = member_name(from);
        const CValue to = loaded(value);
        value = ok() ? pointed(to, from) : to;
        if (ok()) value = member(value, name, from);
      } else if (*at_ == '.' && at_[1] != '.') {
        ++at_;
        value = member(value, member_name(from), from);
      } else {
        break;
      }
    }
    return value;
  }

  CValue primary() {
    if (!*at_) return fail("a value is missing");
    // What is no name.
    if (takes("(")) {
      const CValue value = conditional();
      if (ok() && !takes(")")) fail("')' is missing");
      return value;
    }
    if (*at_ == '\'') return character();
    if (std::isdigit(static_cast<unsigned char>(*at_)) ||
        (*at_ == '.' && std::isdigit(static_cast<unsigned char>(at_[1]))))
      return number();
    CValue value;
    Part part;
    if (takes_scoped(part)) return of_part(part);
    const std::string name = word_here();
    if (name.empty()) return fail(std::string("unexpected '") + at_ + "'");
    at_ += name.size();
    // A name: a variable, a constant of an enumeration, a register or a field of one.
    if (names_.find_variable("", name, part)) return of_part(part);
    if (const auto constant = info().enumerators.find(name); constant != info().enumerators.end())
      return constant_of(static_cast<std::uint64_t>(constant->second), constant->second < 0);
    // a field of a register goes by its whole name
    if (*at_ == '.') {
      const char* dot = at_++;
      const std::string field = word_here();
      if (!field.empty() && names_.find_other(name + "." + field, value)) {
        at_ += field.size();
        return value;
      }
      at_ = dot;
    }
    if (names_.find_other(name, value)) return value;
    // Nothing has this name here: who has it, or the nearest that something has, is told.
    if (const std::string function = names_.function_of(name); !function.empty())
      return fail("unknown symbol '" + name +
                  "' here, expected one that is known where the program stands; " + function + "() has one");
    std::vector<std::string> known;
    for (const auto& variable : names_.debug_info().variables) known.push_back(variable.name);
    return fail("unknown symbol '" + name + "', expected a variable of the image that is known here" +
                sim::did_you_mean_tail(name, known));
  }

  /// "main.c:count", "tick:count": of a file or a static of a function. Without spaces, unlike ? and : mostly.
  bool takes_scoped(Part& part) {
    const char* colon = at_;
    while (std::isalnum(static_cast<unsigned char>(*colon)) || (*colon && std::strchr("_$./-", *colon)))
      ++colon;
    if (*colon != ':' || colon == at_) return false;
    const std::string scope(at_, colon);
    const char* const before = std::exchange(at_, colon + 1);
    const std::string name = *at_ == ' ' ? "" : word_here();
    if (!name.empty() && names_.find_variable(scope, name, part)) {
      at_ += name.size();
      return true;
    }
    at_ = before;
    return false;
  }

  // --- constants

  CValue constant_of(std::uint64_t raw, bool is_negative = false, bool is_decimal = true,
                     bool no_sign = false, unsigned least = 16) {
    for (const unsigned bits : {16u, 32u, 64u}) {
      if (bits < least) continue;
      const std::uint64_t most = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
      if (is_negative || (!no_sign && raw <= most >> 1)) {
        if (!is_negative || cut(raw, bits, true) == raw) return integer({ValueKind::Signed, bits}, raw);
      } else if ((no_sign || !is_decimal || bits > 16) && raw <= most) {
        return integer({ValueKind::Unsigned, bits}, raw);
      }
    }
    return integer({ValueKind::Signed, 64}, raw);
  }

  CValue number() {
    const char* from = at_;
    const bool is_hex = at_[0] == '0' && (at_[1] == 'x' || at_[1] == 'X');
    const bool is_binary = at_[0] == '0' && (at_[1] == 'b' || at_[1] == 'B');
    const char* end = at_;
    // As far as it may belong to a number; a point or an exponent makes it a real one.
    bool is_real = false;
    for (; std::isalnum(static_cast<unsigned char>(*end)) || *end == '.'; ++end) {
      const bool is_exponent = !is_hex && !is_binary && (*end == 'e' || *end == 'E');
      is_real |= *end == '.' || is_exponent;
      if (is_exponent && (end[1] == '+' || end[1] == '-')) ++end;
    }
    std::string text(from, end);
    at_ = end;
    char* rest = nullptr;
    // A real number is a double, 32 bits here, unless its suffix says otherwise.
    if (is_real) {
      const double value = std::strtod(text.c_str(), &rest);
      const std::string suffix = rest;
      if (suffix == "l" || suffix == "L") return real_number({ValueKind::Float, 64}, value);
      if (suffix.empty() || suffix == "f" || suffix == "F") return real_number(kDouble, value);
      return fail("'" + text + "' is no number");
    }
    // A whole number, whose suffix says at least how wide it is.
    const bool is_octal = !is_hex && !is_binary && text[0] == '0';
    errno = 0;
    const std::uint64_t raw = std::strtoull(text.c_str() + (is_binary ? 2 : 0), &rest,
                                            is_binary  ? 2
                                            : is_octal ? 8
                                            : is_hex   ? 16
                                                       : 10);
    if (errno == ERANGE) return fail("got '" + text + "', expected a whole number of 64 bits at most");
    bool no_sign = false;
    unsigned longs = 0;
    for (const char* s = rest; *s; ++s) {
      const char c = static_cast<char>(std::tolower(static_cast<unsigned char>(*s)));
      if ((c != 'u' && c != 'l') || (c == 'u' && no_sign) || (c == 'l' && ++longs > 2))
        return fail("'" + text + "' is no number");
      no_sign |= c == 'u';
    }
    if (is_binary && rest == text.c_str() + 2) return fail("'" + text + "' is no number");
    return constant_of(raw, false, !is_hex && !is_octal && !is_binary, no_sign, 16u << longs);
  }

  CValue character() {
    ++at_;
    int c = static_cast<unsigned char>(*at_);
    if (c == '\\') {
      ++at_;
      const char* const kinds = "ntr0abfv\\'\"";
      const int values[] = {'\n', '\t', '\r', '\0', '\a', '\b', '\f', '\v', '\\', '\'', '"'};
      const char* const kind = *at_ ? std::strchr(kinds, *at_) : nullptr;
      if (*at_ == 'x') {
        char* rest = nullptr;
        c = static_cast<int>(std::strtol(at_ + 1, &rest, 16));
        at_ = rest - 1;
      } else if (kind) {
        c = values[kind - kinds];
      }
    }
    if (!*at_) return fail("a character is missing");
    ++at_;
    if (*at_ != '\'') return fail("a ' is missing");
    ++at_;
    return integer(kInt, cut(static_cast<std::uint64_t>(c), 8, true));
  }

  // --- types

  /// "(unsigned char *)": true, and it is behind that.
  bool reads_cast(CType& type) {
    const char* const before = at_;
    ++at_;
    if (reads_type(type) && takes(")")) return true;
    at_ = before;
    return false;
  }

  bool reads_type(CType& type) {
    int longs = 0, shorts = 0, chars = 0, ints = 0, floats = 0, doubles = 0;
    bool is_unsigned = false, is_signed = false, is_truth = false, is_named = false, is_void = false,
         is_any = false;
    // Words in any order, as in C, up to the first that belongs to no type.
    for (std::string word; !(word = word_here()).empty();) {
      Part variable;
      if (word == "const" || word == "volatile") {
      } else if (word == "unsigned") {
        is_unsigned = true;
      } else if (word == "signed") {
        is_signed = true;
      } else if (word == "long") {
        ++longs;
      } else if (word == "short") {
        ++shorts;
      } else if (word == "char") {
        ++chars;
      } else if (word == "int") {
        ++ints;
      } else if (word == "float") {
        ++floats;
      } else if (word == "double") {
        ++doubles;
      } else if (word == "void") {
        is_void = true;
      } else if (word == "_Bool") {
        chars = 1, is_unsigned = is_truth = true;
      } else if (!is_any && !is_named) {
        const bool is_tag = word == "struct" || word == "union" || word == "enum";
        if (!is_tag && names_.find_variable("", word, variable)) return false;
        if (is_tag) {
          at_ += word.size();
          word = word_here();
        }
        const auto known = info().named.find(is_tag ? "struct " + word : word);
        if (known == info().named.end()) return false;
        type = type_of(info(), known->second);
        is_named = true;
      } else {
        return false;
      }
      at_ += word.size();
      is_any = true;
    }
    if (!is_any) return false;
    // What those words mean together; int is what nothing else says.
    if (!is_named) {
      const ValueKind whole = is_unsigned ? ValueKind::Unsigned : ValueKind::Signed;
      if (!is_void && !(longs + shorts + chars + ints + floats + doubles) && !is_unsigned && !is_signed)
        return false;
      type = is_void             ? CType{ValueKind::Unknown, 8}
             : floats || doubles ? CType{ValueKind::Float, doubles && longs ? 64u : 32u}
             : chars             ? CType{whole, 8}
                                 : CType{whole, longs > 1 ? 64u
                                                : longs   ? 32u
                                                          : 16u};
      type.is_truth = is_truth;
    }
    // A star for each level of pointers.
    while (takes("*")) {
      ++type.stars;
      while (word_here() == "const" || word_here() == "volatile") at_ += word_here().size();
    }
    return true;
  }

  CValue size_of() {
    const char* const from = at_;
    at_ += std::strlen("sizeof");
    skip();
    CType type;
    if (*at_ != '(' || !reads_cast(type)) {
      const CValue value = without_doing(true, [this] { return unary(); });
      if (!ok()) return value;
      if (value.part && value.part->found.width > 0) return refuse(from, "but a bit-field has no size");
      if (value.part) {
        const auto& known = info().types[static_cast<std::size_t>(value.part->found.type)];
        return integer(kUnsignedInt, known.bytes);
      }
      type = value.type;
    }
    const unsigned bytes = bytes_of(type);
    return bytes ? integer(kUnsignedInt, bytes) : refuse(from, "expected something of a known type");
  }

  unsigned bytes_of(const CType& type) const {
    if (type.stars > 0) return kPointerBits / 8;
    if (type.kind == ValueKind::Image) return info().types[static_cast<std::size_t>(type.index)].bytes;
    if (type.kind == ValueKind::Unknown) return 0;
    return type.bits > 32 ? 8 : type.bits > 16 ? 4 : type.bits > 8 ? 2 : 1;
  }
  /// Of what a pointer points to; void counts as a byte.
  unsigned step_of(CType pointer) const {
    --pointer.stars;
    return std::max(1u, bytes_of(pointer));
  }

  // --- values of places

  CValue of_part(const Part& part) {
    CValue value;
    value.part = part;
    value.type = type_of(info(), part.found.type);
    if (part.found.width > 0) value.type.bits = static_cast<unsigned>(part.found.width);
    return value;
  }

  /// An array becomes a pointer, what lies somewhere its value.
  CValue loaded(const CValue& place) {
    if (!ok() || (!place.part && !place.data)) return place;
    CValue value;
    value.type = place.type;
    // An array gives the address of its first element.
    if (place.part && place.type.kind == ValueKind::Image && place.type.stars == 0) {
      const auto& type = info().types[static_cast<std::size_t>(place.type.index)];
      if (type.kind != ImageKind::Array) return place;  // a struct stays one
      const auto at = names_.address_of(*place.part);
      value.type = type_of(info(), type.element);
      ++value.type.stars;
      value.raw = at.value_or(0);
      return at || is_skipped_ ? value
                               : fail("an array that the optimiser keeps nowhere here has no address");
    }
    // Anything else gives what stands there, as a value of its type.
    std::optional<std::uint64_t> raw =
        place.part ? names_.raw_value(*place.part) : names_.raw_value(*place.data);
    if (!raw && is_skipped_) raw = 0;
    if (!raw)
      return fail("got '" + std::string(begin_) + "', expected something that has a value here" +
                  (place.part ? "; the optimiser keeps part of it nowhere" : ""));
    if (value.type.is_float()) {
      if (value.type.bits == 64) {
        std::memcpy(&value.real, &*raw, sizeof value.real);
      } else {
        float number;
        std::memcpy(&number, &*raw, sizeof number);
        value.real = static_cast<double>(number);
      }
    } else {
      value.raw =
          value.type.stars > 0 ? *raw : cut(*raw, value.type.bits, value.type.kind == ValueKind::Signed);
    }
    return value;
  }

  bool truth(const CValue& place) {
    const CValue value = loaded(place);
    if (ok() && value.type.kind == ValueKind::Image && value.type.stars == 0)
      fail("got '" + std::string(begin_) + "', expected a number or a pointer, not a struct");
    return value.is_true();
  }

  CValue pointed(const CValue& to, const char* from) {
    if (to.type.stars == 0) return refuse(from, "expected a pointer to something of a known type");
    CType type = to.type;
    --type.stars;
    if (bytes_of(type) == 0) return refuse(from, "expected a pointer to something of a known type");
    CValue value;
    value.type = type;
    if (type.stars == 0 && type.kind == ValueKind::Image) {
      Part part;
      part.found.type = type.index;
      part.pointed = to.raw;
      value.part = part;
    } else {
      value.data = Data{cut(to.raw, kPointerBits, false), bytes_of(type)};
    }
    return value;
  }

  CValue address(const CValue& of, const char* from) {
    CValue value;
    value.type = of.type;
    ++value.type.stars;
    const bool is_field = of.part ? of.part->found.width > 0 : of.data && of.data->width > 0;
    std::optional<Address> at;
    if (of.part)
      at = names_.address_of(*of.part);
    else if (of.data)
      at = of.data->address;
    if (!at || is_field) return refuse(from, "expected something that has an address here");
    value.raw = *at;
    return value;
  }

  CValue element(const CValue& of, const CValue& index, const char* from) {
    if (!index.type.is_integer()) return refuse(from, "expected a whole number in [ ]");
    if (of.part && of.type.kind == ValueKind::Image && of.type.stars == 0) {
      Part part = *of.part;
      std::string error;
      const std::string step = "[" + std::to_string(static_cast<std::int64_t>(index.raw)) + "]";
      if (!info().follow(step, part.found, error)) return refuse(from, error);
      return of_part(part);
    }
    CValue pointer = loaded(of);
    if (!ok()) return pointer;
    if (pointer.type.stars == 0) return refuse(from, "expected a pointer to something of a known type");
    pointer = moved(pointer, static_cast<std::int64_t>(index.raw));
    return pointed(pointer, from);
  }

  std::string member_name(const char* from) {
    std::string name = word_here();
    if (name.empty()) refuse(from, "expected a member's name behind it");
    at_ += name.size();
    return name;
  }

  CValue member(const CValue& of, const std::string& name, const char* from) {
    if (!ok()) return of;
    if (!of.part) return refuse(from, "no member '" + name + "' in it");
    Part part = *of.part;
    std::string error;
    if (!info().follow("." + name, part.found, error)) return refuse(from, error);
    return of_part(part);
  }

  // --- arithmetic

  CValue moved(CValue pointer, std::int64_t by) {
    const std::uint64_t way = static_cast<std::uint64_t>(by) * step_of(pointer.type);
    pointer.raw = cut(pointer.raw + way, kPointerBits, false);
    pointer.part.reset();
    pointer.data.reset();
    return pointer;
  }

  CValue negated(const CValue& place, char op) {
    const CValue value = loaded(place);
    if (!ok()) return value;
    if (value.type.is_float() && op != '~')
      return real_number(value.type, op == '-' ? -value.real : value.real);
    if (!value.type.is_integer()) return fail(std::string("a number is missing behind the ") + op);
    const CType type = promoted(value.type);
    return integer(type, op == '-' ? 0 - value.raw : op == '~' ? ~value.raw : value.raw);
  }

  CValue applied(const std::string& op, const CValue& a, const CValue& b) {
    if (!ok()) return a;
    // Operands have to be numbers or pointers.
    const bool first = a.type.stars > 0, second = b.type.stars > 0;
    const bool compares = op == "==" || op == "!=" || op == "<" || op == ">" || op == "<=" || op == ">=";
    const auto is_number = [](const CValue& v) { return v.type.is_integer() || v.type.is_float(); };
    if ((!first && !is_number(a)) || (!second && !is_number(b)))
      return fail("got '" + std::string(begin_) + "', expected numbers or pointers beside '" + op + "'");
    // | second)|Pointers can be compared, moved and subtracted, in units of what they point to.
    if (first || second) {
      if (compares) return integer(kInt, compared(op, a.raw, b.raw));
      if (op == "+" && first != second)
        return first ? moved(a, static_cast<std::int64_t>(b.raw))
                     : moved(b, static_cast<std::int64_t>(a.raw));
      if (op == "-" && first && !second) return moved(a, -static_cast<std::int64_t>(b.raw));
      if (op == "-" && first && second)
        return integer(kInt, static_cast<std::uint64_t>(
                                 static_cast<std::int64_t>(cut(a.raw - b.raw, kPointerBits, true)) /
                                 static_cast<std::int64_t>(step_of(a.type))));
      return fail("got '" + std::string(begin_) + "', expected numbers beside '" + op + "'");
    }
    if (op == "<<" || op == ">>") return shifted(op, a, b);
    // Numbers are first made of one type, by C's rules.
    const CType type = common_type(a.type, b.type);
    const CValue x = converted(a, type), y = converted(b, type);
    if (type.is_float()) {
      if (compares) return integer(kInt, compared(op, x.real, y.real));
      if (op == "+") return real_number(type, x.real + y.real);
      if (op == "-") return real_number(type, x.real - y.real);
      if (op == "*") return real_number(type, x.real * y.real);
      if (op == "/") return real_number(type, x.real / y.real);
      return fail("got '" + std::string(begin_) + "', expected whole numbers beside '" + op + "'");
    }
    const bool is_signed = type.kind == ValueKind::Signed;
    if (compares)
      return integer(
          kInt, is_signed ? compared(op, static_cast<std::int64_t>(x.raw), static_cast<std::int64_t>(y.raw))
                          : compared(op, x.raw, y.raw));
    if (op == "+") return integer(type, x.raw + y.raw);
    if (op == "-") return integer(type, x.raw - y.raw);
    if (op == "*") return integer(type, x.raw * y.raw);
    if (op == "&") return integer(type, x.raw & y.raw);
    if (op == "|") return integer(type, x.raw | y.raw);
    if (op == "^") return integer(type, x.raw ^ y.raw);
    return divided(op, type, x.raw, y.raw);
  }

  CValue divided(const std::string& op, CType type, std::uint64_t x, std::uint64_t y) {
    const bool wants_rest = op == "%";
    if (y == 0) return is_skipped_ || is_tried_ ? integer(type, 0) : fail("division by zero");
    if (type.kind == ValueKind::Unsigned) return integer(type, wants_rest ? x % y : x / y);
    const auto a = static_cast<std::int64_t>(x), b = static_cast<std::int64_t>(y);
    if (b == -1) return integer(type, wants_rest ? 0 : 0 - x);  // the least number has no opposite
    return integer(type, static_cast<std::uint64_t>(wants_rest ? a % b : a / b));
  }

  /// The type is the first operand's alone.
  CValue shifted(const std::string& op, const CValue& a, const CValue& b) {
    if (!a.type.is_integer() || !b.type.is_integer())
      return fail("got '" + std::string(begin_) + "', expected whole numbers beside '" + op + "'");
    const CType type = promoted(a.type);
    const std::uint64_t x = cut(a.raw, type.bits, type.kind == ValueKind::Signed);
    if (b.raw >= 64)
      return integer(type, op == ">>" && static_cast<std::int64_t>(x) < 0 ? ~std::uint64_t{0} : 0);
    if (op == "<<") return integer(type, x << b.raw);
    return integer(type, type.kind == ValueKind::Signed
                             ? static_cast<std::uint64_t>(static_cast<std::int64_t>(x) >> b.raw)
                             : x >> b.raw);
  }

  template <typename Number>
  static bool compared(const std::string& op, Number a, Number b) {
    return op == "=="   ? a == b
           : op == "!=" ? a != b
           : op == "<"  ? a < b
           : op == ">"  ? a > b
           : op == "<=" ? a <= b
                        : a >= b;
  }

  /// Reads on; values that C would not look at are not looked for.
  template <typename Read>
  CValue without_doing(bool is_skipped, const Read& read) {
    const bool before = is_skipped_;
    is_skipped_ = before || is_skipped;
    const CValue value = read();
    is_skipped_ = before;
    return value;
  }

  struct Deeper {
    explicit Deeper(Expression& of) : e(of) {
      if (++e.depth_ > kDeepestExpression) e.fail("the expression is nested too deeply");
    }
    ~Deeper() { --e.depth_; }
    Deeper(const Deeper&) = delete;
    Expression& e;
  };

  const Names& names_;
  const char* begin_;
  const char* at_;
  const bool is_tried_;
  bool is_skipped_ = false;
  int depth_ = 0;
  std::string error_;
};

}  // namespace

bool compute(const Names& names, const std::string& text, Want want, bool is_tried, CValue& value,
             std::string& error) {
  return Expression(names, text, is_tried).run(want, value, error);
}

}  // namespace debug
