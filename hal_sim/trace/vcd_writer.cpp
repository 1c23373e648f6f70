// SPDX-License-Identifier: MIT
#include "hal_sim/trace/vcd_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <set>

namespace trace {

namespace {

// room for the comment and the last time stamp of a file that is cut
constexpr std::int64_t kVcdEndBytes = 200;
constexpr std::int64_t kRealBytes = 24;  // of a number with 16 digits
constexpr double kBytesPerMb = 1e6;

// printable characters, lowest digit first
std::string code_of(std::size_t number) {
  std::string code;
  do {
    code += static_cast<char>('!' + number % 94);
    number /= 94;
  } while (number > 0);
  return code;
}

// no blanks, and no characters that viewers take for a hierarchy or a range of bits
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c == '[')
      out += '(';
    else if (c == ']')
      out += ')';
    else
      out += c > ' ' && c < 127 && c != '.' && c != '$' && c != '\\' ? c : '_';
  }
  return out;
}

// the scopes' names, each its own; those that are plain already stay
std::vector<std::string> scope_names(const std::vector<VcdWriter::Scope>& scopes) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const auto& scope : scopes)
    if (plain(scope.name) == scope.name) taken.insert(scope.name);
  for (const auto& scope : scopes) {
    const std::string base = plain(scope.name);
    std::string name = base;
    for (int n = 2; base != scope.name && !taken.insert(name).second; ++n)
      name = fmt::format("{}_{}", base, n);
    names.push_back(name);
  }
  return names;
}

}  // namespace

std::int64_t to_ns(sim::Clicks at) {
  const auto ns = static_cast<__int128>(at) * 1'000'000'000 + sim::kClicksPerSecond / 2;
  return static_cast<std::int64_t>(ns / sim::kClicksPerSecond);
}

VcdWriter::VcdWriter(const std::string& path, const std::vector<Scope>& scopes, Window window)
    : window_(window) {
  pending_ = "$version twinpuck $end\n$timescale 1 ns $end\n";  // written with the first tick
  const std::vector<std::string> names = scope_names(scopes);
  std::int64_t values = 0;
  for (std::size_t s = 0; s < scopes.size(); ++s) {
    const Scope& scope = scopes[s];
    pending_ += "$scope module " + names[s] + " $end\n";
    std::string group;
    for (const Signal& signal : scope.signals) {
      if (signal.group != group) {
        if (!group.empty()) pending_ += "$upscope $end\n";
        group = signal.group;
        pending_ += "$scope module " + group + " $end\n";
      }
      Line line;
      line.code = code_of(lines_.size());
      line.width = signal.width;
      line.real = signal.real;
      const std::string range =
          signal.width > 1 && !signal.real ? fmt::format(" [{}:0]", signal.width - 1) : "";
      pending_ += fmt::format("$var {} {} {} {}{} $end\n", signal.real ? "real" : "wire", signal.width,
                              line.code, plain(signal.name), range);
      values += (signal.real ? kRealBytes : signal.width) + static_cast<std::int64_t>(line.code.size()) + 3;
      lines_.push_back(std::move(line));
    }
    if (!group.empty()) pending_ += "$upscope $end\n";
    pending_ += "$upscope $end\n";
  }
  pending_ += "$enddefinitions $end\n";
  const std::int64_t least = static_cast<std::int64_t>(pending_.size()) + values + kVcdEndBytes;
  if (least <= window_.most_bytes) {
    file_.emplace(path, "--vcd");
    return;
  }
  // a dump without its names, or their first values, is none
  state_ = State::Done;
  too_small_ = fmt::format("command line: --vcd-max-mb: got {:g} MB, expected at least {:.3f} for {} signals",
                           static_cast<double>(window_.most_bytes) / kBytesPerMb,
                           std::ceil(static_cast<double>(least) / kBytesPerMb * 1000) / 1000, lines_.size());
}

void VcdWriter::arrive(sim::Clicks at) {
  // all changes at the window's first instant belong to the values that it begins with
  if (!armed_ && at > window_.from) {
    armed_ = true;
    const bool holds = window_.trigger < 0 ||
                       (lines_[static_cast<std::size_t>(window_.trigger)].known &&
                        lines_[static_cast<std::size_t>(window_.trigger)].value == window_.trigger_value);
    if (holds && state_ == State::Before) begin(window_.from);
  }
  if (at > window_.to && state_ == State::Writing) end(window_.to, "");
  if (at > window_.to) state_ = State::Done;
}

void VcdWriter::change(sim::Clicks at, int signal, std::uint64_t value) {
  if (is_done()) return;
  arrive(at);
  Line& line = lines_[static_cast<std::size_t>(signal)];
  line.known = true;
  line.value = value;
  if (state_ == State::Before) {
    if (armed_ && signal == window_.trigger && value == window_.trigger_value) begin(at);
    return;
  }
  if (state_ != State::Writing) return;
  const std::size_t before = pending_.size();
  const std::int64_t stamped = stamped_ns_;
  stamp(at);
  write_value(line);
  if (bytes_ + static_cast<std::int64_t>(pending_.size()) + kVcdEndBytes > window_.most_bytes) {
    pending_.resize(before);
    stamped_ns_ = stamped;
    cut_at_ = at;
    end(at, fmt::format("$comment the file would grow beyond --vcd-max-mb at {} ns $end\n", to_ns(at)));
  }
}

void VcdWriter::begin(sim::Clicks at) {
  state_ = State::Writing;
  has_begun_ = true;
  stamp(at);
  pending_ += "$dumpvars\n";
  for (const Line& line : lines_) write_value(line);
  pending_ += "$end\n";
}

void VcdWriter::end(sim::Clicks at, const std::string& comment) {
  stamp(at);
  pending_ += comment;
  state_ = State::Done;
  flush();
}

void VcdWriter::stamp(sim::Clicks at) {
  const std::int64_t ns = to_ns(at);
  if (ns <= stamped_ns_) return;
  stamped_ns_ = ns;
  pending_ += fmt::format("#{}\n", ns);
}

void VcdWriter::write_value(const Line& line) {
  if (line.real) {
    double value = 0;
    std::memcpy(&value, &line.value, sizeof value);
    pending_ += fmt::format("r{:.16g} {}\n", value, line.code);
    return;
  }
  if (line.width == 1) {
    pending_ += !line.known ? "x" : line.value ? "1" : "0";
    pending_ += line.code + "\n";
    return;
  }
  pending_ += line.known ? fmt::format("b{:b} {}\n", line.value, line.code) : "bx " + line.code + "\n";
}

void VcdWriter::tick(sim::Clicks now) {
  if (is_done()) return;
  arrive(now);
  flush();
}

void VcdWriter::finish(sim::Clicks now) {
  if (!is_done()) {
    arrive(now + (armed_ ? 0 : 1));
    if (state_ == State::Writing) end(now, "");
  }
  flush();
  if (file_) file_->close();
}

void VcdWriter::flush() {
  if (pending_.empty() || !file_ || !error().empty()) return;
  bytes_ += static_cast<std::int64_t>(pending_.size());
  file_->append(pending_);
  if (!error().empty()) state_ = State::Done;
  pending_.clear();
}

}  // namespace trace
