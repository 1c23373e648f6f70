// SPDX-License-Identifier: MIT
// The grid covers the fixed solids and one cell around them; whatever is outside is binned
// in the border cells.
#include "sim_core/geometry/neighbours.h"

#include <algorithm>

#include "sim_core/base/check.h"

namespace sim {
namespace {

constexpr int kMostCells =
    4'000'000;  // of the grid: a huge empty arena gets larger cells' worth of border instead

constexpr Clicks kLongest = 100'000'000;  // longer than lists last

/// Axis-aligned box of a placed solid in the plane.
struct Extent {
  double x0, y0, x1, y1;
};

Extent extent(const Placed& p) {
  if (p.solid->kind != SolidKind::Prism) {
    const double r = p.solid->radius_m;
    return {p.frame.at.x - r, p.frame.at.y - r, p.frame.at.x + r, p.frame.at.y + r};
  }
  Extent e{1e300, 1e300, -1e300, -1e300};
  for (const Vec2& corner : p.solid->outline) {
    const Vec2 w = p.frame.to_world(corner);
    e = {std::min(e.x0, w.x), std::min(e.y0, w.y), std::max(e.x1, w.x), std::max(e.y1, w.y)};
  }
  return e;
}

/// After a counting sort that moved each cell's end to its beginning: shifts back.
void restore(std::vector<std::int32_t>& first, std::size_t items) {
  std::copy(first.begin() + 1, first.end(), first.begin());
  first.back() = static_cast<std::int32_t>(items);
}

}  // namespace

Neighbours::Neighbours(const std::vector<Placed>& fixed, std::vector<double> moving_bound_m, int robots,
                       std::vector<double> reach_m)
    : fixed_(fixed), bound_m_(std::move(moving_bound_m)), robots_(robots), reach_m_(std::move(reach_m)) {
  CHECK(static_cast<int>(reach_m_.size()) == robots, "one reach per robot");
  for (double b : bound_m_) largest_bound_m_ = std::max(largest_bound_m_, b);
  Extent all{1e300, 1e300, -1e300, -1e300};
  std::vector<Extent> boxes;
  for (const Placed& p : fixed_) {
    boxes.push_back(extent(p));
    const Extent& e = boxes.back();
    all = {std::min(all.x0, e.x0), std::min(all.y0, e.y0), std::max(all.x1, e.x1), std::max(all.y1, e.y1)};
  }
  if (fixed_.empty()) all = {-10, -10, 10, 10};
  x0_ = all.x0 - kCellM;
  y0_ = all.y0 - kCellM;
  columns_ = static_cast<int>(std::min(20000.0, (all.x1 - x0_) / kCellM)) + 2;
  rows_ = static_cast<int>(std::min(20000.0, (all.y1 - y0_) / kCellM)) + 2;
  while (static_cast<double>(columns_) * rows_ > kMostCells) (columns_ > rows_ ? columns_ : rows_) /= 2;

  // counting sort of the fixed solids by every cell their box touches
  fixed_first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  const auto each_cell = [&](const Extent& box, auto visit) {
    for (int y = cell_y(box.y0); y <= cell_y(box.y1); ++y)
      for (int x = cell_x(box.x0); x <= cell_x(box.x1); ++x)
        visit(fixed_first_.data() + static_cast<std::size_t>(y) * columns_ + x);
  };
  for (const Extent& box : boxes) each_cell(box, [](std::int32_t* first) { ++first[1]; });
  for (std::size_t c = 1; c < fixed_first_.size(); ++c) fixed_first_[c] += fixed_first_[c - 1];
  fixed_items_.resize(static_cast<std::size_t>(fixed_first_.back()));
  // from the last one on, each cell's end is moved to its beginning
  for (std::size_t i = boxes.size(); i-- > 0;)
    each_cell(boxes[i], [&](std::int32_t* first) {
      fixed_items_[static_cast<std::size_t>(--first[1])] = static_cast<int>(i);
    });
  restore(fixed_first_, fixed_items_.size());
  moving_first_.assign(fixed_first_.size(), 0);
  moving_items_.resize(bound_m_.size());
  cell_of_.resize(bound_m_.size());
  place_.resize(bound_m_.size());
  clearance_.assign(static_cast<std::size_t>(robots_), 0.0);
  alone_for_.assign(static_cast<std::size_t>(robots_), 0);
  first_.assign(static_cast<std::size_t>(robots_) + 1, 0);
}

int Neighbours::cell_x(double x) const {
  return static_cast<int>(std::clamp((x - x0_) * (1 / kCellM), 0.0, static_cast<double>(columns_ - 1)));
}

int Neighbours::cell_y(double y) const {
  return static_cast<int>(std::clamp((y - y0_) * (1 / kCellM), 0.0, static_cast<double>(rows_ - 1)));
}

void Neighbours::rebuild(const std::vector<Placed>& moving, double history_m, double pace_m_s, Clicks at) {
  CHECK(moving.size() == bound_m_.size(), "bodies neither come nor go");
  // Bin the bodies: count those of each cell, then put them one cell behind the other.
  std::fill(moving_first_.begin(), moving_first_.end(), 0);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    place_[i] = moving[i].frame.at;
    cell_of_[i] = cell_y(place_[i].y) * columns_ + cell_x(place_[i].x);
    ++moving_first_[static_cast<std::size_t>(cell_of_[i]) + 1];
  }
  for (std::size_t c = 1; c < moving_first_.size(); ++c) moving_first_[c] += moving_first_[c - 1];
  for (std::size_t i = moving.size(); i-- > 0;) {
    // filling each cell from its end keeps a cell's bodies in order of their index
    const std::size_t c = static_cast<std::size_t>(cell_of_[i]);
    moving_items_[static_cast<std::size_t>(--moving_first_[c + 1])] = static_cast<int>(i);
  }
  restore(moving_first_, moving.size());

