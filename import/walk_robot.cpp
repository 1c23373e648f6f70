// SPDX-License-Identifier: MIT
// E-pucks, as PROTO and as plain nodes, and robots that are none.
#include <fmt/format.h>

#include <algorithm>

#include "import/walk.h"
#include "sim_core/world/most_ranges.h"

namespace wbt {
namespace {

// fields of the PROTO that change nothing a firmware can find out
const std::set<std::string> kSilent{"window",
                                    "robotWindow",
                                    "camera_windowPosition",
                                    "camera_pixelSize",
                                    "display_windowPosition",
                                    "camera_antiAliasing",
                                    "synchronization",
                                    "translation",
                                    "rotation",
                                    "name",
                                    "controller",
                                    "model",
                                    "description",
                                    "showWindow",
                                    "remoteControl",
                                    "locked",
                                    "selfCollision",
                                    "translationStep",
                                    "rotationStep",
                                    "boundingObject",
                                    "physics",
                                    "data"};

constexpr int kMostProtosInside = 8;  // of one e-puck, in one another

int ps_index(const std::string& name) {
  return name.size() == 3 && name.compare(0, 2, "ps") == 0 && name[2] >= '0' && name[2] <= '7' ? name[2] - '0'
                                                                                               : -1;
}

bool is_ring_light(const std::string& name) {
  return name.size() == 3 && name.compare(0, 2, "ls") == 0 && name[2] >= '0' && name[2] <= '7';
}

// what robots may have beside their body
const std::set<std::string> kDeviceTypes{"DistanceSensor",
                                         "E-puckDistanceSensor",
                                         "EPuck_DistanceSensor",
                                         "E-puckGroundSensors",
                                         "EPuck_GroundSensorsModule",
                                         "GPS",
                                         "Compass",
                                         "Gyro",
                                         "Emitter",
                                         "Receiver",
                                         "Lidar",
                                         "InertialUnit",
                                         "Display",
                                         "TouchSensor",
                                         "Radar",
                                         "RangeFinder",
                                         "Pen",
                                         "Gripper",
                                         "LightSensor",
                                         "Connector",
                                         "LinearMotor",
                                         "RotationalMotor",
                                         "Motor",
                                         "Camera",
                                         "LED",
                                         "Speaker",
                                         "VacuumGripper",
                                         "Propeller",
                                         "Altimeter",
                                         "Microphone",
                                         "RobotisLds01",
                                         "SharpGP2D120",
                                         "PositionSensor"};

// an e-puck has it without being told
bool is_own(const Node& d) {
  const std::string name = d.text("name");
  if (d.type == "Camera") return name.empty() || name == "camera";
  if (d.type == "RotationalMotor" || d.type == "Motor" || d.type == "PositionSensor")
    return name.find("wheel") != std::string::npos || name.rfind("left", 0) == 0 ||
           name.rfind("right", 0) == 0;
  if (d.type == "LED") return name.rfind("led", 0) == 0;
  if (d.type == "Speaker") return name.empty() || name == "speaker";
  if (d.type == "DistanceSensor") return name == "tof";
  if (d.type == "Gyro") return name == "gyro";
  if (d.type == "Microphone") return name.rfind("mic", 0) == 0;
  return false;
}

// both names have been in use
bool is_floor_sensor(const std::string& name) {
  return name.size() >= 3 && (name.compare(0, 2, "gs") == 0 || name.compare(0, 2, "fs") == 0) &&
         name[2] >= '0' && name[2] <= '9';
}

// the turret's place on the robot: ahead, left, up [Webots: E-puck.proto, TURRET_SLOT]
constexpr sim::Vec3 kTurretAt{-0.0095, 0, 0.0486};

// sensors that come with Webots as PROTOs, as the nodes that these are; null: it is none
NodePtr known_device(const Node& n) {
  // What the user wrote stays; what the PROTO would add is given here.
  const auto made = std::make_shared<Node>(n);
  const auto give = [&](const char* name, std::vector<double> numbers) {
    made->fields.push_back({name, n.line, std::move(numbers), {}, {}, {}});
  };
  const auto call = [&](const char* name) {
    if (!n.field("name")) made->fields.push_back({"name", n.line, {}, {name}, {}, {}});
  };
  if (n.type == "RobotisLds01") {  // [Webots: RobotisLds01.proto]
    made->type = "Lidar";
    call("LDS-01");
    give("horizontalResolution", {360});
    give("fieldOfView", {6.28318});
    give("numberOfLayers", {1});
    give("minRange", {0.12});
    give("maxRange", {3.5});
    Field turns{"children", n.line, {}, {}, {}, {}};
    for (const char* part : {"_main_motor", "_secondary_motor"}) {
      Node motor;
      motor.type = "RotationalMotor";
      motor.line = n.line;
      motor.fields.push_back({"name", n.line, {}, {made->text("name") + part}, {}, {}});
      turns.nodes.push_back(std::make_shared<Node>(motor));
    }
    made->fields.push_back(std::move(turns));
  } else if (n.type == "SharpGP2D120") {  // [Webots: SharpGP2D120.proto, volts]
    made->type = "DistanceSensor";
    call("Sharp's IR sensor GP2D120");
    give("lookupTable",
         {0.03,  3.03,  0.005, 0.035, 2.78,  0.005, 0.04,  2.72,  0.005, 0.05,  2.33,  0.005, 0.06,  2.01,
          0.005, 0.07,  1.76,  0.005, 0.08,  1.55,  0.005, 0.09,  1.4,   0.005, 0.1,   1.25,  0.005, 0.12,
          1.04,  0.005, 0.14,  0.92,  0.005, 0.16,  0.82,  0.005, 0.18,  0.73,  0.005, 0.2,   0.66,  0.005,
          0.25,  0.53,  0.005, 0.3,   0.42,  0.005, 0.35,  0.37,  0.005, 0.4,   0.31,  0.005});
  } else {
    return nullptr;
  }
  return made;
}

bool between(double x, double low, double high) { return x >= low && x <= high; }

bool same(const sim::ProximitySettings& a, const sim::ProximitySettings& b) {
  const auto rows = [](const sim::ProximitySettings& s) {
    std::vector<double> out;
    if (s.table) {
      for (const auto& r : *s.table) out.insert(out.end(), {r.distance_m, r.value, r.relative_noise});
    }
    return out;
  };
  return rows(a) == rows(b) && a.type == b.type && a.rays == b.rays && a.aperture_rad == b.aperture_rad &&
         a.gaussian_width == b.gaussian_width;
}

// a lookupTable, nearest row first
std::vector<sim::ResponseRow> sorted_rows(const Field& table) {
  std::vector<sim::ResponseRow> rows;
  for (std::size_t i = 0; i + 2 < std::min(table.numbers.size(), 3 * kMostRows + 3); i += 3)
    rows.push_back({table.numbers[i], table.numbers[i + 1], std::max(0.0, table.numbers[i + 2])});
  std::sort(rows.begin(), rows.end(),
            [](const sim::ResponseRow& a, const sim::ResponseRow& b) { return a.distance_m < b.distance_m; });
  return rows;
}

// two rows or more, in order, with values from `least` to `most`
bool is_table(const std::vector<sim::ResponseRow>& rows, double farthest_m, double least, double most) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].distance_m < 0 || rows[i].distance_m > farthest_m || rows[i].value < least ||
        rows[i].value > most || rows[i].relative_noise > most ||
        (i > 0 && rows[i].distance_m <= rows[i - 1].distance_m + 1e-7))
      return false;
  return rows.size() >= 2 && rows.size() <= kMostRows;
}

}  // namespace

