// SPDX-License-Identifier: MIT
// What was found in a .wbt file, in our axes (metres, z up), before it is decided what the floor is.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "import/piece.h"
#include "import/report.h"

namespace wbt {

/// Something that stands in the world: a Solid with all its pieces.
struct Body {
  std::string type, name, def;
  int line = 0;
  std::vector<Piece> pieces;
  bool movable = false;
  double mass_kg = 0;  ///< of a movable one; 0 or less: by density
  double density_kg_m3 = kDensityKgM3;
  std::string contact = "default";  ///< material of WorldInfo.contactProperties
  bool robot_like = false;          ///< a Robot node that is no e-puck
  std::string model;                ///< what cameras that recognise call it
  std::vector<sim::Colour> recognition;
  bool untouched = false;  ///< without boundingObject: neither wheels nor distance sensors notice it
};

struct Device {
  std::string name, kind;
  std::optional<int> channel;
  std::optional<double> range_m;
  std::optional<double> baud_rate_bit_s;
  std::optional<int> width, height;
  bool infra_red = false;
  // of what measures distances: place and way on the robot (ahead, left, up), and what it sees
  sim::Vec3 at;
  double heading_rad = 0;
  std::optional<double> fov_rad, vertical_fov_rad, near_m, far_m, aperture_rad;
  std::vector<sim::ResponseRow> table;
  int rays = 1;
};

struct FoundRobot {
  std::string type, name, def, controller, args, custom_data;
  bool supervisor = false;
  std::vector<sim::Colour> recognition;
  int line = 0;
  sim::Pose2 pose;
  double z_m = 0;
  bool kinematic = false;
  bool by_proto = true;  ///< the E-puck PROTO, not plain nodes
  std::optional<double> speed_unit_rad_s;
  double slip_noise = 0;
  std::optional<double> battery_wh;
  std::string camera_mount;
  std::vector<std::string> parts;
  std::vector<Device> devices;
  sim::ProximitySettings proximity;
  std::vector<sim::SensorDesc> sensors;
};

struct FoundArena {
  std::string type;
  int line = 0;
  Vec2 at, size;
  double heading_rad = 0;
  double z_m = 0;
  double wall_height_m = 0;  ///< 0: no walls
  double wall_thickness_m = kArenaWallThicknessM;
  bool round = false;  ///< walls on the circle in `size`
  std::optional<Surface> floor, walls;
  std::string image;  ///< file of a picture that covers it once; empty: none
};

struct FoundSupervisor {
  std::string type, name, def, controller, args, custom_data;
  std::vector<Device> devices;
  int line = 0;
};

struct Contact {
  std::string one, other;
  double friction = kContactFriction;
  double bounce = kContactBounce;
};

struct FoundLamp {
  sim::LampDesc lamp;
  double ambient_w_m2 = 0;
  int line = 0;
  std::string type;
};

struct Scene {
  std::string title;
  std::vector<std::string> info;
  std::string version;
  bool nue = false;
  double time_step_s = kBasicTimeStepMs / 1000;
  std::optional<double> gravity_m_s2;
  std::optional<std::uint64_t> seed;
  bool planar = false;
  bool new_sensors = false;    ///< readings of R2020b on
  bool uniform_noise = false;  ///< noise law of V7 and before
  std::optional<sim::Colour> sky;
  std::vector<Contact> contacts;
  std::vector<Body> bodies;
  std::vector<FoundRobot> robots;
  std::vector<FoundArena> arenas;
  std::vector<FoundLamp> lamps;
  std::vector<FoundSupervisor> supervisors;
  std::vector<std::string> cosmetic;  ///< nodes that nothing here depends on, "Viewpoint (line 5)"
};

}  // namespace wbt
