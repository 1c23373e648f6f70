// SPDX-License-Identifier: MIT
#include "exercises/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lab {

namespace {

bool keeps_bounds(const TrialResult& t) {
  if (!t.ran) return false;
  for (const Bound& b : t.trial.step->bounds) {
    const double v = t.measures[b.measure];
    if (!(v >= b.low && v <= b.high)) return false;  // not a number: not kept
  }
  return true;
}

bool is_of(const TrialResult& t, double noise_scale) {
  return std::isnan(noise_scale) || t.trial.noise_scale == noise_scale;
}

/// "wall_touch_s": "wall touch" and "s".
std::pair<std::string, std::string> name_and_unit(Measure m) {
  std::string name = measure_name(m), unit;
  for (const char* ending : {"_s", "_m"})
    if (name.size() > 2 && name.compare(name.size() - 2, 2, ending) == 0) {
      unit = ending + 1;
      name.resize(name.size() - 2);
    }
  std::replace(name.begin(), name.end(), '_', ' ');
  return {name, unit};
}

/// "0.31 s"
std::string value_text(Measure m, double value) {
  std::string unit = name_and_unit(m).second;
  if (unit == "m" && value < 0.1) unit = "mm", value *= 1000;
  const std::string number = m == Measure::Speed          ? fmt::format("{:.0f}", value)
                             : value == std::round(value) ? fmt::format("{:.0f}", value)
                             : unit.empty()               ? fmt::format("{:.4g}", value)
                                                          : fmt::format("{:.2f}", value);
  return number + (unit.empty() ? "" : " " + unit);
}

/// "wall_touch_s" 0.312 -> "wall touch 0.31 s"
std::string words(Measure m, double value, const char* how) {
  return fmt::format("{}{}{} {}", how, *how ? " " : "", name_and_unit(m).first, value_text(m, value));
}

/// What a measure shall be: "escape at most 60 s", "detection 0.0138 to 0.0142 m". As the table has it.
std::string bound_text(Measure m, double low, double high) {
  const auto [name, unit] = name_and_unit(m);
  const std::string value = std::isinf(low)    ? fmt::format("at most {:g}", high)
                            : std::isinf(high) ? fmt::format("at least {:g}", low)
                            : low == high      ? fmt::format("{:g}", low)
                                               : fmt::format("{:g} to {:g}", low, high);
  return name + " " + value + (unit.empty() ? "" : " " + unit);
}

/// How many of so many trials make a share that is no less, or no more, than asked for.
struct Needed {
  std::size_t least, most;
};
Needed needed(const Span& share, std::size_t trials) {
  const auto of = [trials](std::size_t n) { return static_cast<double>(n) / static_cast<double>(trials); };
  Needed n{0, trials};
  while (n.least < trials && of(n.least) < share.low) ++n.least;
  while (n.most > 0 && of(n.most) > share.high) --n.most;
  return n;
}

/// "all", "none", "9 of 10", "at most 3 of 5", "2 to 4 of 5"; empty: any number will do.
std::string count_text(const Needed& n, std::size_t trials) {
  if (n.least == trials) return fmt::format("all {}", trials);
  if (n.most == 0) return "none";
  if (n.least == 0 && n.most == trials) return "";
  if (n.least == n.most) return fmt::format("{} of {}", n.least, trials);
  if (n.most == trials) return fmt::format("{} of {}", n.least, trials);
  if (n.least == 0) return fmt::format("at most {} of {}", n.most, trials);
  return fmt::format("{} to {} of {}", n.least, n.most, trials);
}

// a solution is called as what the student writes
std::string program_name(const std::string& firmware) { return firmware.substr(firmware.rfind('/') + 1); }

constexpr const char* kHow[] = {"max", "min", "mean", "median"};

double one_of(std::vector<double> v, Shown::How how) {
  std::sort(v.begin(), v.end());
  double sum = 0;
  for (double x : v) sum += x;
  switch (how) {
    case Shown::How::Max:
      return v.back();
    case Shown::How::Min:
      return v.front();
    case Shown::How::Mean:
      return sum / static_cast<double>(v.size());
    case Shown::How::Median:
      return v[v.size() / 2];
  }
  return sum;
}

// one figure, of all trials or of one world's
std::string figure(const StepResult& r, const Shown& shown, const std::string& world) {
  std::vector<double> values;
  for (const TrialResult& t : r.trials)
    if (t.ran && (world.empty() || t.trial.world == world) && std::isfinite(t.measures[shown.measure]))
      values.push_back(t.measures[shown.measure]);
  if (values.empty()) return "";
  const char* how = values.size() > 1 ? kHow[static_cast<int>(shown.how)] : "";
  return words(shown.measure, one_of(std::move(values), shown.how), how);
}

}  // namespace

