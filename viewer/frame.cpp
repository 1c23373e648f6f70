// SPDX-License-Identifier: MIT
#include "viewer/frame.h"

#include <algorithm>

#include "sim_core/light/proximity.h"

namespace viewer {

namespace {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "frames are little endian");
constexpr std::size_t kRayBytes = 7 * sizeof(float);

template <typename T>
void put(std::string& out, T value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}
void put_float(std::string& out, double value) { put(out, static_cast<float>(value)); }

/// Not only at this instant: a wave goes through 0.
bool is_sounding(const host::FirmwareMind& mind) {
  const board::Codec& codec = mind.board().codec();
  if (!codec.was_used()) return false;
  for (int i = 0; i < 8; ++i)
    if (codec.output(std::max<board::Cycle>(0, mind.now() - i * board::kCodecSampleCycles)) != 0) return true;
  return false;
}

}  // namespace

std::string frame_bodies(twin::Twin& twin) {
  const sim::Scene& scene = twin.simulation().scene();
  std::string out;
  out.reserve(static_cast<std::size_t>(scene.bodies()) * 16 + static_cast<std::size_t>(twin.robots()) * 8);
  for (int b = 0; b < scene.bodies(); ++b) {
    const sim::Pose2 p = scene.pose(b, scene.now());
    put_float(out, p.x_m);
    put_float(out, p.y_m);
    put_float(out, scene.z_m(b));
    put_float(out, p.heading_rad);
  }
  for (int r = 0; r < twin.robots(); ++r) {
    const host::FirmwareMind& mind = std::as_const(twin).mind(r);
    const host::Runner* robot = mind.runner();
    put<std::uint32_t>(out, mind.report().leds);
    std::uint32_t state = 0;
    if (!robot)
      state = kNoProgram;
    else if (robot->has_stopped())
      state = kStopped;
    else if (robot->waiting_since() < host::kNever)
      state = kWaiting;
    if (is_sounding(mind)) state |= kSounding;
    put(out, state);
  }
  return out;
}

std::string frame_rays(twin::Twin& twin, const std::vector<int>& robots) {
  const sim::Scene& scene = twin.simulation().scene();
  std::string out;
  for (int r : robots) {
    const std::size_t sensors =
        twin.world().model_of(twin.world().robots[static_cast<std::size_t>(r)])->proximity.size();
    for (std::size_t s = 0; s < sensors; ++s)
      for (const sim::RayTrace& ray : sim::trace_proximity(scene, r, static_cast<int>(s), scene.now())) {
        for (const sim::Vec3& p : {ray.from_m, ray.to_m}) {
          put_float(out, p.x);
          put_float(out, p.y);
          put_float(out, p.z);
        }
        put_float(out, ray.hit ? std::clamp(ray.colour_factor, 0.0, 1.0) : -1);
      }
  }
  return out;
}

std::string frame(twin::Twin& twin, const FrameHead& head, const std::vector<double>& values,
                  const std::string& bodies, const std::string& rays) {
  const sim::Scene& scene = twin.simulation().scene();
  std::string out;
  out.reserve(48 + values.size() * 8 + bodies.size() + rays.size());
  out += "TPK1";
  put<std::uint32_t>(out, head.revision);
  put<double>(out, sim::to_seconds(scene.now()));
  put<double>(out, head.pace);
  put<std::uint32_t>(out, head.flags);
  put<std::uint32_t>(out, static_cast<std::uint32_t>(twin.robots()));
  put<std::uint32_t>(out, static_cast<std::uint32_t>(scene.bodies()));
  put<std::uint32_t>(out, static_cast<std::uint32_t>(values.size()));
  put<std::uint32_t>(out, static_cast<std::uint32_t>(rays.size() / kRayBytes));
  put<std::uint32_t>(out, head.subscription);
  for (const double value : values) put<double>(out, value);
  return out + bodies + rays;
}

std::string frame_table() {
  struct Row {
    const char *place, *holds;
  };
  constexpr Row kRows[] = {
      {"0", "`TPK1`"},
      {"4", "u32 revision of the `world` event it belongs to"},
      {"8", "f64 time, s"},
      {"16", "f64 pace, simulated seconds a second"},
      {"24", "u32 flags: 1 plays, 2 ended"},
      {"28, 32, 36, 40", "u32 robots, bodies (robots, then movable objects), values, rays"},
      {"44", "u32 subscription that the values are of"},
      {"48", "f64 each value"},
      {"then", "f32 x, y, z, heading (m, rad) of each body"},
      {"then",
       "u32 LEDs, u32 state of each robot: 1 no program, 2 stopped by a trap, 4 waits, 8 its loudspeaker "
       "sounds"},
      {"then",
       "f32 x 7 of each ray: from, to, and how much of its light comes back, 0 to 1; -1: nothing was met"},
  };
  std::string out =
      "Binary messages are frames, little endian, at most 60 a second; a slow client gets fewer.\n\n| bytes "
      "| "
      "|\n|---|---|\n";
  for (const Row& row : kRows) out += std::string("| ") + row.place + " | " + row.holds + " |\n";
  return out;
}

}  // namespace viewer
