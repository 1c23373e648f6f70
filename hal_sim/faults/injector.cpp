// SPDX-License-Identifier: MIT
#include "hal_sim/faults/injector.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "hal_sim/faults/deeds.h"
#include "hal_sim/signals/condition.h"
#include "hal_sim/signals/signals.h"
#include "sim_core/base/did_you_mean.h"
#include "sim_core/base/utf8.h"

namespace faults {

namespace {

/// The first tick at or after an instant.
Clicks tick_at(Clicks at, Clicks tick) { return (at + tick - 1) / tick * tick; }

/// The values of a fault that was built by hand, held against the table as a file's are.
std::string check_values(const Fault& fault, const Kind& kind) {
  std::vector<std::string> names;
  for (const Parameter& p : kind.parameters) names.push_back(p.name);
  for (const auto& [name, value] : fault.values) {
    const auto known = std::find(names.begin(), names.end(), name);
    if (known == names.end()) {
      return fmt::format("unknown parameter '{}' of {}{}", name, kind.name,
                         sim::did_you_mean_tail(name, names));
    }
    const Parameter& p = kind.parameters[static_cast<std::size_t>(known - names.begin())];
    const double number =
        p.type == sim::ValueType::Integer ? static_cast<double>(value.integer) : value.number;
    if ((p.type == sim::ValueType::Integer || p.type == sim::ValueType::Number) &&
        !(number >= p.least && number <= p.most))
      return fmt::format("{}: got {}, expected {} to {}{}{}", name, number, p.least, p.most,
                         *p.unit ? " " : "", p.unit);
    if (p.type == sim::ValueType::Choice &&
        ("|" + std::string(p.choices) + "|").find("|" + value.text + "|") == std::string::npos)
      return fmt::format("{}: got '{}', expected one of {}", name, value.text, p.choices);
    if (p.type == sim::ValueType::Bytes && !sim::bytes_of_characters(value.text))
      return fmt::format("{}: got a character above U+00FF, expected one byte a character", name);
    if (p.type == sim::ValueType::Triple && value.numbers.size() != 3)
      return fmt::format("{}: got {} numbers, expected x, y and heading", name, value.numbers.size());
  }
  for (const Parameter& p : kind.parameters)
    if (std::string(p.usual) == "required" && !fault.values.count(p.name))
      return fmt::format("{}: missing, {} needs it", p.name, kind.name);
  if (!(fault.at_s >= 0) || !std::isfinite(fault.at_s))
    return fmt::format("at_s: got {}, expected 0 s or more", fault.at_s);
  if (!(fault.for_s > 0)) return fmt::format("for_s: got {}, expected more than 0 s", fault.for_s);
  return "";
}

}  // namespace

class Injector::Work {
 public:
  explicit Work(twin::Twin& twin) : twin_(twin), origin_(twin.simulation().begun()) {}

  struct Entry {
    Fault fault;
    const Kind* kind = nullptr;
    std::deque<Case> cases;  // one a robot
    std::vector<signals::Condition> conditions;
    Clicks at = 0;
    bool by_hand = false;
    bool was_felt = false;  // before the world began again
  };

  /// Throws what is wrong; nothing is kept yet.
  std::unique_ptr<Entry> make(Fault fault, bool by_hand) const {
    auto entry = std::make_unique<Entry>();
    entry->kind = find_kind(fault.kind);
    if (!entry->kind) {
      throw std::runtime_error(fmt::format("kind: got '{}', expected one of twinpuck list faults{}",
                                           fault.kind, sim::did_you_mean_tail(fault.kind, kind_names())));
    }
    // Values are judged before anything is kept.
    if (const std::string wrong = check_values(fault, *entry->kind); !wrong.empty())
      throw std::runtime_error(wrong);
    entry->by_hand = by_hand;
    entry->fault = std::move(fault);
    const Fault& f = entry->fault;
    entry->at = origin_ + sim::from_seconds(f.at_s);
    const bool is_all = f.robot == "*";
    const int one = is_all ? -1 : twin_.find(f.robot);
    if (!is_all && one < 0) {
      std::vector<std::string> names;
      for (const auto& robot : twin_.world().robots) names.push_back(robot.name);
      throw std::runtime_error(fmt::format("robot: got '{}', expected a robot of the world{}; {}", f.robot,
                                           sim::did_you_mean_tail(f.robot, names),
                                           signals::robots_text(twin_)));
    }
    // One case for each robot that is meant, each with a condition of its own.
    for (int r = 0; r < twin_.robots(); ++r) {
      if (!is_all && r != one) continue;
      Case c;
      c.fault = &entry->fault;
      c.kind = entry->kind;
      c.robot = r;
      if (const std::string wrong = check(c, twin_); !wrong.empty()) throw std::runtime_error(wrong);
      if (!f.when.empty() && !by_hand) {
        try {
          entry->conditions.emplace_back(f.when, twin_, r);
        } catch (const std::runtime_error& e) {
          throw std::runtime_error(std::string("when: ") + e.what());
        }
      }
      entry->cases.push_back(c);
    }
    return entry;
  }

