// SPDX-License-Identifier: MIT
// The error of the cycle estimate against exact counts of real XC16 code (xc16-cycles/, -O1): recomputed on
// every run from the sources. What is compared is cycles_own: library routines left out, their CALLs
// included.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "fake_host.h"
#include "hal_sim/cc/cost_params.h"
#include "hal_sim/cc/object_cache.h"
#include "twinpuck_paths.h"

extern "C" __attribute__((visibility("default"))) long long tp_bench_counts[4096];
long long tp_bench_counts[4096];
extern "C" __attribute__((visibility("default"))) uint16_t LATG, PORTG, TRISG;
uint16_t LATG, PORTG, TRISG;

namespace {

namespace fs = std::filesystem;

std::vector<std::vector<std::string>> rows_of(const fs::path& csv) {
  std::vector<std::vector<std::string>> rows;
  std::ifstream in(csv);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    rows.push_back(row);
  }
  return rows;
}

int rule_named(const std::string& name) {
  for (int r = 0; r < cc::kRuleCount; ++r)
    if (name == cc::kRuleNames[r]) return r;
  return -1;
}

/// Estimated own cycles of each function of a file while bench_run() ran once; checks the computed value too.
std::map<std::string, double> estimate(const fs::path& source, const fs::path& work,
                                       const std::string& expected) {
  std::map<std::string, double> cycles;
  fs::path base = work / source.stem();
  std::string o = base.string() + ".o", so = base.string() + ".so", dump = base.string() + ".dump";
  auto compiled = cc::run_process({std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc", "-c", source.string(),
                                   "-o", o, "-O1", "-fvisibility=default", "--cost-dump", dump});
  EXPECT_EQ(compiled.status, 0) << compiled.output;
  fs::path control = work / "control.c";
  std::ofstream(control) << "struct { long long a, b; } tp_ctl __attribute__((visibility(\"hidden\")));";
  auto linked = cc::run_process({"gcc", "-shared", "-fPIC", "-Wl,-Bsymbolic", o, control.string(), "-o", so});
  EXPECT_EQ(linked.status, 0) << linked.output;
  void* image = dlopen(so.c_str(), RTLD_NOW);
  EXPECT_NE(image, nullptr) << (image ? "" : dlerror());
  if (!image) return cycles;
  std::fill(std::begin(tp_bench_counts), std::end(tp_bench_counts), 0);
  // the bench returns a 32-bit long
  auto bench = reinterpret_cast<int (*)()>(dlsym(image, "bench_run"));
  EXPECT_NE(bench, nullptr);
  if (!bench) return cycles;
  EXPECT_EQ(unsigned(bench()), std::stoul(expected, nullptr, 16)) << source;
  std::ifstream in(dump);
  int segment = 0;
  for (std::string line; std::getline(in, line); ++segment) {
    std::istringstream words(line);
    std::string function, pair;
    words >> function;
    double sum = 0;
    while (words >> pair) {
      auto at = pair.find('=');
      int rule = rule_named(pair.substr(0, at));
      EXPECT_GE(rule, 0) << pair;
      if (rule >= 0) sum += std::stod(pair.substr(at + 1)) * cc::kRuleCycles[size_t(rule)];
    }
    cycles[function] += sum * double(tp_bench_counts[segment]);
  }
  dlclose(image);
  return cycles;
}

}  // namespace

TEST(cycles, estimate_is_within_the_published_error) {
  fs::path data = fs::path(TWINPUCK_SOURCE_DIR) / "tests/cc/xc16-cycles";
  fake::Folder folder;
  std::map<std::string, std::string> results;
  for (const auto& row : rows_of(data / "results.csv"))
    if (row.size() == 2 && row[0] != "file") results[row[0]] = row[1];
  std::map<std::string, std::map<std::string, double>> estimates;
  std::vector<std::pair<double, std::string>> errors;
  for (const auto& row : rows_of(data / "cycles.csv")) {
    if (row.size() < 8 || row[2] != "-O1") continue;
    if (!estimates.count(row[1]))
      estimates[row[1]] = estimate(data / "src" / row[1], folder.path, results[row[1]]);
    auto& own = estimates[row[1]];
    bool helper = row[3] == "helper";
    double expected = std::stod(helper ? row[7] : row[6]), got = 0;
    for (const auto& [name, cycles] : own)
      if (helper ? name == row[0] : name != "bench_run") got += cycles;
    errors.emplace_back(std::fabs(got / expected - 1), row[0]);
    EXPECT_LT(std::max(got / expected, expected / got), 2.0)
        << row[0] << ": got " << got << ", expected " << expected << " (cycles)";
  }
  std::sort(errors.begin(), errors.end());
  ASSERT_EQ(errors.size(), 78u);
  double median = errors[39].first, ninth = errors[70].first, worst = errors.back().first;
  std::printf("cycle estimate: median error %.1f %%, nine in ten within %.1f %%, worst %.1f %% (%s)\n",
              median * 100, ninth * 100, worst * 100, errors.back().second.c_str());
  EXPECT_LE(median, 0.04);
  EXPECT_LE(ninth, 0.15);
  EXPECT_LE(worst, 0.25);
}