void Walk::collect(const Node& n, const Affine& at, const std::set<std::string>& types,
                   std::vector<Placed>& out, int depth) {
  if (depth > 2 * kDeepestNode || !afford(n)) return;
  if (types.count(n.type)) {
    out.push_back({&n, at});
  } else if (depth > 0 && protos_.find(n.type)) {
    if (const NodePtr body = unfolded(n, true)) {
      kept_.push_back(body);
      collect(*body, at, types, out, depth + 1);
    }
    return;
  }
  for (const char* f : {"children", "endPoint", "device"}) {
    const Field* list = n.field(f);
    for (std::size_t i = 0; list && i < list->nodes.size(); ++i)
      collect(*list->nodes[i], inside(*list->nodes[i], at), types, out, depth + 1);
  }
}

bool Walk::is_plain_epuck(const Node& n) {
  std::vector<Placed> found;
  collect(n, {}, {"DistanceSensor", "E-puckDistanceSensor", "EPuck_DistanceSensor", "RotationalMotor"}, found,
          0);
  int rings = 0, motors = 0;
  for (const Placed& each : found) {
    const Node* d = each.node;
    if (d->type == "RotationalMotor")
      ++motors;
    else if (ps_index(d->text("name")) >= 0 || d->field("id"))
      ++rings;
  }
  if (n.type == "DifferentialWheels")
    return rings >= 6 || (between(n.number("axleLength", 0.1), kAxleMinM, kAxleMaxM) &&
                          between(n.number("wheelRadius", 0.01), kWheelRadiusMinM, kWheelRadiusMaxM));
  return rings >= 6 && motors >= 2;
}

