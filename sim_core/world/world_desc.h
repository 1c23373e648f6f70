// SPDX-License-Identifier: MIT
// A world as pure data: what a world file says, in SI units and radians, ready to be built. Made by
// load/, or in a few lines of C++. Every field's key, unit, range and default stand once, in
// load/schema.cpp and docs/worlds.md.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim_core/geometry/axes.h"
#include "sim_core/world/part_desc.h"
#include "sim_core/world/robot_model.h"

namespace sim {

enum class Engine { Dynamic, Kinematic, Planar };

/// How surfaces look to light.
struct Material {
  std::string name;
  Colour colour;               ///< default white
  double ir_reflectance = -1;  ///< 0 to 1; negative: the red part of the colour
  double roughness = 0;        ///< 0 to 1
  double friction = 0.3;       ///< Coulomb coefficient of the sides
  double restitution = 0;      ///< 0 to 1
};

enum class RayLayout { Cone, Fan };  ///< spread on cones (Webots) or side by side in the plane (Enki)
enum class SensorType { InfraRed, Generic };  ///< with or without a colour rule
enum class ColourRule { Old, New, None };
enum class NoiseLaw { Uniform, Gaussian };

/// One row of a lookup table.
struct ResponseRow {
  double distance_m = 0;
  double value = 0;           ///< counts
  double relative_noise = 0;  ///< fraction of value
};

/// Proximity settings as written: what is not set is inherited (sensor from robot from
/// world from the profile).
struct ProximitySettings {
  std::optional<std::string> profile;             ///< webots-old, webots-new, inverse-square, enki, argos
  std::optional<std::vector<ResponseRow>> table;  ///< own rows, instead of the profile's
  std::optional<SensorType> type;
  std::optional<int> rays;
  std::optional<double> aperture_rad;
  std::optional<double> gaussian_width;
  std::optional<RayLayout> layout;
  std::optional<ColourRule> colour_rule;
  std::optional<NoiseLaw> noise_law;
  std::optional<double> noise_scale;  ///< factor on the table's relative noise; 0 = none