double share_of(const StepResult& result, double noise_scale) {
  int all = 0, kept = 0;
  for (const TrialResult& t : result.trials)
    if (is_of(t, noise_scale)) ++all, kept += keeps_bounds(t);
  return all ? static_cast<double>(kept) / all : 0;
}

bool has_run(const StepResult& result) {
  return result.problem.empty() &&
         std::all_of(result.trials.begin(), result.trials.end(), [](const TrialResult& t) { return t.ran; });
}

bool is_passed(const StepResult& result) {
  if (!has_run(result)) return false;
  const Step& step = *result.step;
  if (step.kind == Step::Kind::Answer) return true;
  for (std::size_t i = 0; i < step.shares.size(); ++i) {
    const double scale = step.shares.size() > 1 ? step.noise_scales[i] : std::nan("");
    const double share = share_of(result, scale);
    if (share < step.shares[i].low || share > step.shares[i].high) return false;
  }
  return true;
}

std::string asked_by(const Step& step, std::size_t trials) {
  if (step.kind == Step::Kind::Answer || trials == 0) return "";
  std::string bounds;
  for (std::size_t m = 0; m < kMeasures; ++m) {
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    for (const Bound& b : step.bounds)
      if (b.measure == static_cast<Measure>(m)) low = std::max(low, b.low), high = std::min(high, b.high);
    if (std::isinf(low) && std::isinf(high)) continue;
    bounds += (bounds.empty() ? "" : ", ") + bound_text(static_cast<Measure>(m), low, high);
  }
  if (bounds.empty()) bounds = "a run without a trap";
  if (step.kind == Step::Kind::Sensor) return "needs " + bounds;
  if (step.shares.size() == 1) {
    const std::string count = count_text(needed(step.shares[0], trials), trials);
    if (trials == 1 && count == "all 1") return "needs " + bounds;
    return count.empty() ? "" : "needs " + count + ": " + bounds;
  }
  std::string counts;  // of one noise scale each
  const std::size_t each = trials / step.noise_scales.size();
  for (std::size_t i = 0; i < step.shares.size() && each > 0; ++i) {
    const std::string count = count_text(needed(step.shares[i], each), each);
    if (!count.empty())
      counts += fmt::format("{}{} at noise {:g}", counts.empty() ? "" : ", ", count, step.noise_scales[i]);
  }
  return counts.empty() ? "" : "needs " + counts + ": " + bounds;
}

const TrialResult* telling_trial(const StepResult& result) {
  const Step& step = *result.step;
  for (const TrialResult& t : result.trials)
    if (!t.ran) return &t;
  for (std::size_t i = 0; i < step.shares.size(); ++i) {
    const double scale = step.shares.size() > 1 ? step.noise_scales[i] : std::nan("");
    const double share = share_of(result, scale);
    if (share >= step.shares[i].low && share <= step.shares[i].high) continue;
    const bool wanted = share > step.shares[i].high;  // too many kept them
    for (const TrialResult& t : result.trials)
      if (is_of(t, scale) && keeps_bounds(t) == wanted) return &t;
  }
  return nullptr;
}

