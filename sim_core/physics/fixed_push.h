// SPDX-License-Identifier: MIT
// What fixed solids and the wheels did to a robot in a tick: the next one begins with it (fixed_contacts.cpp).
#pragma once
#include <array>
#include <cstddef>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/pose.h"

namespace sim {

/// A fixed solid within a tick's reach of a robot. Blows are changes of the robot's speed.
struct FixedContact {
  int solid = 0;
  Vec2 normal;           ///< out of the solid
  double least_m_s = 0;  ///< speed along the normal that must be kept; negative while there is room
  double friction = 0;
  double blow_m_s = 0, rub_m_s = 0;
};

inline constexpr std::size_t kMostFixedContacts = 4;  ///< a robot in a corner meets two

/// What pushed a robot at fixed solids in a tick.
struct FixedPush {
  Clicks end = -1;  ///< of the tick
  Vec2 push_m_s;    ///< by the wheels
  double twist_rad_s = 0;
  std::size_t count = 0;
  std::array<FixedContact, kMostFixedContacts> contacts;
};

}  // namespace sim