  /// True when nothing is set.
  bool is_empty() const {
    return !profile && !table && !type && !rays && !aperture_rad && !gaussian_width && !layout &&
           !colour_rule && !noise_law && !noise_scale;
  }
};

/// Departures of one robot from its model. Fixed parts as written; the random spread is drawn from the
/// robot's seed by resolve_variation() (world/variation.h).
struct Variation {
  std::vector<double> sensor_gain;           ///< factor per proximity sensor; empty = 1
  std::vector<double> sensor_offset_counts;  ///< added per proximity sensor; empty = 0
  double left_wheel_ratio = 1;               ///< true over nominal wheel radius
  double right_wheel_ratio = 1;
  double axle_ratio = 1;  ///< effective over nominal axle
  double clock_ppm = 0;   ///< positive: the robot's clock is fast
  double boot_delay_s = 0;
  double gain_spread = 0;                     ///< standard deviation of a further factor per sensor
  double offset_spread_counts = 0;            ///< standard deviation, counts
  double wheel_spread = 0;                    ///< standard deviation of a further wheel factor, each side
  double axle_spread = 0;                     ///< standard deviation of a further axle factor
  double clock_spread_ppm = 0;                ///< standard deviation, ppm
  double boot_spread_s = 0;                   ///< the delay grows by a uniform draw from 0 to this
  std::array<double, 3> acc_offset_m_s2{};    ///< added to the accelerometer, robot frame: forward, left, up
  std::array<double, 3> gyro_offset_rad_s{};  ///< added to the gyroscope, same frame
  double acc_offset_spread_m_s2 = 0;          ///< standard deviation of a further offset per axis
  double gyro_offset_spread_rad_s = 0;        ///< standard deviation of a further offset per axis
  double motion_noise_scale = 1;  ///< factor on the noise of accelerometer and gyroscope; 0 = none
};

/// Settings of single sensors.
struct SensorDesc {
  int index = 0;
  ProximitySettings proximity;
};

enum class RadioModel { LogDistance, Disc };

/// The radio channel that robots with a radio share.
struct RadioDesc {
  RadioModel model = RadioModel::LogDistance;
  /// Where a frame sent at full power is just received. [assumed: 15 cm to 5 m, reported for this turret]
  double range_m = 5;
  double exponent = 3.3;  ///< path loss per decade over 10 dB [derived: that span over 50 dB of attenuation]
  double fading_db = 2;   ///< standard deviation of the level, drawn per frame and receiver [assumed: a room]
  double loss = 0;        ///< part of the frames within range that is lost for no other reason, 0 to 1
  double capture_db =
      3;  ///< the stronger of two frames survives from here on [CC2420 SWRS041: co-channel -3 dB]
  bool carrier_sense = true;          ///< listen before sending, with random waits
  std::optional<std::uint64_t> seed;  ///< of fading, loss and waits; unset: the world's
};

/// A time in which links are lost.
struct Dropout {
  double begin_s = 0;
  double span_s = 0;
};

/// The short-range serial links between robots, or from a robot to a computer.
struct LinkDesc {
  double range_m = 10;       ///< [LMX9838 datasheet: class 2 radio, 10 m]
  double latency_s = 0.008;  ///< one way [measured: 50 to 100 commands and answers per second on the robot]
  double bandwidth_bit_s =
      115200;             /**< per direction [assumed: the modules' serial lines are the narrowest part] */
  double timeout_s = 20;  ///< silence after which a link is lost [Bluetooth core: supervision timeout]
  std::vector<Dropout> dropouts;  ///< of every robot, growing
  double dropout_rate_hz = 0;     ///< further ones by chance, per robot
  double dropout_span_s = 1;      ///< their length
};

/// One robot's end of such links.
struct LinkEndDesc {
  int number = -1;                  ///< negative: its index in the world plus 1
  std::optional<std::string> name;  ///< what others find; unset: made of the number by the board
  std::optional<std::string> pin;   ///< unset: the number, four digits
  std::vector<Dropout> dropouts;    ///< of this robot alone, growing
};

/// Motor to Pen, and Position, are there for a program, and do and sense nothing.
enum class DeviceKind {
  Gps,
  Compass,
  Inertial,
  Gyro,
  Emitter,
  Receiver,
  Distance,
  Display,
  Motor,
  Camera,
  Touch,
  Light,
  Led,
  Speaker,
  Pen,
  Lidar,
  RangeFinder,
  Position
};

/// A device that programs written for Webots' interfaces find on a robot, or a supervisor, by its name.
struct DeviceDesc {
  std::string name;
  DeviceKind kind = DeviceKind::Gps;
  int channel = 1;              ///< of emitters and receivers; -1: all
  double range_m = -1;          ///< of emitters; negative: unlimited
  double baud_rate_bit_s = -1;  ///< of emitters; negative: unlimited
  bool infra_red = false;       ///< of emitters: a free line of sight is needed
  int width = 128;              ///< of displays and cameras, pixels
  int height = 64;              ///< likewise
  Vec3 at_m;  ///< of what measures distances: from the robot's middle on the floor: ahead, left, up
  double heading_rad = 0;           ///< likewise, from ahead to the left
  double fov_rad = kPi / 2;         ///< of lidars and range finders: from the left to the right edge
  double vertical_fov_rad = 0.2;    ///< of lidars of several rows
  double near_m = 0.01, far_m = 1;  ///< likewise: what is nearer or farther is not there
  std::vector<ResponseRow> table;   ///< of distance sensors; empty: a supervisor sets the value
  int rays = 1;                     ///< of distance sensors
  double aperture_rad = kPi / 2;    ///< likewise
  int line = 0;                     ///< line in the world file; 0 when built in C++
};

/// A key of a remote control that somebody presses for a robot.
struct KeyDesc {
  int code = 0;         ///< 0 to 63
  double at_s = 0;      ///< s, world time
  double hold_s = 0.1;  ///< s
  int address = 0;      ///< 0 to 31
  int typed = 0;        ///< instead of a remote control's: a keyboard's key, by Webots' number
};

/// What happens between the motors and the floor, as written: what is not set is inherited
/// (robot from world).
struct WheelSettings {
  std::optional<double> noise;  ///< random part of each wheel's travel, drawn anew every 1/32 s; 0: none
  std::optional<NoiseLaw> noise_law;  ///< noise is a half width (uniform, usual) or a standard deviation
  std::optional<double> slip;         ///< fraction of the wheels' travel that is lost on the floor; 0: none
};

struct RobotDesc {
  std::string name;
  std::string def;          ///< second name, by which supervisors may look it up; may be empty
  std::string model;        ///< empty: the only or first model the caller knows
  std::string firmware;     ///< name or path as written; may be empty
  std::string args;         ///< what a program of the PC gets, words as argument_words() has them
  bool supervisor = false;  ///< its program may do what supervisors may
  std::string custom_data;  ///< a text of the robot that programs may read and change
  std::vector<Colour> recognition_colours;  ///< what cameras that recognise tell of it; empty: nothing
  int node = 0;                             ///< line of its node in WebotsDesc::world; 0: none
  OwnValues own;                            ///< of the keys that its model lists
  Pose2 pose;
  std::optional<std::uint64_t> seed;  ///< unset: made of the world's seed and the robot's index
  double battery_v = -1;              ///< V; negative: the model's
  double battery_wh = -1;             ///< Wh when full; negative: the model's
  std::optional<Colour> colour;
  WheelSettings wheels;  ///< what is not set is the world's
  std::string uart1 = "-";
  std::string uart2 = "none";
  LinkEndDesc link;
  Variation variation;
  ProximitySettings proximity;
  std::vector<SensorDesc> sensors;
  std::vector<PartDesc> parts;
  std::vector<KeyDesc> keys;  ///< presses of remote controls, in any order
  std::vector<DeviceDesc> devices;
  int line = 0;  ///< line in the world file; 0 when built in C++
};

enum class ObjectKind { Box, Cylinder, Ball, Polygon };

/// Anything that stands, lies or falls in the arena.
struct ObjectDesc {
  ObjectKind kind = ObjectKind::Box;
  std::string name;
  std::string def;              ///< second name, by which supervisors may look it up; may be empty
  Vec3 size_m{0.1, 0.1, 0.1};   ///< box: x, y, z; otherwise only z counts (height)
  double radius_m = 0.05;       ///< cylinder and ball
  std::vector<Vec2> corners_m;  ///< polygon, in its own frame
  Pose2 pose;
  double z_m = 0;  ///< underside above the floor; movable ones fall from there
  bool movable = false;
  double mass_kg = 0.1;
  double floor_friction = 0.5;  ///< of movable ones, against whatever they stand on; balls roll instead
  /// Of a ball: what slows it as it rolls, as a part of its weight.
  /// [assumed: hard ball on a table, 0.005 to 0.03]
  double rolling_friction = 0.02;
  Material material;
  std::string model;                        ///< what cameras that recognise call it
  std::vector<Colour> recognition_colours;  ///< ... and its colours; empty: they do not notice it
  int node = 0;                             ///< line of its node in WebotsDesc::world; 0: none
  int line = 0;
};

/// A polyline of walls.
struct WallDesc {
  std::vector<Vec2> points_m;
  bool closed = false;
  double thickness_m = 0.01;
  double height_m = 0.1;
  double z_m = 0;
  Material material;
  int line = 0;
};

struct ArenaDesc {
  Vec2 size_m{1, 1};  ///< inside measures
  Vec2 centre_m;
  double wall_height_m = 0.1;
  double wall_thickness_m = 0.01;
  Material material;
};

struct FloorDesc {
  Colour colour{0.93, 0.93, 0.90};
  double ir_reflectance = -1;
  std::string image;    ///< PNG over the whole arena, as written; empty: plain
  int image_width = 0;  ///< pixels, once the file is read
  int image_height = 0;
  std::vector<std::uint8_t> image_rgb;  ///< rows from the north, three bytes a pixel
  double friction = 1.0;                ///< factor on the traction of wheels
  double tilt_x_rad = 0;                ///< the x axis rises above the horizontal by this angle
  double tilt_y_rad = 0;                ///< same for the y axis
};

/// A slope on the floor, or a platform when both ends are equally high.
struct RampDesc {
  std::string name;
  Pose2 pose;             ///< of its middle; heading uphill
  Vec2 size_m{0.2, 0.2};  ///< in plan, along the heading and across
  double low_m = 0;       ///< height of its low end
  double high_m = 0;      ///< height of its high end
  Material material;
  int line = 0;
};

struct LampDesc {
  std::string name;
  Vec3 position_m{0, 0, 1};
  double intensity_w_m2 = 1;                   ///< at a distance where the attenuation is 1
  std::array<double, 3> attenuation{1, 0, 0};  ///< a0 + a1 d + a2 d2 divides the intensity; d in m
  Colour colour;
  bool on = true;
  int node = 0;  ///< line of its node in WebotsDesc::world; 0: none
};

/// What cameras see where nothing stands, and the light that is everywhere for them.
struct SkyDesc {
  Colour colour{0.72, 0.80, 0.90};
  double light_w_m2 = 1.0;  ///< on the floor; proximity sensors do not see it
};

enum class SoundKind { Tone, Noise, Wav, Clap };

/// Something that sounds and does not move.
struct SoundDesc {
  std::string name;
  SoundKind kind = SoundKind::Tone;
  Vec3 position_m{0, 0, 0.035};
  double level_db = 70;                          ///< dB SPL at 1 m; of a clap: of its beginning
  std::optional<double> pressure_pa;             ///< Pa rms at 1 m, instead of the level
  double frequency_hz = 1000;                    ///< of a tone
  std::optional<std::array<double, 2>> band_hz;  ///< of a noise; unset: white
  std::string file;                              ///< WAV, as written
  std::vector<float> samples;                    ///< of the file, -1 to 1; full scale is a sine of the level
  double sample_rate_hz = 0;
  bool loop = true;             ///< the file is repeated
  std::vector<double> times_s;  ///< of claps; empty: one every `every_s` from the start on
  double every_s = 1;
  double jitter_s = 0;                ///< each of these comes later by a random time up to this
  std::optional<std::uint64_t> seed;  ///< unset: the world's
  double start_s = 0;
  double stop_s = 1e300;  ///< silent from then on
  int line = 0;
};

/// What programs written for Webots' interfaces find; the robots' own library does not look at it.
struct WebotsDesc {
  double time_step_s = 0.032;    ///< basic time step of the world [Webots: WorldInfo.basicTimeStep]
  double speed_unit_rad_s = -1;  ///< rad/s per unit of differential_wheels_set_speed; negative: the usual one
  std::string sensor_order;      ///< how proximity and light sensors are numbered, a name the caller knows
  Axes axes = Axes::Enu;         ///< of positions and rotations that programs are told
  std::string world;   ///< the .wbt file this world was made of, whose nodes supervisors find; or empty
  double floor_m = 0;  ///< how high the floor lies in that file
};

/// Words between blanks; a word in "" or '' may hold blanks.
std::vector<std::string> argument_words(const std::string& args);

/// A program attached to the world.
struct SupervisorDesc {
  std::string name;
  std::string program;              ///< name or path as written
  std::string args;                 ///< what its main() gets, words as argument_words() has them
  std::string def;                  ///< second name, by which supervisors may look it up; may be empty
  std::string custom_data;          ///< a text that programs may read and change
  std::vector<DeviceDesc> devices;  ///< of its own
  int node = 0;                     ///< line of its node in WebotsDesc::world; 0: none
  double period_s = 0;              ///< how often it runs when it does not say so itself; 0: every tick
  int line = 0;
};

struct WorldDesc {
  std::string title;
  std::string file;  ///< where it was read from; empty when built in C++
  int physics_hz = 512;
  Engine engine = Engine::Dynamic;
  double gravity_m_s2 = 9.81;
  std::uint64_t seed = 1;
  double ambient_w_m2 = 0;
  std::optional<ArenaDesc> arena;
  FloorDesc floor;
  SkyDesc sky;
  std::vector<Material> materials;
  std::vector<WallDesc> walls;
  std::vector<ObjectDesc> objects;
  std::vector<RampDesc> ramps;
  std::vector<LampDesc> lamps;
  std::vector<SoundDesc> sounds;
  ProximitySettings proximity;
  WheelSettings wheels;
  RadioDesc radio;
  LinkDesc link;
  std::vector<RobotDesc> robots;
  WebotsDesc webots;
  std::vector<SupervisorDesc> supervisors;
  std::vector<RobotModel> models;    ///< what the caller offers; robots refer to them by name
  std::vector<PartKind> part_kinds;  ///< likewise, for robots' parts

  /// The model of a robot; null when there is none of that name.
  const RobotModel* model_of(const RobotDesc& robot) const {
    if (robot.model.empty()) return models.empty() ? nullptr : &models.front();
    for (const RobotModel& m : models) {
      if (m.name == robot.model) return &m;
    }
    return nullptr;
  }
};

}  // namespace sim
