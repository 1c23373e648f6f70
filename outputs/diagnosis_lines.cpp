// SPDX-License-Identifier: MIT
#include "outputs/diagnosis_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include "outputs/summary.h"

namespace outputs {

namespace {

constexpr unsigned long kWord = 2;  // bytes from one register to the next

/// The address that a diagnosis is about, and that its sentence begins with.
bool is_of_address(const board::Diagnosis& d, unsigned long& address) {
  char* end = nullptr;
  address = std::strtoul(d.place.c_str(), &end, 16);
  return d.place.rfind("0x", 0) == 0 && *end == 0 && d.message.rfind(d.place + ": ", 0) == 0;
}

}  // namespace

std::vector<board::Diagnosis> joined(const std::vector<board::Diagnosis>& all) {
  // alike but for the address, by the address
  std::map<std::tuple<std::string, std::string, std::string>, std::map<unsigned long, std::size_t>> alike;
  std::vector<board::Diagnosis> out;
  unsigned long address = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const board::Diagnosis& d = all[i]; is_of_address(d, address))
      alike[{d.cause, d.message.substr(d.place.size()), d.hint}][address] = i;
    else
      out.push_back(d);

  for (const auto& [what, places] : alike)
    for (auto first = places.begin(); first != places.end();) {
      board::Diagnosis range = all[first->second];
      auto last = first;
      for (auto next = std::next(first); next != places.end() && next->first == last->first + kWord; ++next) {
        const board::Diagnosis& d = all[next->second];
        range.count += d.count;
        range.first = std::min(range.first, d.first);
        range.first_s = std::min(range.first_s, d.first_s);
        last = next;
      }
      if (last != first) {
        range.place += " to " + all[last->second].place;
        range.message = range.place + std::get<1>(what);
      }
      out.push_back(std::move(range));
      first = std::next(last);
    }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& a, const auto& b) { return a.first_s < b.first_s; });
  return out;
}

std::vector<std::string> DiagnosisLines::of(const std::string& robot,
                                            const std::vector<board::Diagnosis>& all) {
  std::vector<std::string> lines;
  for (const board::Diagnosis& d : joined(all))
    if (++told_[d.cause] <= kMostOfACause) lines.push_back(to_text(robot, d));
  return lines;
}

std::vector<std::string> DiagnosisLines::left_out() const {
  std::vector<std::string> lines;
  for (const auto& [cause, count] : told_)
    if (count > kMostOfACause)
      lines.push_back(fmt::format("and {} more: {}; --summary FILE lists all", count - kMostOfACause, cause));
  return lines;
}

}  // namespace outputs