void Walk::robot(const Node& n, const Affine& frame, int depth) {
  if (is_plain_epuck(n)) {
    // `frame` is its place already
    Node placed = n;
    placed.fields.erase(std::remove_if(placed.fields.begin(), placed.fields.end(),
                                       [](const Field& f) {
                                         return f.name == "translation" || f.name == "rotation" ||
                                                f.name == "scale";
                                       }),
                        placed.fields.end());
    return epuck(placed, frame, false);
  }
  // Anything else is a body; where it has a program, that runs as a supervisor's does.
  const std::string controller = n.text("controller");
  const bool runs =
      !controller.empty() && controller != "void" && controller != "<none>" && controller != "<generic>";
  const bool supervises = n.type == "Supervisor" || n.truth("supervisor", false);
  if (runs) {
    // a program with devices of its own and no wheels: it may do more than it asks for
    FoundRobot program;
    program_fields(n, program);
    FoundSupervisor s;
    s.type = n.type;
    s.name = n.text("name", supervises && n.type == "Supervisor" ? "supervisor" : "robot");
    s.def = n.def;
    s.controller = controller;
    s.args = program.args;
    s.custom_data = program.custom_data;
    s.line = n.line;
    std::vector<Placed> devices;
    collect(n, {}, kDeviceTypes, devices, 0);
    bool moves = false;
    for (const Placed& d : devices) {
      const std::string& t = d.node->type;
      if (t == "RotationalMotor" || t == "LinearMotor" || t == "Motor") moves = true;
      device(*d.node, d.at, program, 0);
    }
    s.devices = program.devices;
    scene_.supervisors.push_back(s);
    if (!supervises) report_.add(n, "a robot that is no e-puck", "its program runs, its body stands there");
    if (moves) report_.add(n, "what its motors move", "the program turns them for nothing");
  } else if (supervises) {
    report_.add(n, "a supervisor without a controller of its own");
  } else {
    report_.add(n, "a robot that is no e-puck", "its body stands there");
  }
  solid(n, frame, depth);
}

