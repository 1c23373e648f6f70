// SPDX-License-Identifier: MIT
#include "dspic30/asm/expression.h"

#include <cctype>
#include <cstring>

namespace dspic::assembly {

namespace {

constexpr int kDeepestParentheses = 50;  // parentheses and signs within one another
constexpr int kBinaryLevels = 10;

// operators by precedence, loosest first
constexpr const char* kOperators[kBinaryLevels][5] = {
    {"||"},       {"&&"},     {"|"},          {"^"}, {"&"}, {"==", "!="}, {"<=", ">=", "<", ">"},
    {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}};

std::int64_t wrapping(std::uint64_t value) { return static_cast<std::int64_t>(value); }

class Parser {
 public:
  Parser(const std::string& text, const Symbols& symbols, const Handles& handles)
      : at_(text.c_str()), symbols_(symbols), handles_(handles) {}

  bool parse(std::int64_t& value, std::string& error) {
    value = binary(0);
    skip();
    if (error_.empty() && *at_) fail(std::string("unexpected '") + at_ + "'");
    error = error_;
    return error_.empty();
  }

 private:
  void fail(const std::string& what) {
    if (error_.empty()) error_ = what;
  }
  void skip() {
    while (*at_ == ' ' || *at_ == '\t') ++at_;
  }
  // the operator of this level that stands here, not the beginning of a longer one
  const char* operator_at(int level) {
    skip();
    for (const char* op : kOperators[level]) {
      if (!op) break;
      const std::size_t length = std::strlen(op);
      if (std::strncmp(at_, op, length) != 0) continue;
      if (length == 1 && (at_[1] == at_[0] && std::strchr("|&<>", at_[0]))) continue;
      return op;
    }
    return nullptr;
  }

  std::int64_t binary(int level) {
    if (level == kBinaryLevels) return unary();
    std::int64_t left = binary(level + 1);
    while (error_.empty()) {
      const char* op = operator_at(level);
      if (!op) break;
      at_ += std::strlen(op);
      left = apply(op, left, binary(level + 1));
    }
    return left;
  }

  std::int64_t apply(const std::string& op, std::int64_t a, std::int64_t b) {
    const auto ua = static_cast<std::uint64_t>(a), ub = static_cast<std::uint64_t>(b);
    if (op == "||") return a || b;
    if (op == "&&") return a && b;
    if (op == "|") return a | b;
    if (op == "^") return a ^ b;
    if (op == "&") return a & b;
    if (op == "==") return a == b;
    if (op == "!=") return a != b;
    if (op == "<=") return a <= b;
    if (op == ">=") return a >= b;
    if (op == "<") return a < b;
    if (op == ">") return a > b;
    if (op == "<<") return b < 0 || b > 63 ? 0 : wrapping(ua << b);
    if (op == ">>") return b < 0 || b > 63 ? 0 : a >> b;
    if (op == "+") return wrapping(ua + ub);
    if (op == "-") return wrapping(ua - ub);
    if (op == "*") return wrapping(ua * ub);
    if (b == 0 || (b == -1 && a == INT64_MIN)) {
      fail("division by zero");
      return 0;
    }
    return op == "/" ? a / b : a % b;
  }

  std::int64_t unary() {
    skip();
    if (++depth_ > kDeepestParentheses) {
      fail("expression is nested too deeply");
      return 0;
    }
    std::int64_t value = 0;
    const char c = *at_;
    if (c == '-') {
      ++at_;
      value = wrapping(0 - static_cast<std::uint64_t>(unary()));
    } else if (c == '+') {
      ++at_;
      value = unary();
    } else if (c == '~') {
      ++at_;
      value = ~unary();
    } else if (c == '!') {
      ++at_;
      value = !unary();
    } else {
      value = primary();
    }
    --depth_;
    return value;
  }

  std::int64_t primary() {
    if (*at_ == '(') return in_parentheses();
    if (*at_ == '\'') return character();
    if (std::isdigit(static_cast<unsigned char>(*at_))) return number();
    if (begins_name(*at_)) return symbol();
    fail(*at_ ? std::string("unexpected '") + at_ + "'" : "a value is missing");
    return 0;
  }

  std::int64_t in_parentheses() {
    ++at_;
    const std::int64_t value = binary(0);
    skip();
    if (*at_ == ')')
      ++at_;
    else
      fail("')' is missing");
    return value;
  }

  std::int64_t character() {
    ++at_;
    char c = *at_;
    if (!c) {
      fail("a character is missing");
      return 0;
    }
    if (c == '\\') {
      ++at_;
      c = *at_ == 'n' ? '\n' : *at_ == 'r' ? '\r' : *at_ == 't' ? '\t' : *at_ == '0' ? '\0' : *at_;
    }
    if (*at_) ++at_;
    if (*at_ == '\'') ++at_;  // gas does not ask for it
    return static_cast<unsigned char>(c);
  }

  std::int64_t number() {
    const char* begin = at_;
    while (std::isalnum(static_cast<unsigned char>(*at_))) ++at_;
    const std::string digits = lower(std::string(begin, at_));
    if (digits.size() == 2 && (digits[1] == 'b' || digits[1] == 'f')) {
      std::int64_t value = 0;
      if (!symbols_(digits, value)) fail("there is no label " + digits.substr(0, 1) + " on that side");
      return value;
    }
    int base = 10;
    std::size_t from = 0;
    if (digits.size() > 2 && digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'b')) {
      base = digits[1] == 'x' ? 16 : 2;
      from = 2;
    } else if (digits.size() > 1 && digits[0] == '0') {
      base = 8;
      from = 1;
    }
    std::uint64_t value = 0;
    for (std::size_t i = from; i < digits.size(); ++i) {
      const char c = digits[i];
      const int digit = c >= 'a' ? c - 'a' + 10 : c - '0';
      if (digit >= base) {
        fail("'" + digits + "' is no number");
        return 0;
      }
      value = value * static_cast<std::uint64_t>(base) + static_cast<std::uint64_t>(digit);
    }
    return wrapping(value);
  }

  std::int64_t symbol() {
    const char* begin = at_;
    while (continues_name(*at_)) ++at_;
    const std::string name(begin, at_);
    skip();
    if (*at_ == '(') return function(lower(name));
    std::int64_t value = 0;
    if (!symbols_(name, value)) fail("unknown symbol '" + name + "'");
    return value;
  }

  std::int64_t function(const std::string& name) {
    if (++depth_ > kDeepestParentheses) {
      fail("expression is nested too deeply");
      return 0;
    }
    const std::int64_t x = in_parentheses();
    --depth_;
    if (name == "tblpage" || name == "hi16") return x >> 16 & (name == "tblpage" ? 0xFF : 0xFFFF);
    if (name == "tbloffset" || name == "lo16") return x & 0xFFFF;
    if (name == "psvpage") return x >> 15 & 0x1FF;
    if (name == "psvoffset") return (x | 0x8000) & 0xFFFF;
    if (name == "paddr") return x;
    if (name == "handle") return handles_(x);
    fail("unknown operator '" + name + "()'");
    return 0;
  }

  const char* at_;
  const Symbols& symbols_;
  const Handles& handles_;
  std::string error_;
  int depth_ = 0;
};

}  // namespace

bool evaluate(const std::string& text, const Symbols& symbols, const Handles& handles, std::int64_t& value,
              std::string& error) {
  return Parser(text, symbols, handles).parse(value, error);
}

bool begins_name(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '_' || c == '.' || c == '$';
}

bool continues_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)); }

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

}  // namespace dspic::assembly
