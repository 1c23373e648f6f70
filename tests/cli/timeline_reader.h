// SPDX-License-Identifier: MIT
// A strict reader of time lines (Trace Event Format, the JSON array): what Perfetto and chrome://tracing
// ask of every event, and that the slices of a track lie within one another or apart. Viewers drop or
// bend what does not.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cli_test {

/// Nanoseconds of a time in microseconds, which has three decimals at most.
inline std::int64_t event_ns(const nlohmann::json& us) {
  const double ns = us.get<double>() * 1000;
  EXPECT_NEAR(ns, std::round(ns), 1e-3);
  return static_cast<std::int64_t>(std::llround(ns));
}

inline void check_timeline(const nlohmann::json& events) {
  struct Slice {
    std::int64_t begin, end;
    std::string name;
  };
  std::map<std::pair<int, int>, std::vector<Slice>> tracks;
  std::map<std::pair<int, std::string>, std::int64_t> curves;  // the last point
  std::set<std::pair<int, int>> named;
  std::set<int> processes;
  ASSERT_TRUE(events.is_array());
  for (const auto& e : events) {
    ASSERT_TRUE(e.is_object());
    ASSERT_TRUE(e.at("name").is_string() && e.at("ph").is_string()) << e;
    ASSERT_TRUE(e.at("pid").is_number_integer()) << e;
    const std::string name = e["name"], phase = e["ph"];
    const int pid = e["pid"], tid = e.value("tid", 0);
    if (phase == "M") {  // the names and orders that the format knows
      ASSERT_TRUE(name == "process_name" || name == "thread_name" || name == "thread_sort_index" ||
                  name == "process_sort_index")
          << e;
      ASSERT_TRUE(e.at("args").is_object()) << e;
      const bool is_new = name == "process_name"  ? processes.insert(pid).second
                          : name == "thread_name" ? named.insert({pid, tid}).second
                                                  : true;
      EXPECT_TRUE(is_new) << "named twice: " << e;
      continue;
    }
    ASSERT_TRUE(e.at("ts").is_number()) << e;
    const std::int64_t at = event_ns(e["ts"]);
    EXPECT_GE(at, 0) << e;
    if (phase == "X") {
      ASSERT_TRUE(e.at("tid").is_number_integer() && e.at("dur").is_number()) << e;
      EXPECT_GE(e["dur"].get<double>(), 0) << e;
      tracks[{pid, tid}].push_back({at, at + event_ns(e["dur"]), name});
      const nlohmann::json args = e.value("args", nlohmann::json::object());
      for (const auto& [key, value] : args.items()) EXPECT_TRUE(value.is_number()) << key << " in " << e;
    } else if (phase == "C") {
      ASSERT_EQ(e.at("args").size(), 1u) << e;
      for (const auto& [key, value] : e["args"].items()) EXPECT_TRUE(value.is_number()) << key << " in " << e;
      const auto [last, is_first] = curves.insert({{pid, name}, at});
      EXPECT_TRUE(is_first || at > last->second) << "the curve goes back: " << e;
      last->second = at;
    } else {
      ASSERT_EQ(phase, "i") << e;  // an instant: of a process, or of all
      const std::string scope = e.at("s");
      EXPECT_TRUE(scope == "g" || scope == "p" || scope == "t") << e;
    }
  }
  for (auto& [track, slices] : tracks) {
    EXPECT_TRUE(named.count(track)) << "a track without a name: " << track.first << "/" << track.second;
    EXPECT_TRUE(processes.count(track.first));
    std::stable_sort(slices.begin(), slices.end(), [](const Slice& a, const Slice& b) {
      return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
    });
    std::vector<const Slice*> open;
    for (const Slice& s : slices) {
      while (!open.empty() && open.back()->end <= s.begin) open.pop_back();
      EXPECT_TRUE(open.empty() || s.end <= open.back()->end)
          << s.name << " at " << s.begin << " ns reaches out of the slice that it begins in";
      open.push_back(&s);
    }
  }
}

}  // namespace cli_test