void Walk::epuck(const Node& n, const Affine& frame, bool by_proto) {
  if (static_cast<int>(scene_.robots.size()) >= kMostRobots)
    return report_.add(n, fmt::format("more than {} robots", kMostRobots));
  FoundRobot out;
  out.type = n.type;
  out.by_proto = by_proto;
  out.def = n.def;
  out.line = n.line;
  out.name = n.text("name", by_proto ? "e-puck" : "");
  out.controller = n.text("controller", by_proto ? "" : "void");
  // Where it stands and where it looks. An axis of the node points ahead, which one the world's age says.
  const Affine place = inside(n, frame);
  const Vec3 at = place.translation(), up = place.linear() * (z_up_ ? Vec3::UnitZ() : Vec3::UnitY()),
             ahead = place.linear() * (z_up_ ? Vec3(1, 0, 0) : Vec3(0, 0, -1));
  if (!at.allFinite() || !ahead.allFinite() || at.head<2>().cwiseAbs().maxCoeff() > kFarthestM)
    return report_.add(n, "its place makes no sense");
  out.pose = {at.x(), at.y(), ahead.head<2>().norm() > 1e-6 ? std::atan2(ahead.y(), ahead.x()) : 0};
  out.z_m = at.z();
  if (!(up.z() > 0.9 * up.norm())) report_.add(n, "that it lies on its side", "it stands");
  const std::string lower = n.type;
  if (lower.find("NoPhysics") != std::string::npos || n.truth("kinematic", false)) out.kinematic = true;
  if (!by_proto && !n.field("physics")) out.kinematic = true;
  // What it is equipped with, by the fields of its PROTO or by the nodes of an older one.
  if (by_proto) {
    proto_fields(n, out);
    proto_body(n, out, 0);
  } else {
    plain_fields(n, out);
  }
  program_fields(n, out);
  if (const Field* battery = n.field("battery")) {
    if (battery->numbers.size() >= 2 && battery->numbers[1] > 0) {
      out.battery_wh = std::clamp(battery->numbers[1] / 3600, 0.001, 1000.0);
      if (battery->numbers[0] < 0.99 * battery->numbers[1])
        report_.add(n, *battery, "that it is not full", "it is full");
    }
  }
  scene_.robots.push_back(std::move(out));
}

// what its program gets. One word of the world's, with blanks, was a line of several until lists came
std::string Walk::words_of(const Node& n) {
  const Field* arguments = n.field("controllerArgs");
  std::string words;
  if (!arguments) return words;
  const bool line = arguments->strings.size() == 1 && !text_.at_least(2020, 'b');
  for (const std::string& word : arguments->strings) {
    if (word.empty() && arguments->strings.size() == 1) break;
    const bool plain = line || (!word.empty() && word.find_first_of(" \t\"'") == std::string::npos);
    const char* quote = word.find('\'') == std::string::npos ? "'" : "\"";
    if (!plain && word.find('\'') != std::string::npos && word.find('"') != std::string::npos)
      report_.add(n, *arguments, "both kinds of quotes within an argument", "it becomes several");
    words += (words.empty() ? "" : " ") + (plain ? word : quote + word + quote);
  }
  return words;
}

void Walk::program_fields(const Node& n, FoundRobot& out) {
  if (n.field("controllerArgs")) out.args = words_of(n);
  if (n.field("customData") || n.field("data")) out.custom_data = n.text("customData", n.text("data"));
  if (n.truth("supervisor", false)) out.supervisor = true;
  if (n.field("recognitionColors")) out.recognition = recognition_of(n);
}

// what a PROTO of the project makes of the robot: its controller and what it is equipped with
void Walk::proto_body(const Node& n, FoundRobot& out, int depth) {
  const Proto* proto = protos_.find(n.type);
  if (!proto || depth > kMostProtosInside) return;
  // what was put into its slots has been looked at
  Node bare = n;
  bare.fields.erase(
      std::remove_if(bare.fields.begin(), bare.fields.end(), [](const Field& f) { return !f.nodes.empty(); }),
      bare.fields.end());
  const NodePtr body = unfolded(bare, true);
  if (!body) {
    for (const Field& f : proto->defaults) {
      if (f.name == "controller" && !f.strings.empty() && !n.field("controller"))
        out.controller = f.strings.front();
    }
    report_.add(n, "what its PROTO is equipped with, which cannot be read", "a plain e-puck");
    return;
  }
  if (proto->has_script)
    report_.add(n, "the script of its PROTO", "what stands in its text, whatever the script says");
  kept_.push_back(body);
  if (!n.field("controller")) out.controller = body->text("controller");
  program_fields(*body, out);  // the world's own go before, in epuck()
  // Its own equipment, of which what the world's file says goes before.
  FoundRobot own;
  equipment(*body, own);
  if (!own.sensors.empty()) out.sensors = own.sensors;
  const bool alike = own.proximity.table || own.proximity.rays || own.proximity.aperture_rad;
  if (alike) out.proximity = own.proximity;
  // a PROTO made of another e-puck's
  if (is_epuck_name(body->type) && body->type != n.type) {
    proto_fields(*body, own);
    proto_body(*body, own, depth + 1);
    if (out.sensors.empty()) out.sensors = own.sensors;
  }
  for (const std::string& part : own.parts) {
    if (std::find(out.parts.begin(), out.parts.end(), part) == out.parts.end()) out.parts.push_back(part);
  }
  for (const Device& d : own.devices) {
    if (std::none_of(out.devices.begin(), out.devices.end(),
                     [&](const Device& o) { return o.name == d.name; }))
      out.devices.push_back(d);
  }
}