  // For each robot the list of what it may come near.
  list_.clear();
  far_for_.clear();
  at_ = at;
  // less than a click or two, which rounding may take
  const double clicks_per_m = pace_m_s > 0 ? (kClicksPerSecond - 2) / pace_m_s : 1e18;
  for (int r = 0; r < robots_; ++r) {
    const std::size_t i = static_cast<std::size_t>(r);
    first_[i] = static_cast<std::int32_t>(list_.size());
    const double own_m = bound_m_[i];
    const double reach = std::max(reach_m_[i], own_m) + kSkinM + 2 * history_m;
    gather(place_[i], reach, list_);
    // drop the robot itself and what is too far after all; measure the clearance on the way
    double clear = reach - own_m;
    Clicks alone_for = kLongest;
    std::size_t kept = static_cast<std::size_t>(first_[i]);
    for (std::size_t k = kept; k < list_.size(); ++k) {
      const Candidate c = list_[k];
      if (c.moving && c.index == r) continue;
      const double gap = plan_distance_m(place_[i], c.moving ? moving[static_cast<std::size_t>(c.index)]
                                                             : fixed_[static_cast<std::size_t>(c.index)]);
      if (gap > reach) continue;
      clear = std::min(clear, gap - own_m);
      // for so long it need not be looked at: a body may come towards it as fast as it goes itself
      const double free_m = (c.moving ? 0.5 : 1) * (gap - reach_m_[i]);
      far_for_.push_back(
          free_m > 0 ? static_cast<Clicks>(std::min(free_m * clicks_per_m, static_cast<double>(kLongest)))
                     : 0);
      alone_for = std::min(alone_for, far_for_.back());
      list_[kept++] = c;
    }
    list_.resize(kept);
    clearance_[i] = clear;
    alone_for_[i] = alone_for;
  }
  first_.back() = static_cast<std::int32_t>(list_.size());
}

void Neighbours::gather(Vec2 point, double radius_m, std::vector<Candidate>& out) const {
  const std::size_t begin = out.size();
  const int fx0 = cell_x(point.x - radius_m), fx1 = cell_x(point.x + radius_m);
  const int fy0 = cell_y(point.y - radius_m), fy1 = cell_y(point.y + radius_m);
  for (int y = fy0; y <= fy1; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * columns_;
    for (std::int32_t k = fixed_first_[row + fx0]; k < fixed_first_[row + fx1 + 1]; ++k)
      out.push_back({fixed_items_[static_cast<std::size_t>(k)], false});
  }
  // a long wall lies in several cells: keep it once
  if (out.size() - begin > 1 && (fx1 > fx0 || fy1 > fy0)) {
    const auto first = out.begin() + static_cast<std::ptrdiff_t>(begin);
    std::sort(first, out.end(), [](const Candidate& a, const Candidate& b) { return a.index < b.index; });
    out.erase(std::unique(first, out.end(),
                          [](const Candidate& a, const Candidate& b) { return a.index == b.index; }),
              out.end());
  }
  const double wide = radius_m + largest_bound_m_;
  const int mx0 = cell_x(point.x - wide), mx1 = cell_x(point.x + wide);
  const int my0 = cell_y(point.y - wide), my1 = cell_y(point.y + wide);
  for (int y = my0; y <= my1; ++y) {
    const std::size_t row = static_cast<std::size_t>(y) * columns_;
    for (std::int32_t k = moving_first_[row + mx0]; k < moving_first_[row + mx1 + 1]; ++k) {
      const std::int32_t i = moving_items_[static_cast<std::size_t>(k)];
      const Vec2 gap = place_[static_cast<std::size_t>(i)] - point;
      const double limit = radius_m + bound_m_[static_cast<std::size_t>(i)];
      if (dot(gap, gap) <= limit * limit) out.push_back({i, true});
    }
  }
}

}  // namespace sim
