// SPDX-License-Identifier: MIT
#include "hal_sim/signals/condition.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <muParserDLL.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <stdexcept>
#include <vector>

#include "hal_sim/signals/signals.h"
#include "sim_core/base/did_you_mean.h"

namespace signals {

namespace {

constexpr std::size_t kLongest = 4000;  // characters of a condition
constexpr int kDeepest = 60;            // brackets within one another

// of muParser's own functions those whose meaning is plain, and ours
constexpr const char* kFunctions[] = {"abs",  "min", "max",   "sqrt",  "exp",  "ln",   "log10",
                                      "sin",  "cos", "tan",   "asin",  "acos", "atan", "atan2",
                                      "sign", "mod", "hypot", "floor", "ceil", "round"};

double not_of(double value) { return value == 0 ? 1 : 0; }
double floor_of(double value) { return std::floor(value); }
double ceil_of(double value) { return std::ceil(value); }
double round_of(double value) { return std::round(value); }
double mod_of(double a, double b) { return std::fmod(a, b); }
double hypot_of(double a, double b) { return std::hypot(a, b); }

bool begins_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool is_in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

struct Condition::Formula {
  struct Release {
    void operator()(void* parser) const { mupRelease(parser); }
  };
  std::unique_ptr<void, Release> parser{mupCreate(muBASETYPE_FLOAT)};
  std::vector<std::string> names;  // as written, with the robot's
  std::vector<Named> signals;
  mutable std::deque<double> values;  // muParser keeps their places
};

namespace {

/// Turns the text into one that muParser reads: names become s0, s1 ...
class Translation {
 public:
  Translation(const std::string& text, twin::Twin& twin, int robot)
      : text_(text), twin_(twin), robot_(robot) {}

  std::string made;                // for muParser
  std::vector<std::string> names;  // s0, s1 ... as written
  std::vector<Named> signals;

  void run() {
    while (at_ < text_.size()) step();
  }

