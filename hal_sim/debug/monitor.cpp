// SPDX-License-Identifier: MIT
#include "hal_sim/debug/monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

#include "dspic30/asm/expression.h"

namespace debug {

namespace {

using dspic::assembly::trimmed;

constexpr const char* kHelp =
    R"(break WHERE [if EXPR]   stop at a function, file:line, line or 0xADDRESS; tbreak: once
watch WHAT [if EXPR]    stop when a variable, register or *ADDRESS has changed
delete [N]              a breakpoint, or all; info break lists them
continue, c             run on; Ctrl-C pauses, twice it ends
step, s   next, n       to the next source line, into or over calls; a number repeats
stepi, si nexti, ni     to the next instruction, likewise
finish                  until this function has returned
back, rs  backi, rsi    a source line or an instruction back; rc: back to the breakpoint before
goto 1.5s | CYCLE       forwards or back to a time of the robot, or a cycle; past breakpoints
where                   place and time; backtrace, bt: the calls that led here
up [N]  down [N]        to a caller and back, whose variables are meant until the program runs; frame N of bt
print EXPR, p           variables with members and elements (state.speed[1]), registers of the chip (LATA,
                        LATA.LATA6; w0, sr where there is its processor), pc, cycle, C's operators
locals                  parameters and variables of this function
set NAME = EXPR         a variable or register
x EXPR [WORDS]          words of data from an address
regs                    the processor's registers; info interrupts: what is enabled or pending;
                        info world: the robots, and the digest of the run so far
list [LINE]             source around a line
dis [WHERE] [N]         the chip's instructions from there, or here
why                     what is waited for, who could set it, what is pending but held off
trace FILE [N]          the next N instructions (10,000; at most 10,000,000) with cycles, as text
help, quit
)";

std::string first_word(const std::string& line, std::string& rest) {
  const std::size_t space = line.find_first_of(" \t");
  rest = space == std::string::npos ? "" : trimmed(line.substr(space));
  return line.substr(0, space);
}

/// The number of `what` that a command takes; none given: `usual`. -1: it is none from 1 to `most`, and
/// `problem` says so.
int number_of(const std::string& command, const std::string& given, const char* what, int usual, int most,
              std::string& problem) {
  int number = given.empty() ? usual : 0;
  const char* const end = given.data() + given.size();
  const auto [read, wrong] = std::from_chars(given.data(), end, number);
  const bool is_read = given.empty() || (wrong == std::errc() && read == end);
  if (is_read && number >= 1 && number <= most) return number;
  problem = fmt::format("{}: got '{}', expected {} from 1 to {}\n", command, given, what, most);
  return -1;
}

/// "WHERE if EXPR"
std::string condition_of(std::string& text) {
  const std::size_t at = text.find(" if ");
  if (at == std::string::npos) return "";
  std::string condition = trimmed(text.substr(at + 4));
  text = trimmed(text.substr(0, at));
  return condition;
}

}  // namespace

std::string Monitor::execute(const std::string& given) {
  std::string line = trimmed(given), rest;
  if (line.empty()) line = last_;  // an empty line: once more
  last_ = line;
  const std::string word = first_word(line, rest);
  if (word.empty() || word[0] == '#') return "";
  if (word == "quit" || word == "q") {
    quits_ = true;
    return "";
  }
  const std::map<std::string, Plan> plans{{"continue", Plan::Continue},
                                          {"c", Plan::Continue},
                                          {"step", Plan::Line},
                                          {"s", Plan::Line},
                                          {"next", Plan::NextLine},
                                          {"n", Plan::NextLine},
                                          {"stepi", Plan::Instruction},
                                          {"si", Plan::Instruction},
                                          {"nexti", Plan::NextInstruction},
                                          {"ni", Plan::NextInstruction},
                                          {"finish", Plan::Finish},
                                          {"back", Plan::BackLine},
                                          {"rs", Plan::BackLine},
                                          {"backi", Plan::BackInstruction},
                                          {"rsi", Plan::BackInstruction},
                                          {"rc", Plan::BackContinue}};
  // Commands that let the program run; an empty line does them once more.
  if (const auto plan = plans.find(word); plan != plans.end()) return run(word, plan->second, rest);
  last_ = word == "x" || word == "list" || word == "dis" ? line : "";  // the others are not worth repeating
  if (word == "help" || word == "h") return kHelp;
  if (word == "break" || word == "b" || word == "tbreak") return set_break(rest, word == "tbreak");
  if (word == "watch") return watch(rest);
  if (word == "info") return info(rest);
  if (word == "print" || word == "p") return print(rest);
  if (word == "set") return assign(rest);
  if (word == "x") return memory(rest);
  if (word == "backtrace" || word == "bt") return backtrace();
  if (word == "up" || word == "down" || word == "frame") return select(word, rest);
  if (word == "regs") return session_.machine().registers();
  if (word == "locals") return session_.values().locals();
  if (word == "list" || word == "l") return list(rest);
  if (word == "dis") return disassemble(rest);
  if (word == "goto") return go(rest);
  if (word == "trace") return trace(rest);
  if (word == "where") return where();
  if (word == "why") return session_.machine().why();
  if (word == "delete" || word == "d") {
    if (rest.empty()) {
      while (!session_.breakpoints().empty()) session_.remove(session_.breakpoints().front().id);
      return "";
    }
    std::string problem;
    const int id =
        number_of(word, rest, "a breakpoint's number", 0, std::numeric_limits<int>::max(), problem);
    return session_.remove(id) ? "" : "there is no breakpoint " + rest + "\n";
  }
  return "unknown command '" + word + "'; help lists them\n";
}