void Walk::proto_fields(const Node& n, FoundRobot& out) {
  if (text_.year == 0) out.speed_unit_rad_s = kProtoSpeedUnitRadS;
  if (n.number("version", 1) == 2 || n.text("version") == "2" || n.type.find('2') != std::string::npos)
    report_.add(n, "that it is an e-puck 2 (faster motors, time of flight, Wi-Fi)", "an e-puck");
  // Each field that means something here; the rest is told.
  for (const Field& f : n.fields) {
    if (kSilent.count(f.name) || f.name == "kinematic" || f.name == "customData" ||
        f.name == "controllerArgs" || f.name == "supervisor" || f.name == "battery" || f.name == "version" ||
        f.name == "recognitionColors")
      continue;
    if (!f.nodes.empty() || (f.name.size() > 4 && f.name.compare(f.name.size() - 4, 4, "Slot") == 0)) {
      slot(n, f.name.c_str(), out);
    } else if (f.name == "emitter_channel" || f.name == "receiver_channel") {
      const std::string kind = f.name.substr(0, f.name.find('_'));
      const double channel = f.numbers.empty() ? 1 : f.numbers[0];
      Device talks;
      talks.name = talks.kind = kind;
      talks.channel = static_cast<int>(std::clamp(channel, -1.0, 32767.0));
      out.devices.push_back(talks);
    } else if (f.name == "distance_sensor_numberOfRays") {
      if (!f.numbers.empty() && f.numbers[0] != 1)
        out.proximity.rays = static_cast<int>(std::clamp(f.numbers[0], 1.0, 100.0));
    } else if (f.name == "camera_rotation") {
      const double angle = std::abs(std::remainder(n.number("camera_rotation", 0, 3), 2 * sim::kPi));
      const bool about_view = std::abs(n.number("camera_rotation", 0, z_up_ ? 0 : 2)) > 0.9;
      if (about_view && std::abs(angle - sim::kPi / 2) < 0.1)
        out.camera_mount = "sideways";
      else if (about_view && angle > sim::kPi - 0.1)
        out.camera_mount = "inverted";
      else if (angle > 1e-6)
        report_.add(n, f, "another line of sight", "the camera looks ahead");
    } else if (f.name.rfind("camera_", 0) == 0) {
      const double usual = f.name == "camera_fieldOfView" ? 0.84
                           : f.name == "camera_width"     ? 52
                           : f.name == "camera_height"    ? 39
                                                          : 0;
      if (!f.numbers.empty() && f.numbers[0] != usual)
        report_.add(n, f, "a setting of Webots' camera",
                    "the real camera's optics; firmware chooses the window");
    } else {
      report_.add(n, f, "no such thing on this robot");
    }
  }
}

void Walk::plain_fields(const Node& n, FoundRobot& out) {
  if (n.type == "DifferentialWheels") {
    const bool old = text_.year == 0 && text_.major < 6;
    out.speed_unit_rad_s = n.number("speedUnit", old ? kOldNodeSpeedUnitRadS : kNodeSpeedUnitRadS);
    if (!between(*out.speed_unit_rad_s, kSpeedUnitMin, kSpeedUnitMax)) {
      report_.add(n, fmt::format("a speedUnit of {:g} rad/s", *out.speed_unit_rad_s), "the usual one");
      out.speed_unit_rad_s.reset();
    }
    // only the kinematic mode knows it
    if (out.kinematic) out.slip_noise = std::clamp(n.number("slipNoise", kNodeSlipNoise), 0.0, 0.5);
    if (n.number("encoderNoise", -1) > 0)
      report_.add(n, *n.field("encoderNoise"), "noise of encoders", "firmware counts exact steps");
  }
  equipment(n, out);
}