  int keep(std::unique_ptr<Entry> entry) {
    entries_.push_back(std::move(entry));
    looked_at_ = -1;
    return static_cast<int>(entries_.size()) - 1;
  }

  void begin_now(int id) {
    Entry& entry = *entries_[static_cast<std::size_t>(id)];
    for (Case& c : entry.cases) begin(c);
  }

  void end_now(int id) {
    for (Case& c : entries_.at(static_cast<std::size_t>(id))->cases) {
      if (c.begun < 0) c.begun = c.ended = kNotAtAll;
      if (c.kind->lasts && c.is_active()) end(c);
    }
  }

  void look() {
    if (twin_.simulation().begun() != origin_) begin_again();
    if (looked_at_ == now()) return;
    looked_at_ = now();
    for (const auto& entry : entries_)
      for (Case& c : entry->cases)
        if (c.begun >= 0 && c.took_effect < 0 && is_looked_for(c)) c.took_effect = noticed(c, twin_);
    for (const auto& entry : entries_)
      for (Case& c : entry->cases)
        if (c.kind->lasts && c.is_active() && now() >= end_of(*entry, c)) end(c);
    for (const auto& entry : entries_) {
      if (entry->at > now()) continue;
      for (std::size_t i = 0; i < entry->cases.size(); ++i) {
        Case& c = entry->cases[i];
        if (c.begun >= 0 || c.ended == kNotAtAll) continue;
        if (entry->conditions.empty() ? true : entry->conditions[i].holds(twin_)) begin(c);
      }
    }
  }

  Clicks next() const {
    const Clicks tick = twin_.simulation().scene().tick_clicks();
    Clicks first = sim::kEver;
    const auto wants = [&](Clicks at) { first = std::min(first, std::max(tick_at(at, tick), now() + tick)); };
    for (const auto& entry : entries_)
      for (const Case& c : entry->cases) {
        if (c.ended == kNotAtAll) continue;
        if (c.begun < 0) {
          wants(entry->at <= now() && looked_at_ == now() ? now() + tick : entry->at);
        } else {
          if (c.kind->lasts && c.is_active() && std::isfinite(entry->fault.for_s)) wants(end_of(*entry, c));
          if (c.took_effect < 0 && c.is_active() && is_looked_for(c)) wants(now() + tick);
        }
      }
    return first;
  }

  void advance(Clicks at) {
    look();
    twin_.simulation().advance(std::min(at, next()));
    look();
  }

  bool is_empty() const { return entries_.empty(); }
  int size() const { return static_cast<int>(entries_.size()); }

  Status status(int id) const {
    const Entry& entry = *entries_.at(static_cast<std::size_t>(id));
    Status s;
    s.id = id;
    s.fault = entry.fault;
    const auto earlier = [](double& known, Clicks at) {
      const double at_s = sim::to_seconds(at);
      if (at >= 0 && (known < 0 || at_s < known)) known = at_s;
    };
    bool goes_on = false;
    for (const Case& c : entry.cases) {
      if (c.begun < 0) continue;
      earlier(s.begun_s, c.begun);
      earlier(s.took_effect_s, noticed(c, twin_));
      if (c.ended >= 0) s.ended_s = std::max(s.ended_s, sim::to_seconds(c.ended));
      goes_on |= c.is_active();
    }
    if (goes_on) s.ended_s = -1;
    return s;
  }

  bool was_felt(int id) const { return entries_.at(static_cast<std::size_t>(id))->was_felt; }

 private:
  static constexpr Clicks kNotAtAll = -2;  // it was ended before it began

  Clicks now() const { return twin_.simulation().now(); }

  /// The boards have forgotten their part of it, the world has not.
  void begin_again() {
    origin_ = twin_.simulation().begun();
    for (const auto& entry : entries_) {
      entry->at = origin_ + sim::from_seconds(entry->fault.at_s);
      for (Case& c : entry->cases) {
        entry->was_felt |= noticed(c, twin_) >= 0;
        if (c.is_active() && c.kind->lasts) {
          c.ended = now();
          apply(c, all_cases(), twin_);
        }
        Case fresh;
        fresh.fault = c.fault, fresh.kind = c.kind, fresh.robot = c.robot;
        if (entry->by_hand) fresh.begun = fresh.ended = kNotAtAll;
        c = fresh;
      }
    }
    looked_at_ = -1;
  }

  Clicks end_of(const Entry& entry, const Case& c) const {
    return std::isfinite(entry.fault.for_s) ? c.begun + sim::from_seconds(entry.fault.for_s) : sim::kEver;
  }

  std::vector<Case*>& all_cases() {
    cases_.clear();
    for (const auto& entry : entries_)
      for (Case& c : entry->cases) cases_.push_back(&c);
    return cases_;
  }

  /// What others of its kind did so far is theirs.
  void take_notice(const Case& c) {
    for (Case* other : all_cases())
      if (other->robot == c.robot && other->begun >= 0 && other->took_effect < 0)
        other->took_effect = noticed(*other, twin_);
    forget(c, twin_);
  }