// --- running

std::string Monitor::run(const std::string& command, Plan plan, const std::string& times) {
  Stop stop;
  std::string problem;
  const int wanted = number_of(command, times, "a number of times", 1, 1'000'000, problem);
  if (wanted < 0) return problem;
  for (int n = wanted; n > 0; --n) {
    stop = session_.run(plan, idle_);
    const bool is_continued = plan == Plan::Continue || plan == Plan::BackContinue;
    const bool goes_on = stop.why == Stop::Why::Step || (is_continued && stop.why == Stop::Why::Breakpoint);
    if (!goes_on) break;
  }
  return told(stop);
}

std::string Monitor::told(const Stop& stop) { return (stop.text.empty() ? "" : stop.text + "\n") + where(); }

std::string Monitor::go(const std::string& rest) {
  if (rest.empty()) return "goto: expected a time such as 1.5s, or a cycle\n";
  char* end = nullptr;
  double value = std::strtod(rest.c_str(), &end);
  const std::string unit = trimmed(end);
  if (unit == "s") value *= static_cast<double>(board::kFcyHz);
  if (end == rest.c_str() || !(unit.empty() || unit == "s") || !(value >= 0 && value < 1e15) ||
      (unit.empty() && value != std::floor(value)))
    return "goto: got '" + rest + "', expected a time such as 1.5s, or a cycle\n";
  return told(session_.go_to(static_cast<Cycle>(value), idle_));
}

std::string Monitor::trace(const std::string& rest) {
  constexpr int kMost = 10'000'000, kUsual = 10'000;
  std::string count;
  const std::string name = first_word(rest, count);
  std::string problem;
  const int wanted = number_of("trace", count, "a number of instructions", kUsual, kMost, problem);
  if (wanted < 0) return problem;
  // what is in the file goes only once all else is right
  std::ofstream out;
  if (!name.empty()) out.open(name);
  if (!out.is_open()) return fmt::format("trace: got '{}', expected a file that can be written\n", name);
  int n = 0;
  for (; n < wanted && !session_.has_ended(); ++n) {
    std::uint32_t next = 0;
    const std::uint32_t pc = session_.pc();
    const std::string text = session_.machine().instruction(pc, next);
    out << fmt::format("{} {:06x} ", session_.now(), pc);
    if (!text.empty()) out << fmt::format("{:<28} ", text.substr(text.find("  ") + 2));
    out << "; " << session_.file().code.describe(pc) << '\n';
    const Stop stop = session_.run(Plan::AnyInstruction, idle_);
    if (stop.why != Stop::Why::Step) break;
  }
  out.close();
  if (!out) return fmt::format("trace: {}: cannot be written\n", name) + where();
  return fmt::format("{} instructions in {}\n", n, name) + where();
}

// --- breakpoints