 private:
  [[noreturn]] static void refuse(const std::string& what) { throw std::runtime_error(what); }
  char here(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  void step() {
    const char c = here();
    if (std::isspace(static_cast<unsigned char>(c))) {
      made += ' ';
      ++at_;
    } else if (std::isdigit(static_cast<unsigned char>(c)) ||
               (c == '.' && std::isdigit(static_cast<unsigned char>(here(1))))) {
      number();
    } else if (c == '\'' || c == '"') {
      quoted();
    } else if (c == '$') {
      signal(robot_, "");
    } else if (const int robot = robot_here(); robot >= 0) {
      const std::string& name = twin_.world().robots[static_cast<std::size_t>(robot)].name;
      at_ += name.size() + 1;
      signal(robot, name + ".");
    } else if (begins_word(c)) {
      word();
    } else {
      sign();
    }
  }

  void number() {
    if (here() == '0' && (here(1) == 'x' || here(1) == 'X')) {
      char* end = nullptr;
      const auto value = std::strtoull(text_.c_str() + at_, &end, 16);
      made += std::to_string(value);
      at_ = static_cast<std::size_t>(end - text_.c_str());
    } else {
      const std::size_t begin = at_;
      while (std::isdigit(static_cast<unsigned char>(here())) || here() == '.') ++at_;
      const std::size_t sign = here(1) == '+' || here(1) == '-' ? 2 : 1;
      if ((here() == 'e' || here() == 'E') && std::isdigit(static_cast<unsigned char>(here(sign)))) {
        at_ += sign;
        while (std::isdigit(static_cast<unsigned char>(here()))) ++at_;
      }
      made += text_.substr(begin, at_ - begin);
    }
    if (is_in_word(here())) {
      std::size_t end = at_;
      while (end < text_.size() && is_in_word(text_[end])) ++end;
      refuse(fmt::format("got '{}' behind a number, expected an operator; units are part of the names",
                         text_.substr(at_, end - at_)));
    }
  }

  /// A robot of which no name is part of another word.
  int robot_here() const {
    if (at_ > 0 && (is_in_word(text_[at_ - 1]) || text_[at_ - 1] == '.')) return -1;
    std::string rest;
    return robot_before_dot(twin_, text_.substr(at_), rest);
  }

  void quoted() {
    const std::size_t end = text_.find(here(), at_ + 1);
    if (end == std::string::npos || end + 1 >= text_.size() || text_[end + 1] != '.')
      refuse("got a quotation mark, expected them around a robot's name, 'e-puck'.x_m");
    const std::string name = text_.substr(at_ + 1, end - at_ - 1);
    const int robot = twin_.find(name);
    if (robot < 0) refuse(unknown_robot(name));
    at_ = end + 2;
    signal(robot, name + ".");
  }

  std::string unknown_robot(const std::string& name) const {
    std::vector<std::string> all;
    for (const auto& r : twin_.world().robots) all.push_back(r.name);
    return fmt::format("got '{}', expected a robot{}; {}", name.substr(0, 60),
                       sim::did_you_mean_tail(name, all), robots_text(twin_));
  }

  void word() {
    std::size_t end = at_;
    while (end < text_.size() && is_in_word(text_[end])) ++end;
    const std::string name = text_.substr(at_, end - at_);
    const auto put = [&](const char* text) {
      made += text;
      at_ = end;
    };
    // Words of conditions that muParser spells otherwise.
    if (name == "and") return put("&&");
    if (name == "or") return put("||");
    if (name == "not") return put("!");
    if (name == "true") return put("1");
    if (name == "false") return put("0");
    if (name == "pi") return put("_pi");
    if (end < text_.size() && text_[end] == '.') {
      if (end + 1 < text_.size() && (begins_word(text_[end + 1]) || text_[end + 1] == '$'))
        refuse(unknown_robot(name));
    }
    // A function that muParser knows; whatever else has a name is a signal.
    std::size_t open = end;
    while (open < text_.size() && text_[open] == ' ') ++open;
    const bool is_called = open < text_.size() && text_[open] == '(';
    if (is_called && name != "pin" && name != "reg" && name != "var") {
      const std::vector<std::string> known(std::begin(kFunctions), std::end(kFunctions));
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        refuse(fmt::format("got '{}(', expected a function: {}{}", name.substr(0, 60), fmt::join(known, " "),
                           sim::did_you_mean_tail(name, known)));
      }
      return put(name.c_str());
    }
    signal(robot_, "");
  }

  /// The name of a signal begins here, behind its robot's.
  void signal(int robot, const std::string& before) {
    std::size_t end = at_;
    if (here() == '$') {
      ++end;
      end = end < text_.size() && text_[end] == '(' ? closed(end) : part_of_c(end);
    } else {
      while (end < text_.size() && is_in_word(text_[end])) ++end;
      const std::string name = text_.substr(at_, end - at_);
      if (end < text_.size() && text_[end] == '(' && (name == "pin" || name == "reg" || name == "var"))
        end = closed(end);
    }
    std::string name = text_.substr(at_, end - at_);
    if (name.empty() || name == "$")
      refuse(fmt::format("got '{}', expected the name of a signal", before + name));
    at_ = end;
    if (name[0] == '$' && name.size() > 1 && name[1] == '(') name = "var" + name.substr(1);
    const std::string whole = before + name;
    const auto known = std::find(names.begin(), names.end(), whole);
    const auto number = static_cast<std::size_t>(known - names.begin());
    if (known == names.end()) {
      signals.push_back(find(twin_, robot, name));
      names.push_back(whole);
    }
    made += fmt::format(" s{} ", number);
  }

  /// Behind the bracket that closes the one at `open`.
  std::size_t closed(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < text_.size(); ++i) {
      depth += text_[i] == '(' || text_[i] == '[';
      depth -= text_[i] == ')' || text_[i] == ']';
      if (depth == 0) return i + 1;
    }
    refuse("got an open bracket, expected it closed");
  }
  /// Behind NAME, .MEMBER, ->MEMBER, [INDEX] and file:NAME.
  std::size_t part_of_c(std::size_t i) const {
    while (i < text_.size()) {
      if (is_in_word(text_[i]))
        ++i;
      else if (text_[i] == '[')
        i = closed(i);
      else if ((text_[i] == '.' || text_[i] == ':') && i + 1 < text_.size() && begins_word(text_[i + 1]))
        ++i;
      else if (text_.compare(i, 2, "->") == 0)
        i += 2;
      else
        break;
    }
    return i;
  }