  void begin(Case& c) {
    take_notice(c);
    c.begun = now();
    c.begun_cycle = twin_.mind(c.robot).now();
    apply(c, all_cases(), twin_);
    if (!c.kind->lasts) {
      c.ended = now();
      c.ended_cycle = board::kNever;
    }
  }

  void end(Case& c) {
    if (c.took_effect < 0) c.took_effect = noticed(c, twin_);
    // bytes that have left by now went over the line as it was
    twin_.mind(c.robot).board().exchange(twin_.mind(c.robot).now());
    c.ended = now();
    c.ended_cycle = twin_.mind(c.robot).now();
    apply(c, all_cases(), twin_);
  }

  twin::Twin& twin_;
  std::vector<std::unique_ptr<Entry>> entries_;
  std::vector<Case*> cases_;
  Clicks origin_;          // of their times: the world began
  Clicks looked_at_ = -1;  // -1: there may be something to do now
};

Injector::Injector(twin::Twin& twin) : work_(std::make_unique<Work>(twin)) {}
Injector::~Injector() = default;

int Injector::add(Fault fault) { return add(std::vector<Fault>{std::move(fault)}).front(); }

std::vector<int> Injector::add(std::vector<Fault> faults) {
  std::vector<std::unique_ptr<Work::Entry>> entries;
  std::string problems;
  for (Fault& fault : faults) {
    const std::string where = fault.where;
    try {
      entries.push_back(work_->make(std::move(fault), false));
    } catch (const std::runtime_error& e) {
      problems += (problems.empty() ? "" : "\n") + (where.empty() ? "" : where + ": ") + e.what();
    }
  }
  if (!problems.empty()) throw std::runtime_error(problems);
  std::vector<int> ids;
  for (auto& entry : entries) ids.push_back(work_->keep(std::move(entry)));
  return ids;
}

int Injector::begin(Fault fault) {
  const int id = work_->keep(work_->make(std::move(fault), true));
  work_->begin_now(id);
  return id;
}

void Injector::end(int id) { work_->end_now(id); }
void Injector::look() { work_->look(); }
sim::Clicks Injector::next() const { return work_->next(); }
void Injector::advance(sim::Clicks at) { work_->advance(at); }
bool Injector::is_empty() const { return work_->is_empty(); }
Status Injector::status(int id) const { return work_->status(id); }

std::vector<Status> Injector::statuses() const {
  std::vector<Status> all;
  for (int id = 0; id < work_->size(); ++id) all.push_back(status(id));
  return all;
}

std::vector<std::string> Injector::problems() const {
  std::vector<std::string> lines;
  for (const Status& s : statuses()) {
    if (s.took_effect_s >= 0 || work_->was_felt(s.id)) continue;
    const std::string who = (s.fault.where.empty() ? "" : s.fault.where + ": ") + said(s.fault) + ": ";
    const Kind& kind = *find_kind(s.fault.kind);
    if (s.begun_s < 0)
      lines.push_back(who + (s.fault.when.empty()
                                 ? fmt::format("never began: the run ended before {} s", s.fault.at_s)
                                 : fmt::format("never began: '{}' never held", s.fault.when)));
    else
      lines.push_back(fmt::format(
          "{}never took effect: it began at {:.3f} s{}, and it was never so that {}", who, s.begun_s,
          s.ended_s >= 0 && kind.lasts ? fmt::format(" and ended at {:.3f} s", s.ended_s) : "",
          kind.noticed));
  }
  return lines;
}

std::string said(const Fault& fault) {
  std::string text = fault.kind;
  const Kind* kind = find_kind(fault.kind);
  for (const auto& [name, value] : fault.values) {
    sim::ValueType type = sim::ValueType::Number;
    for (const Parameter& p : kind ? kind->parameters : std::vector<Parameter>{})
      if (name == p.name) type = p.type;
    std::string shown;
    // As the line that asks for it would be typed.
    switch (type) {
      case sim::ValueType::Integer:
        shown = std::to_string(value.integer);
        break;
      case sim::ValueType::Triple:
        shown = fmt::format("[{}]", fmt::join(value.numbers, ", "));
        break;
      case sim::ValueType::Bytes: {
        shown = "\"";
        for (const char byte : value.text) {
          const auto n = static_cast<unsigned char>(byte);
          shown += byte == '\r'            ? "\\r"
                   : byte == '\n'          ? "\\n"
                   : n < 0x20 || n == 0x7F ? fmt::format("\\u{:04x}", n)
                                           : std::string(1, byte);
        }
        shown += "\"";
        break;
      }
      case sim::ValueType::Text:
      case sim::ValueType::Choice:
        shown = value.text;
        break;
      default:
        shown = fmt::format("{}", value.number);
    }
    text += " " + name + "=" + shown;
  }
  if (fault.robot != "*") text += " of " + fault.robot;
  return text;
}

}  // namespace faults