std::string Monitor::set_break(const std::string& rest, bool once) {
  std::string at = rest, error;
  const std::string condition = condition_of(at);
  if (at.empty()) at = fmt::format("{:#x}", session_.pc());
  const Breakpoint* b = session_.add_breakpoint(at, condition, error);
  if (!b) return error + "\n";
  const int id = b->id;
  for (Breakpoint& each : session_.breakpoints())
    if (each.id == id) each.once = once;
  std::string text = fmt::format("breakpoint {} at", id);
  for (const std::uint32_t a : b->addresses)
    text += fmt::format(" {:#08x} {}", a, session_.file().code.describe(a));
  const std::string note = session_.note_of(*b);
  return text + "\n" + (note.empty() ? "" : note + "\n");
}

std::string Monitor::watch(const std::string& rest) {
  std::string what = rest, error;
  const std::string condition = condition_of(what);
  const Breakpoint* b = session_.add_watchpoint(what, condition, error);
  if (!b) return error + "\n";
  return fmt::format("watchpoint {} on {} at {:#06x}, {} bytes\n", b->id, b->what, b->data.address,
                     b->data.bytes);
}

std::string Monitor::info(const std::string& rest) {
  if (rest == "interrupts") return session_.machine().interrupts();
  if (rest == "world") return world();
  if (rest != "break" && rest != "b")
    return "got 'info " + rest + "', expected info break, interrupts or world\n";
  std::string text;
  for (const Breakpoint& b : session_.breakpoints())
    text += fmt::format("{} {} {}{}, {} times\n", b.id, b.data.bytes ? "watch" : "break", b.what,
                        b.condition.empty() ? "" : " if " + b.condition, b.hits);
  return text.empty() ? "none\n" : text;
}

std::string Monitor::world() {
  const sim::Simulation& simulation = session_.twin().simulation();
  std::string text =
      fmt::format("{:.6f} s, digest {:016x}\n", sim::to_seconds(simulation.now()), simulation.digest());
  for (int i = 0; i < session_.twin().robots(); ++i) {
    const auto pose = simulation.pose(i);
    text += fmt::format("  {}: {:.4f} m, {:.4f} m, {:.1f} deg\n",
                        session_.twin().world().robots[static_cast<std::size_t>(i)].name, pose.x_m, pose.y_m,
                        pose.heading_rad * 180 / 3.14159265358979);
  }
  return text;
}

// --- data

std::string Monitor::print(const std::string& expression) {
  CValue value;
  std::string error;
  const bool is_known = session_.values().compute(expression, Want::Place, value, error);
  const auto data = is_known && !value.part ? session_.values().find_data(expression) : std::nullopt;
  if (data && data->bytes > 4 &&
      !session_.machine().find_register(expression)) {  // of no known type: its words
    std::string text = expression + " =";
    for (unsigned i = 0; i + 1 < data->bytes && i < 64; i += 2)
      text += fmt::format(" {:#06x}", session_.values().read({data->address + i, 2}));
    return text + (data->bytes > 64 ? " ...\n" : "\n");
  }
  if (is_known && value.part) return expression + " = " + session_.values().shown(value) + "\n";
  if (!session_.values().compute(expression, Want::Number, value, error)) return error + "\n";
  std::string text = session_.values().shown(value);
  // a register, or a symbol without a type, has no sign of its own
  const unsigned bits =
      data && data->width == 0 && value.type.kind == CType::Kind::Unsigned ? 8 * data->bytes : 0;
  if (bits > 0 && bits <= 32 && value.type.stars == 0 && (value.raw >> (bits - 1) & 1))
    text.insert(text.size() - 1,
                fmt::format(", signed {}", static_cast<std::int64_t>(value.raw) - (std::int64_t{1} << bits)));
  return expression + " = " + text + "\n";
}

std::string Monitor::assign(const std::string& rest) {
  const std::size_t equals = rest.find('=');
  if (equals == std::string::npos) return "expected NAME = EXPRESSION\n";
  const std::string name = trimmed(rest.substr(0, equals));
  std::string error;
  return session_.assign(name, rest.substr(equals + 1), error) ? print(name) : error + "\n";
}

std::string Monitor::memory(const std::string& rest) {
  std::string count;
  const std::string at = first_word(rest, count);
  std::int64_t address = 0;
  std::string error;
  if (!session_.values().evaluate(at, address, error)) return error + "\n";
  const int words = number_of("x", count, "a number of words", 8, 4096, error);
  if (words < 0) return error;
  std::string text;
  for (int i = 0; i < words; ++i) {
    const Address here = static_cast<Address>(address + 2 * i) & kAddressMask & ~Address{1};
    if (i % 8 == 0) text += fmt::format("{}{:04x}:", i ? "\n" : "", here);
    unsigned word = 0;
    session_.machine().read({here, 2}, &word);
    text += fmt::format(" {:04x}", word);
  }
  return text + "\n";
}