void Walk::equipment(const Node& n, FoundRobot& out) {
  std::vector<Placed> found;
  collect(n, {}, kDeviceTypes, found, 0);
  std::vector<const Node*> ring;
  const Node* tables = nullptr;  // a light sensor's own: one line tells it of all
  for (const Placed& each : found) {
    const Node* d = each.node;
    if (ps_index(d->text("name")) >= 0 && d->type != "LightSensor")
      ring.push_back(d);
    else if (d->type == "LightSensor" && is_ring_light(d->text("name")))
      tables = tables || !d->field("lookupTable") ? tables : d;
    else if (!is_own(*d) && (d->type.find("DistanceSensor") == std::string::npos || !d->field("id")))
      device(*d, each.at, out, 0);
  }
  if (tables)
    report_.add(*tables, *tables->field("lookupTable"), "tables of light sensors", "those of the real robot");
  sensors(ring, out);
}

void Walk::sensors(const std::vector<const Node*>& nodes, FoundRobot& out) {
  for (const Node* d : nodes) {
    if (d->type != "DistanceSensor") continue;
    sim::SensorDesc s;
    s.index = ps_index(d->text("name"));
    sim::ProximitySettings& p = s.proximity;
    // Its table, where it is one that a profile can have.
    if (const Field* table = d->field("lookupTable")) {
      const std::vector<sim::ResponseRow> rows = sorted_rows(*table);
      if (is_table(rows, kFarthestRowM, 0, 1e6))
        p.table = rows;
      else
        report_.add(
            *d, *table,
            fmt::format("a table with fewer than two rows, without order, or beyond {} m", kFarthestRowM),
            "the profile's");
    }
    // Its type and its rays.
    const std::string type = d->text("type", "generic");
    p.type = type == "generic" ? sim::SensorType::Generic : sim::SensorType::InfraRed;
    if (type != "generic" && type != "infra-red")
      report_.add(*d, "type \"" + printable(type) + "\"", "infra-red");
    if (d->field("numberOfRays"))
      p.rays = static_cast<int>(std::clamp(d->number("numberOfRays", 1), 1.0, 100.0));
    if (d->field("aperture")) p.aperture_rad = std::clamp(d->number("aperture", 0), 0.0, 3.1415);
    if (d->field("gaussianWidth")) p.gaussian_width = std::clamp(d->number("gaussianWidth", 1), 0.0, 1000.0);
    if (d->number("resolution", -1) > 0)
      report_.add(*d, *d->field("resolution"), "a resolution", "that of the ADC");
    if (std::none_of(out.sensors.begin(), out.sensors.end(),
                     [&](const auto& o) { return o.index == s.index; }))
      out.sensors.push_back(std::move(s));
  }
  // Eight sensors alike are one setting of the robot.
  std::sort(out.sensors.begin(), out.sensors.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  const bool alike = out.sensors.size() == 8 &&
                     std::all_of(out.sensors.begin(), out.sensors.end(), [&](const sim::SensorDesc& s) {
                       return same(s.proximity, out.sensors.front().proximity);
                     });
  if (alike) {
    out.proximity = out.sensors.front().proximity;
    out.sensors.clear();
  }
}

void Walk::slot(const Node& n, const char* field, FoundRobot& out) {
  const Field* f = n.field(field);
  Affine base;
  if (std::string_view(field) == "turretSlot")
    base.translation() =
        z_up_ ? Vec3(kTurretAt.x, kTurretAt.y, kTurretAt.z) : Vec3(0, kTurretAt.z, -kTurretAt.x);
  for (std::size_t i = 0; f && i < f->nodes.size(); ++i)
    device(*f->nodes[i], inside(*f->nodes[i], base), out, 0);
}

std::vector<sim::ResponseRow> Walk::rows_of(const Node& n) {
  const Field* table = n.field("lookupTable");
  if (!table) return {{0, 0, 0}, {0.1, 1000, 0}};  // [Webots: DistanceSensor, the field's default]
  std::vector<sim::ResponseRow> rows = sorted_rows(*table);
  if (is_table(rows, kFarthestM, -1e9, 1e9)) return rows;
  report_.add(n, *table, "a table with fewer than two rows, or without order", "it measures nothing");
  return {};
}

// where it is on the robot, where it looks, and what it sees
void Walk::ranging(const Node& n, const Affine& at, Device& made) {
  const bool beam = made.kind == "distance";
  const Vec3 look = at.linear() * (beam || z_up_ ? Vec3(1, 0, 0) : Vec3(0, 0, -1));
  const auto ours = [&](const Vec3& v) { return z_up_ ? v : Vec3(-v.z(), -v.x(), v.y()); };
  const Vec3 way = ours(look), place = ours(at.translation());
  if (place.allFinite() && place.norm() < 1) made.at = plain(place);
  const double level = way.head<2>().norm();
  if (way.allFinite() && level > 1e-6) made.heading_rad = std::atan2(way.y(), way.x());
  if (way.allFinite() && level < 0.9 * way.norm())
    report_.add(n, "that it looks up or down", "it looks level");
  if (beam) {
    made.table = rows_of(n);
    made.rays = static_cast<int>(std::clamp(n.number("numberOfRays", 1), 1.0, 100.0));
    if (n.field("aperture")) made.aperture_rad = std::clamp(n.number("aperture", 0), 0.0, 2 * sim::kPi);
    return;
  }
  // [Webots: defaults of the fields of Lidar and RangeFinder]
  const bool lidar = made.kind == "lidar";
  made.width = static_cast<int>(
      std::clamp(lidar ? n.number("horizontalResolution", 512) : n.number("width", 64), 1.0, 4096.0));
  made.height = static_cast<int>(
      std::clamp(lidar ? n.number("numberOfLayers", 4) : n.number("height", 64), 1.0, 4096.0));
  const int columns = *made.width, rows = *made.height;
  const auto thinned = [](int side, int each) { return std::max(1, side / each); };
  for (int each = 2; *made.width * *made.height > sim::kMostRanges; ++each)
    made.width = thinned(columns, each), made.height = thinned(rows, each);
  if (*made.width != columns || *made.height != rows)
    report_.add(
        n, fmt::format("{} columns and {} rows, more than {} distances", columns, rows, sim::kMostRanges),
        fmt::format("{} columns and {} rows", *made.width, *made.height));
  made.fov_rad = std::clamp(n.number("fieldOfView", lidar ? 1.5708 : 0.7854), 0.001, 6.2831);
  if (lidar) made.vertical_fov_rad = std::clamp(n.number("verticalFieldOfView", 0.2), 0.0, 3.14);
  made.near_m = std::clamp(n.number("minRange", 0.01), 0.0, kFarthestM);
  made.far_m = std::clamp(n.number("maxRange", 1), 0.001, kFarthestM);
  if (*made.near_m >= *made.far_m) made.near_m = 0;
  if (n.number("noise", 0) > 0) report_.add(n, *n.field("noise"), "noise of distances", "they are exact");
}

void Walk::device(const Node& n, const Affine& at, FoundRobot& out, int depth) {
  // Ground sensors are a part of the real robot.
  if (depth > kDeepestNode || !afford(n)) return;
  if (n.type.find("GroundSensors") != std::string::npos ||
      (n.type == "DistanceSensor" && is_floor_sensor(n.text("name")))) {
    if (std::find(out.parts.begin(), out.parts.end(), "ground-sensors") == out.parts.end())
      out.parts.push_back("ground-sensors");
    return;
  }
  const struct {
    const char *type, *kind, *name;
  } kDevices[] = {{"GPS", "gps", "gps"},
                  {"Compass", "compass", "compass"},
                  {"Gyro", "gyro", "gyro"},
                  {"InertialUnit", "inertial", "inertial unit"},
                  {"Emitter", "emitter", "emitter"},
                  {"Receiver", "receiver", "receiver"},
                  {"Display", "display", "display"},
                  {"Camera", "camera", "camera"},
                  {"RotationalMotor", "motor", "rotational motor"},
                  {"LinearMotor", "motor", "linear motor"},
                  {"Motor", "motor", "motor"},
                  {"TouchSensor", "touch", "touch sensor"},
                  {"LightSensor", "light", "light sensor"},
                  {"DistanceSensor", "distance", "distance sensor"},
                  {"LED", "led", "led"},
                  {"Lidar", "lidar", "lidar"},
                  {"RangeFinder", "range-finder", "range-finder"},
                  {"PositionSensor", "position", "position sensor"},
                  {"Speaker", "speaker", "speaker"},
                  {"Pen", "pen", "pen"}};
  // A device of a known kind, with what a program asks about it.
  for (const auto& d : kDevices) {
    if (n.type != d.type) continue;
    Device made;
    made.name = n.text("name", d.name);
    made.kind = d.kind;
    const bool talks = n.type == "Emitter" || n.type == "Receiver", shows = n.type == "Display";
    const bool deaf = !talks && !shows && made.kind != "gps" && made.kind != "compass" &&
                      made.kind != "inertial" && made.kind != "gyro";
    if (shows || n.type == "Camera") {
      made.width = static_cast<int>(std::clamp(n.number("width", 64), 1.0, 4096.0));
      made.height = static_cast<int>(std::clamp(n.number("height", 64), 1.0, 4096.0));
    }
    if (made.kind == "distance" || made.kind == "lidar" || made.kind == "range-finder") ranging(n, at, made);
    if (n.type == "Camera" || n.type == "TouchSensor" || n.type == "LightSensor")
      report_.add(n, "what this sensor measures", "it is there for the program, and measures nothing");
    // emitters and receivers
    if (talks) {
      made.channel = static_cast<int>(std::clamp(n.number("channel", 0), -1.0, 32767.0));
      if (n.number("range", -1) > 0) made.range_m = std::min(n.number("range", -1), kFarthestM);
      const std::string type = n.text("type", "radio");
      if (type == "infra-red" && n.type == "Emitter")
        made.infra_red = true;
      else if (type != "radio" && type != "infra-red")
        report_.add(n, "type \"" + printable(type) + "\"", "radio");
      if (n.type == "Emitter" && n.number("baudRate", -1) >= 1)
        made.baud_rate_bit_s = std::min(n.number("baudRate", -1), 1e9);
      for (const char* limit : {"aperture", "signalStrengthNoise", "directionNoise"}) {
        if (n.number(limit, -1) > 0) report_.add(n, *n.field(limit), "no such limit here");
      }
    } else if (!shows && !deaf) {
      for (const char* less : {"accuracy", "resolution", "lookupTable", "noise"}) {
        const Field* f = n.field(less);
        if (f && !f->numbers.empty() && (f->numbers.size() > 1 || f->numbers[0] > 0))
          report_.add(n, *f, "a setting of Webots' device", "the device's own");
      }
    }
    out.devices.push_back(made);
    // what turns within it
    std::vector<Placed> inner;
    collect(n, at, {"RotationalMotor", "LinearMotor", "PositionSensor"}, inner, depth + 1);
    for (const Placed& i : inner) {
      const std::string name = i.node->text("name");
      if (i.node != &n && std::none_of(out.devices.begin(), out.devices.end(),
                                       [&](const Device& o) { return o.name == name; }))
        device(*i.node, i.at, out, depth + 1);
    }
    return;
  }
  // No device itself: a group, a PROTO of Webots or of the project, or nothing that is carried.
  if (n.type == "Group" || n.type == "Transform" || n.type == "Pose" || n.type == "Solid") {
    const Field* f = n.field("children");
    bool shapes = false;
    for (std::size_t i = 0; f && i < f->nodes.size(); ++i) {
      if (f->nodes[i]->type == "Shape")
        shapes = true;
      else
        device(*f->nodes[i], inside(*f->nodes[i], at), out, depth + 1);
    }
    if (shapes) report_.add(n, "the shape of what the robot carries");
  } else if (const NodePtr known = known_device(n)) {
    kept_.push_back(known);
    device(*known, at, out, depth + 1);
  } else if (const NodePtr body = unfolded(n, true)) {
    kept_.push_back(body);
    device(*body, at, out, depth + 1);
  } else if (n.type != "Shape") {
    report_.add(n, "a device that this robot does not have");
  }
}

}  // namespace wbt
