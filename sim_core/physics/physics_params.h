// SPDX-License-Identifier: MIT
// Every number of the motion engines: what it is, its unit, and where it comes from.
#pragma once

namespace sim {

/// Box2D lengths per metre: its slop of 0.005 units is then 0.05 mm. At 1 a robot would
/// stop 10 mm from a wall.
inline constexpr double kBox2dUnitsPerMetre = 100;  // [measured: docs/dev/inside.md, gap 0.05 mm for a disc]
/// A robot that is nearer than this to a body that moves takes part in the solver, m.
inline constexpr double kMeetingM = 0.0002;  // [measured: Box2D sees contacts up to its skin of 0.1 mm]
/// A robot whose free room falls below this looks at every tick what it may meet, m.
inline constexpr double kSolverMarginM =
    0.0015;  // [assumed: above Box2D's own skin of 0.1 mm, below what rays see]
/// Bodies whose heights overlap by less than this pass over each other, m.
inline constexpr double kHeightOverlapM =
    0.0005;  // [assumed: a box that stands on another must not hit it sideways]
/// Bodies nearer than this in the plane count as touching in the kinematic engine, m.
inline constexpr double kTouchM = 0.0001;  // [assumed: the skin that Box2D leaves in the dynamic engine]
/// Overlap of bodies in contact, m.
inline constexpr double kContactDepthM = 0.00005;  // [Box2D: b2_linearSlop, 0.005 units]
/// A touch that ends and begins again within this time, or within so many ticks of its last
/// one, is one touch, s.
inline constexpr double kTouchGapS = 0.02;  // [assumed: a bounce that nobody would count twice]
inline constexpr int kTouchGapTicks = 2;    // [assumed: one tick without touch is the solver's]
/// Solver iterations for speeds and positions.
inline constexpr int kVelocityIterations = 8;  // [Box2D manual: 8 and 3 suggested]
inline constexpr int kPositionIterations = 3;  // [Box2D manual: 8 and 3 suggested]
/// Bodies that meet something more slowly than this do not bounce, m/s.
inline constexpr double kLeastBounceMS = 0.01;  // [Webots: ContactProperties.bounceVelocity]
/// Bounces of one body within a tick before it counts as lying.
inline constexpr int kMostBouncesPerTick = 256;  // [assumed: twice those of 32 Hz, restitution 1, 80 m/s2]
/// Part of gravity's pull that makes a ball roll down a slope; the rest goes into its spin.
inline constexpr double kRollingShare = 5.0 / 7;  // [derived: a solid ball, inertia 2/5 m r2]
/// Loose objects fall over steps of the ground that are higher than this, and contacts look at heights anew
/// when a robot has risen by as much, m.
inline constexpr double kLedgeM = 0.002;  // [assumed: more than a tick's way down any slope]
/// How deep solids may be inside each other before libccd's answer counts, m.
inline constexpr double kRestSlackM = 0.0001;  // [assumed: ten times smaller than any wall]
/// How often wheel noise is drawn anew, s; independent of the tick rate.
inline constexpr double kWheelNoisePeriodS =
    1.0 / 32;  // [assumed: the two 16 ms steps of common Webots worlds]

/// A wheel's angle that comes this near to where its course would have led is on it, rad.
inline constexpr double kSameAngleRad = 1e-9;  // [assumed: a million times less than a motor step]
/// Lists of neighbours count on a pace this much above the fastest body's, and at least on the other, m/s.
inline constexpr double kPaceReserve = 1.25;  // [measured: few raises, few lists, in the bench's worlds]
inline constexpr double kLeastPaceMS = 0.02;  // [assumed: a sixth of a robot's full speed]

}  // namespace sim