  void sign() {
    for (const char* two : {"&&", "||", "==", "!=", "<=", ">="})
      if (text_.compare(at_, 2, two) == 0) {
        made += two;
        at_ += 2;
        return;
      }
    const char c = here();
    if (c == '=') refuse("got '=', expected == to compare");
    if (c == '&' || c == '|') refuse(fmt::format("got '{0}', expected {0}{0}", c));
    if (std::string("+-*/^<>!()?:,").find(c) == std::string::npos)
      refuse(fmt::format("got '{}', expected a condition of names, numbers and + - * / ^ < > == && || !",
                         text_.substr(at_, 20)));
    depth_ += (c == '(') - (c == ')');
    if (depth_ > kDeepest) refuse(fmt::format("got more than {} brackets within one another", kDeepest));
    made += c;
    ++at_;
  }

  const std::string& text_;
  twin::Twin& twin_;
  int robot_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Condition::Condition(const std::string& text, twin::Twin& twin, int robot)
    : text_(text), formula_(std::make_unique<Formula>()) {
  if (text.size() > kLongest)
    throw std::runtime_error(
        fmt::format("got a condition of {} characters, expected at most {}", text.size(), kLongest));
  if (text.find_first_not_of(" \t") == std::string::npos)
    throw std::runtime_error("got nothing, expected a condition such as x_m > 0.2 && led0");
  if (robot < 0 && twin.robots() == 1) robot = 0;
  Translation translation(text, twin, robot);
  translation.run();
  formula_->names = translation.names;
  formula_->signals = translation.signals;
  formula_->values.resize(translation.names.size());
  void* const parser = formula_->parser.get();
  mupDefineInfixOprt(parser, "!", not_of, true);
  mupDefineFun1(parser, "floor", floor_of, true);
  mupDefineFun1(parser, "ceil", ceil_of, true);
  mupDefineFun1(parser, "round", round_of, true);
  mupDefineFun2(parser, "mod", mod_of, true);
  mupDefineFun2(parser, "hypot", hypot_of, true);
  for (std::size_t i = 0; i < formula_->values.size(); ++i)
    mupDefineVar(parser, ("s" + std::to_string(i)).c_str(), &formula_->values[i]);
  mupSetExpr(parser, translation.made.c_str());
  int results = 1;
  mupEvalMulti(parser, &results);
  if (mupError(parser)) {
    std::string what = mupGetErrorMsg(parser);
    for (std::size_t i = formula_->names.size(); i-- > 0;) {
      const std::string ours = "\"s" + std::to_string(i);
      if (const std::size_t at = what.find(ours); at != std::string::npos)
        what.replace(at, ours.size(), "\"" + formula_->names[i]);
    }
    if (const std::size_t at = what.find(" at position"); at != std::string::npos) what.resize(at);
    while (!what.empty() && what.back() == '.') what.pop_back();
    if (!what.empty()) what[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(what[0])));
    throw std::runtime_error("got '" + text + "', expected a condition such as x_m > 0.2 && led0: " + what);
  }
  if (results != 1) throw std::runtime_error("got '" + text + "', expected one condition, without a comma");
}

Condition::~Condition() = default;
Condition::Condition(Condition&&) noexcept = default;
Condition& Condition::operator=(Condition&&) noexcept = default;

double Condition::value(twin::Twin& twin) const {
  for (std::size_t i = 0; i < formula_->signals.size(); ++i)
    formula_->values[i] = formula_->signals[i].value(twin);
  return mupEval(formula_->parser.get());
}

bool Condition::holds(twin::Twin& twin) const {
  const double now = value(twin);
  return now != 0 && !std::isnan(now);
}

}  // namespace signals