// --- code

std::string Monitor::where() {
  std::string text = fmt::format("{:.9f} s, cycle {}: {:#08x} {}\n", session_.seconds(), session_.now(),
                                 session_.pc(), session_.machine().code().describe(session_.pc()));
  if (const auto* line = session_.file().code.line_at(session_.pc()))
    text += source_line(session_.file().code.lines().files[line->file], line->line);
  return text;
}

std::string Monitor::backtrace() {
  std::string text;
  int n = 0;
  for (const Frame& f : session_.frames())
    text += fmt::format("#{} {:#08x} {}{}\n", n++, f.call, session_.machine().code().describe(f.call),
                        f.is_handler ? "  <-- interrupt" : "");
  return text;
}

std::string Monitor::select(const std::string& command, const std::string& rest) {
  const std::vector<Frame> all = session_.frames();
  std::size_t now = 0;  // the one that was selected
  if (const Frame* const level = session_.selected())
    while (now + 1 < all.size() && all[now].base != level->base) ++now;
  int given = command == "frame" ? static_cast<int>(now) : 1;
  const auto [read, wrong] = std::from_chars(rest.data(), rest.data() + rest.size(), given);
  const bool is_read = rest.empty() || (wrong == std::errc() && read == rest.data() + rest.size());
  const std::int64_t to = command == "frame" ? given
                          : command == "up"  ? static_cast<std::int64_t>(now) + given
                                             : static_cast<std::int64_t>(now) - given;
  if (!is_read || given < 0 || to < 0 || !session_.select_frame(static_cast<std::size_t>(to)))
    return fmt::format("{}: got {}, expected a level of backtrace, 0 to {}\n", command,
                       is_read ? std::to_string(to) : "'" + rest + "'", all.size() - 1);
  const Frame& f = all[static_cast<std::size_t>(to)];
  std::string text = fmt::format("#{} {:#08x} {}\n", to, f.call, session_.machine().code().describe(f.call));
  if (const auto* line = session_.file().code.line_at(f.call))
    text += source_line(session_.file().code.lines().files[line->file], line->line);
  return text;
}

std::string Monitor::source_line(const std::string& file, int line) {
  auto [at, is_new] = sources_.try_emplace(file);
  if (is_new) {
    std::ifstream in(file);
    for (std::string text; std::getline(in, text);) at->second.push_back(text);
  }
  if (line < 1 || line > static_cast<int>(at->second.size())) return "";
  return fmt::format("{}\t{}\n", line, at->second[static_cast<std::size_t>(line - 1)]);
}

std::string Monitor::list(const std::string& rest) {
  const Frame* const level = session_.selected();
  const auto* here = session_.file().code.line_at(level ? level->call : session_.pc());
  if (!here) return "no source line is known here; dis shows instructions\n";
  std::string text, problem;
  const int middle = number_of("list", rest, "a line", here->line, 1'000'000, problem);
  if (middle < 0) return problem;
  for (int n = middle - 5; n <= middle + 5; ++n)
    text += source_line(session_.file().code.lines().files[here->file], n);
  return text;
}

std::string Monitor::disassemble(const std::string& rest) {
  std::string text, problem, count = rest;
  std::uint32_t a = session_.pc();
  if (rest.find_first_not_of("0123456789") != std::string::npos) {
    const auto code = session_.find_code(first_word(rest, count), problem);
    if (code.addresses.empty()) return "dis: " + problem + "\n";
    a = code.addresses[0];
  }
  const int wanted = number_of("dis", count, "a number of instructions", 10, 1000, problem);
  if (wanted < 0) return problem;
  for (int n = wanted; n > 0; --n) {
    std::uint32_t next = 0;
    const std::string instruction = session_.machine().instruction(a, next);
    if (instruction.empty()) break;
    text += fmt::format("{} {:06x}  {} ; {}\n", a == session_.pc() ? "=>" : "  ", a, instruction,
                        session_.file().code.describe(a));
    a = next;
  }
  return text.empty() ? fmt::format("dis: got {:#x}, expected an address of the program's code\n", a) : text;
}

}  // namespace debug