std::string to_text(const StepResult& result, bool times) {
  const Step& step = *result.step;
  if (!result.problem.empty()) return result.problem;
  if (step.kind == Step::Kind::Answer) {
    std::string anchor = step.answer;
    for (char& c : anchor) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return "docs/lab-answers.md#" + anchor;
  }
  std::string text = step.says;
  if (step.kind == Step::Kind::Runs && step.noise_scales.size() > 1) {
    text = step.says + " by noise scale:";
    for (double scale : step.noise_scales)
      text += fmt::format(" {:g}: {:.0f} %", scale, 100 * share_of(result, scale));
  } else if (step.kind == Step::Kind::Runs) {
    int kept = 0;
    for (const TrialResult& t : result.trials) kept += keeps_bounds(t);
    text = fmt::format("{} of {} {}", kept, result.trials.size(), step.says);
  }
  const std::vector<std::string> all{""};
  for (const std::string& world : step.by_world ? step.worlds : all) {
    std::string figures;
    for (const Shown& shown : step.shown) {
      if (shown.measure == Measure::Speed && !times) continue;
      const std::string one = figure(result, shown, world);
      if (!one.empty()) figures += (figures.empty() ? "" : ", ") + one;
    }
    if (figures.empty()) continue;
    text += world.empty() ? ", " + figures : fmt::format(" [{}: {}]", world, figures);
  }
  for (const TrialResult& t : result.trials)
    if (!t.said.empty()) text += ", \"" + t.said + "\"";
  return text;
}

std::string measures_text(const TrialResult& trial) {
  std::string text;
  for (std::size_t i = 0; i < kMeasures; ++i) {
    const auto m = static_cast<Measure>(i);
    bool is_meant = false;
    for (const Bound& b : trial.trial.step->bounds) is_meant = is_meant || b.measure == m;
    for (const Shown& s : trial.trial.step->shown)
      is_meant = is_meant || (s.measure == m && m != Measure::Speed);
    if (!is_meant || std::isnan(trial.measures[m])) continue;
    text += (text.empty() ? "" : ", ") + (std::isinf(trial.measures[m]) ? "no " + name_and_unit(m).first
                                                                        : words(m, trial.measures[m], ""));
  }
  return text.empty() ? "it did not run to its end" : text;
}

std::string csv_header() {
  std::string line = "exercise,world,firmware,noise_scale,seed,kept";
  for (std::size_t i = 0; i < kMeasures; ++i)
    line += std::string(",") + measure_name(static_cast<Measure>(i));
  return line + ",digest\n";
}

std::string csv_rows(const std::string& exercise, const StepResult& result) {
  std::string text;
  for (const TrialResult& t : result.trials) {
    text += fmt::format("{},{},{},{},{},{}", exercise, t.trial.world, program_name(t.trial.step->firmware),
                        std::isnan(t.trial.noise_scale) ? "" : fmt::format("{:g}", t.trial.noise_scale),
                        t.trial.seed, keeps_bounds(t) ? 1 : 0);
    // what never came to pass has no figure
    for (double v : t.measures.value) text += std::isfinite(v) ? fmt::format(",{:.6g}", v) : ",";
    text += t.digest ? fmt::format(",{:016x}\n", *t.digest) : ",\n";
  }
  return text;
}

sim::SharePlot share_plot(const StepResult& result) {
  const Step& step = *result.step;
  const int runs = static_cast<int>(result.trials.size() / step.noise_scales.size());
  sim::SharePlot plot;
  plot.title = fmt::format("{} in {}: runs that {} within {:g} s, of {} each", program_name(step.firmware),
                           step.worlds[0], step.says, result.trials[0].trial.seconds, runs);
  plot.across = "noise scale of the proximity sensors";
  for (const double scale : step.noise_scales) plot.points.push_back({scale, share_of(result, scale), runs});
  return plot;
}

}  // namespace lab
