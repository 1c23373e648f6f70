// SPDX-License-Identifier: MIT
#include "programs/puck/puck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "firmware/include/webots/nodes.h"
#include "hal_sim/board/motion_params.h"
#include "hal_sim/board/parts_params.h"
#include "hal_sim/board/true_state.h"
#include "hal_sim/drivers/driver_params.h"
#include "programs/puck/ranging.h"
#include "programs/puck/records.h"
#include "programs/puck/world_device.h"
#include "sim_core/base/hash.h"
#include "sim_core/light/profiles.h"
#include "sim_core/world/scene.h"
#include "sim_core/world/world_desc.h"

namespace programs {

namespace {

constexpr int kRing = board::kRingSensors, kLeds = 10;
constexpr int kFullScale = 4095;
constexpr double kGroundScale = 1000;     // [Webots: E-puckGroundSensors.proto, lookup table]
constexpr double kRingApertureRad = 0.3;  // [assumed: as the usual profile's lobe]
constexpr double kInfraRed = 1, kGeneric = 0, kLaser = 3;  // WbDistanceSensorType
// the e-puck 2's sensor of the time of flight, which looks ahead
// [Webots: E-puck.proto, version 2: 0 to 2 m in mm]
constexpr double kTofMostMm = 2000, kTofForwardM = 0.035, kTofHeightM = 0.028;
constexpr double kMicZero = 2048, kMicScale = 16;  // 12 bits of the converter to signed 16
constexpr double kAccZero = 2048, kAccPerG = 768;  // counts [lib: a_d/advance_ad_scan/e_acc.h]
constexpr int kAccMean = 5;                        // samples
constexpr double kG = 9.81;
constexpr double kGyroScale = 7509.9;  // per rad/s [Webots: E-puck.proto, lookup table of the gyroscope]
constexpr int kPlain = 1;              // a gyroscope without that table, in rad/s
constexpr double kGyroDegPerCount = 0.00875;  // +-250 degrees/s [LSM330 table 4]
constexpr double kRadPerDeg = 3.14159265358979323846 / 180;

/// The five sounds that the robot stores. [lib: codec/e_sound.h]
struct StoredSound {
  const char* name;
  int offset, samples;
};
constexpr StoredSound kSounds[] = {{"haa", 0, 2112},
                                   {"spaah", 2116, 1760},
                                   {"ouah", 3878, 3412},
                                   {"yaouh", 7294, 3732},
                                   {"wouaaaah", 11028, 8016}};

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Forward, left, up in the axes of the world file.
sim::Vec3 in_axes(const board::Board& board, const sim::Vec3& v) {
  return board.setup().webots.axes == sim::Axes::Nue ? sim::Vec3{-v.y, v.z, -v.x} : v;
}

void put(link_packet& to, std::int64_t tag, std::initializer_list<double> values) {
  link_begin(&to, LINK_NUMBERS);
  link_int(&to, tag);
  link_numbers(&to, values.begin(), values.size());
  link_end(&to);
}

/// Consecutive registers of a device on the bus.
void read_registers(board::I2cBus& bus, int address, int number, std::uint8_t* to, int count, Cycle at) {
  bus.start(at);
  bus.write(static_cast<std::uint8_t>(address), at);
  bus.write(static_cast<std::uint8_t>(number), at);
  bus.start(at, true);
  bus.write(static_cast<std::uint8_t>(address | 1), at);
  for (int i = 0; i < count; ++i) to[i] = bus.read(at);
  bus.stop(at);
}

void write_register(board::I2cBus& bus, int address, int number, int value, Cycle at) {
  bus.start(at);
  bus.write(static_cast<std::uint8_t>(address), at);
  bus.write(static_cast<std::uint8_t>(number), at);
  bus.write(static_cast<std::uint8_t>(value), at);
  bus.stop(at);
}

std::int16_t word_of(const std::uint8_t* low) { return static_cast<std::int16_t>(low[0] | low[1] << 8); }

std::string text_of(const link_record& record, int number) {
  return {record.texts[number].bytes, record.texts[number].size};
}

}  // namespace

Puck::Puck(board::Board& board, Cycle start)
    : board_(board),
      drivers_(board),
      capture_(board.camera()),
      speaker_(board.codec()),
      wheels_(board, drivers_.agendas()) {
  drivers_.agendas().count_from(start);
  board_.pins().init(start);
  wheels_.start(start);
  drivers_.scan().start(false, false, start);
  board_.pins().follow(start);
  has_lsm_ = board_.setup().revision == board::Revision::Rev13;
  if (has_lsm_) {
    // as initAccAndGyro() of the library does
    board::I2cBus& bus = board_.i2c();
    write_register(bus, board::kLsmAccAddress, 0x20, 0x9F, start);   // 1600 Hz, block data update, all axes
    write_register(bus, board::kLsmAccAddress, 0x25, 0x50, start);   // register number grows
    write_register(bus, board::kLsmGyroAddress, 0x20, 0xCF, start);  // 760 Hz, filter of 30 Hz, all axes
    write_register(bus, board::kLsmGyroAddress, 0x21, 0x20, start);
    write_register(bus, board::kLsmGyroAddress, 0x23, 0x00, start);  // +-250 degrees a second
  }
  if (board_.camera()) camera_ = std::make_unique<PuckCamera>(board_, capture_);
}

sim::Vec3 Puck::in_world_axes(const sim::Vec3& v) const { return in_axes(board_, v); }

// --- the list

void Puck::add(const std::string& name, Kind kind, int node, int index, std::vector<double> needs) {
  devices_.push_back({name, kind, node, index, std::move(needs)});
}

void Puck::add_own(const sim::WorldDesc& world) {
  // with the tags that they have in Webots, which programs have written down
  add("left wheel motor", Kind::Motor, WB_NODE_ROTATIONAL_MOTOR, 0, {kMostWheelRadS, 2});
  add("left wheel sensor", Kind::Encoder, WB_NODE_POSITION_SENSOR, 0, {1});
  add("right wheel motor", Kind::Motor, WB_NODE_ROTATIONAL_MOTOR, 1, {kMostWheelRadS, 4});
  add("right wheel sensor", Kind::Encoder, WB_NODE_POSITION_SENSOR, 1, {3});
  // the lab counts clockwise from the left, the product from the front right
  const bool of_lab = board_.setup().webots.sensor_order == "lab";
  for (int i = 0; i < kRing; ++i) {
    const int sensor = of_lab ? (i + 5) % kRing : i;
    std::vector<double> needs = {0, kFullScale, kRingApertureRad, kInfraRed};
    // the law of this world: of a white wall at a distance, its counts and their noise
    const sim::ProximityConfig law = sim::resolve_proximity(world, board_.setup().robot, sensor);
    for (const sim::ResponseRow& row : law.table)
      needs.insert(needs.end(), {row.distance_m, row.value, row.relative_noise * law.noise_scale});
    add("ps" + std::to_string(i), Kind::Proximity, WB_NODE_DISTANCE_SENSOR, sensor, std::move(needs));
    add("ls" + std::to_string(i), Kind::Light, WB_NODE_LIGHT_SENSOR, sensor);
  }
  for (int i = 0; i < kLeds; ++i) add("led" + std::to_string(i), Kind::Led, WB_NODE_LED, i);
  add("accelerometer", Kind::Accelerometer, WB_NODE_ACCELEROMETER, 0);
  // a robot without a gyroscope of its own has Webots'
  add("gyro", has_lsm_ ? Kind::Gyro : Kind::TrueGyro, WB_NODE_GYRO, 0);
  if (camera_)
    add("camera", Kind::Camera, WB_NODE_CAMERA, 0, {kCameraColumns, kCameraRows, kCameraFovRad, 0, 1});
  for (int i = 0; i < board::kMicrophones; ++i)
    add("mic" + std::to_string(i), Kind::Microphone, WB_NODE_MICROPHONE, i);
  add("speaker", Kind::Speaker, WB_NODE_SPEAKER, 0);
  if (board_.i2c().find(board::kGroundAddress))
    for (int i = 0; i < 3; ++i)
      for (const char* name : {"gs", "fs"})  // floor sensors had other names once
        add(name + std::to_string(i), Kind::Ground, WB_NODE_DISTANCE_SENSOR, i,
            {0, kGroundScale, 0, kInfraRed});
  add("tof", Kind::Tof, WB_NODE_DISTANCE_SENSOR, 0,
      {0, kTofMostMm, 0, kLaser, 0, 0, 0, kTofMostMm / 1000, kTofMostMm, 0});
  add("selector", Kind::Selector, WB_NODE_DISTANCE_SENSOR, 0, {0, 15, 0, kGeneric});
  add("battery", Kind::Battery, WB_NODE_NO_NODE, 0);
  add("keyboard", Kind::Keyboard, WB_NODE_NO_NODE, 0);
}

void Puck::add_of_world() {
  // Emitters and receivers of the world file.
  const board::PacketDevices& packets = board_.packets();
  for (int e = 0; e < packets.emitters(); ++e)
    add(packets.emitter_name(e), Kind::Emitter, WB_NODE_EMITTER, e,
        {double(packets.emitter_channel(e)), packets.emitter_range_m(e), board::kPacketQueueBytes});
  for (int r = 0; r < packets.receivers(); ++r)
    add(packets.receiver_name(r), Kind::Receiver, WB_NODE_RECEIVER, r, {double(packets.receiver_channel(r))});
  int number = -1;  // of the setup's devices
  // Its other devices.
  for (const sim::DeviceDesc& device : board_.setup().devices) {
    ++number;
    auto [node, needs] = world_device(device);
    switch (device.kind) {
      case sim::DeviceKind::Emitter:
      case sim::DeviceKind::Receiver:
        break;  // the packet devices know them
      case sim::DeviceKind::Gps:
        add(device.name, Kind::Gps, node, 0);
        break;
      case sim::DeviceKind::Compass:
        add(device.name, Kind::Compass, node, 0);
        break;
      case sim::DeviceKind::Inertial:
        add(device.name, Kind::Inertial, node, 0);
        break;
      case sim::DeviceKind::Gyro:
        add(device.name, Kind::TrueGyro, node, kPlain);
        break;
      case sim::DeviceKind::Distance: {
        if (device.table.empty()) {
          add(device.name, Kind::Virtual, node, 0, std::move(needs));
          break;
        }
        const auto [least, most] =
            std::minmax_element(device.table.begin(), device.table.end(),
                                [](const auto& a, const auto& b) { return a.value < b.value; });
        needs = {least->value, most->value, device.aperture_rad, kGeneric};
        for (const sim::ResponseRow& row : device.table)
          needs.insert(needs.end(), {row.distance_m, row.value, row.relative_noise});
        add(device.name, Kind::Distance, node, number, std::move(needs));
        break;
      }
      case sim::DeviceKind::Lidar:
      case sim::DeviceKind::RangeFinder:
        add(device.name, Kind::Ranges, node, number, std::move(needs));
        break;
      case sim::DeviceKind::Display:
        add(device.name, Kind::Display, node, 0, std::move(needs));
        break;
      case sim::DeviceKind::Touch:
      case sim::DeviceKind::Light:
        add(device.name, Kind::Virtual, node, 0, std::move(needs));
        break;
      case sim::DeviceKind::Motor:
        needs[0] = kMostWheelRadS;
        add(device.name, Kind::Idle, node, 0, std::move(needs));
        break;
      case sim::DeviceKind::Camera:
        needs[2] = kCameraFovRad;
        add(device.name, Kind::Idle, node, 0, std::move(needs));
        break;
      default:
        add(device.name, Kind::Idle, node, 0, std::move(needs));
    }
  }
}

void Puck::tell(std::size_t number, link_packet& to) const {
  const Device& device = devices_[number];
  put_device(to, number, device.node, device.name, device.needs);
}

void Puck::tell_devices(const sim::WorldDesc& world, link_packet& to) {
  // not before: parts are plugged in behind the constructor
  if (devices_.empty()) {
    add_own(world);
    add_of_world();
  }
  for (std::size_t i = 0; i < devices_.size(); ++i) tell(i, to);
}

void Puck::find_device(const std::string& name, link_packet& to) {
  const auto found =
      std::find_if(devices_.begin(), devices_.end(), [&](const Device& d) { return d.name == name; });
  if (found != devices_.end()) return tell(static_cast<std::size_t>(found - devices_.begin()), to);
  if (board_.virtual_devices().get(name)) {
    add(name, Kind::Virtual, WB_NODE_DISTANCE_SENSOR, 0, {0, kFullScale, 0, kGeneric});
    return tell(devices_.size() - 1, to);
  }
  put_nothing(to, "got device \"" + name + "\", expected one that this robot has");
}

// --- commands

void Puck::note(std::uint64_t what) { hash_ = sim::fold(hash_, what); }

std::string Puck::command(const link_record& record, Cycle at) {
  const link_row* row = link_row_of(record.number);
  const std::int64_t tag = record.ints[0];
  if (tag < 1 || tag > static_cast<std::int64_t>(devices_.size()))
    return fmt::format("{}: got tag {}, expected 1 to {}", row->name, tag, devices_.size());
  Device& device = devices_[static_cast<std::size_t>(tag - 1)];
  const auto is = [&](std::initializer_list<Kind> kinds) {
    return std::find(kinds.begin(), kinds.end(), device.kind) != kinds.end();
  };
  const auto wrong = [&] {
    return fmt::format("{}: got '{}', which is no device for that", row->name, device.name);
  };
  // A device that does nothing takes every command.
  if (device.kind == Kind::Idle && record.number != LINK_ENABLE) return "";
  note(static_cast<std::uint64_t>(record.number) << 32 ^ static_cast<std::uint64_t>(tag));
  board::PacketDevices& packets = board_.packets();
  switch (record.number) {
    case LINK_ENABLE:
      enable(device, record.ints[1], at);
      return "";
    case LINK_VELOCITY:
      if (!is({Kind::Motor})) return wrong();
      wheels_.set_velocity(device.index, record.reals[0], at);
      return "";
    case LINK_POSITION:
      if (!is({Kind::Motor})) return wrong();
      wheels_.set_position(device.index, record.reals[0], at);
      return "";
    case LINK_LED:
      if (!is({Kind::Led})) return wrong();
      set_led(device.index, record.ints[1] != 0, at);
      return "";
    case LINK_SEND: {
      if (!is({Kind::Emitter})) return wrong();
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(record.texts[0].bytes);
      const std::size_t size = record.texts[0].size;
      for (std::size_t i = 0; i < size; ++i) note(bytes[i]);
      if (size > static_cast<std::size_t>(board::kPacketQueueBytes) ||
          !packets.send(device.index, bytes, static_cast<int>(size), at))
        return fmt::format(
            "emitter '{}': got a packet of {} bytes that its queue of {} has no room for; it is lost",
            device.name, size, board::kPacketQueueBytes);
      return "";
    }
    case LINK_CHANNEL: {
      const int channel = static_cast<int>(std::clamp<std::int64_t>(record.ints[1], -1, 1 << 30));
      if (is({Kind::Emitter}))
        packets.set_emitter_channel(device.index, channel);
      else if (is({Kind::Receiver}))
        packets.set_receiver_channel(device.index, channel);
      else
        return wrong();
      return "";
    }
    case LINK_RANGE:
      if (!is({Kind::Emitter})) return wrong();
      packets.set_emitter_range_m(device.index, record.reals[0]);
      return "";
    case LINK_PLAY:
      if (!is({Kind::Speaker})) return wrong();
      return play(tag, text_of(record, 0), record.ints[1] != 0, at);
    case LINK_SILENCE:
      if (!is({Kind::Speaker})) return wrong();
      again_ = false;
      sound_ = -1;
      speaker_.stop(at);
      return "";
    case LINK_RECOGNISE:
      if (!is({Kind::Camera})) return wrong();
      recognition_period_ms_ = std::max<std::int64_t>(0, record.ints[1]);
      recognition_elapsed_ms_ = 0;
      return "";
    default:
      return fmt::format("{}: got a record that is no command for a device", row->name);
  }
}

void Puck::enable(Device& device, std::int64_t period_ms, Cycle at) {
  device.period_ms = std::max<std::int64_t>(0, period_ms);
  device.elapsed_ms = 0;
  if (device.kind == Kind::Receiver) board_.packets().switch_receiver(device.index, period_ms > 0);
  if (device.kind == Kind::Camera && period_ms > 0) camera_->start(at);
}

void Puck::set_led(int led, bool on, Cycle at) {
  const board::Pin pin = led < 8    ? board::kRingLedPins[led]
                         : led == 8 ? board::kBodyLedPin
                                    : board::kFrontLedPin;
  board_.pins().write_bit(pin.letter(), pin.bit, on, at);
}

std::string Puck::play(std::int64_t, const std::string& sound, bool again, Cycle at) {
  // "sounds/haa.wav" is "haa"
  const std::string file = sound.substr(sound.find_last_of('/') + 1), stem = file.substr(0, file.find('.'));
  const auto found = std::find_if(std::begin(kSounds), std::end(kSounds),
                                  [&](const StoredSound& s) { return stem == s.name; });
  if (found == std::end(kSounds))
    return "speaker: got sound '" + sound +
           "', expected one that the robot stores: haa, spaah, ouah, yaouh, wouaaaah";
  if (!speaks_) {
    speaks_ = true;
    // as e_init_sound() does
    const board::Pin power = board::kCodecOnPin;
    board_.pins().write_bit(power.letter(), power.bit, true, at);
    speaker_.start(at);
    speaker_.codec().configure();
  }
  sound_ = static_cast<int>(found - std::begin(kSounds));
  again_ = again;
  playing_ = sound;
  speaker_.play(found->offset, found->samples, at);
  sound_until_ = speaker_.next_group(at) + found->samples * drivers::kCodecGroupCycles / drivers::kCodecGroup;
  return "";
}

// --- samples

void Puck::sample(std::int64_t milliseconds, Cycle at, link_packet& to) {
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    Device& device = devices_[i];
    if (device.period_ms == 0) continue;
    device.elapsed_ms += milliseconds;
    if (device.elapsed_ms < device.period_ms) continue;
    device.elapsed_ms = 0;
    take(device, i, at, to);
  }
  recognise(milliseconds, at, to);
  tell_playing(at, to);
}

void Puck::take(const Device& device, std::size_t number, Cycle at, link_packet& to) {
  const auto tag = static_cast<std::int64_t>(number) + 1;
  const auto put3 = [&](const sim::Vec3& v) { put(to, tag, {v.x, v.y, v.z}); };
  switch (device.kind) {
    case Kind::Proximity:
      return put(to, tag, {proximity(device.index, at)});
    case Kind::Light:
      return put(to, tag, {light(device.index, at)});
    case Kind::Ground:
      return put(to, tag, {ground(device.index, at)});
    case Kind::Virtual:
      return put(to, tag, {board_.virtual_devices().get(device.name).value_or(kNaN)});
    case Kind::Encoder:
      return put(to, tag, {wheels_.angle_rad(device.index, at)});
    case Kind::Accelerometer:
      return put3(in_axes(board_, acceleration(at)));
    case Kind::Gyro:
      return put3(in_axes(board_, rates(at)));
    case Kind::TrueGyro: {
      const sim::Vec3 r = board::true_state(board_, at).rates_rad_s;
      const double scale = device.index == kPlain ? 1 : kGyroScale;
      return put(to, tag, {r.x * scale, r.y * scale, r.z * scale});
    }
    case Kind::Gps: {
      const board::TrueState state = board::true_state(board_, at);
      const sim::Vec3 &p = state.position_m, &v = state.velocity_m_s;
      return put(to, tag, {p.x, p.y, p.z, v.x, v.y, v.z, state.attitude_rad.z});
    }
    case Kind::Compass:
      return put3(board::true_state(board_, at).north);
    case Kind::Inertial:
      return put3(board::true_state(board_, at).attitude_rad);
    case Kind::Tof:
      return put(to, tag, {time_of_flight(at)});
    case Kind::Distance: {
      const sim::DeviceDesc& desc = board_.setup().devices[static_cast<std::size_t>(device.index)];
      const sim::Scene* scene = board_.scene();
      return put(to, tag,
                 {scene ? measured_distance(*scene, board_.setup().robot, desc, board_.clock().click_at(at))
                        : desc.table.back().value});
    }
    case Kind::Ranges:
      return take_ranges(board_.setup().devices[static_cast<std::size_t>(device.index)], tag, at, to);
    case Kind::Selector:
      return put(to, tag, {static_cast<double>(board_.selector())});
    case Kind::Battery:
      return put(to, tag, {board_.power().battery().charge(at) * board_.setup().battery_wh * 3600});
    case Kind::Keyboard: {
      const double now_s = sim::to_seconds(board_.clock().click_at(at));
      std::vector<double> down;
      for (const auto& key : board_.virtual_devices().typed)
        if (now_s >= key.from_s && now_s < key.to_s) down.push_back(key.key);
      link_begin(&to, LINK_KEYS);
      link_numbers(&to, down.data(), down.size());
      return link_end(&to);
    }
    case Kind::Camera: {
      const std::vector<std::uint8_t>& picture = camera_->picture(at);
      link_begin(&to, LINK_PICTURE);
      link_int(&to, tag);
      link_int(&to, kCameraColumns);
      link_int(&to, kCameraRows);
      link_int(&to, 0);
      link_bytes(&to, picture.data(), picture.size());
      return link_end(&to);
    }
    case Kind::Microphone:
      return take_sound(device.index, tag, at, to);
    case Kind::Receiver:
      return take_packets(device, tag, to);
    case Kind::Idle:
      // nothing turns it
      if (device.node == WB_NODE_POSITION_SENSOR) put(to, tag, {0});
      return;
    case Kind::Led:
    case Kind::Motor:
    case Kind::Speaker:
    case Kind::Emitter:
    case Kind::Display:
      return;  // nothing to measure
  }
}

double Puck::proximity(int sensor, Cycle at) {
  drivers::AdcScan& scan = drivers_.scan();
  int counts;
  if (scan.lit_number(sensor, at) >= 0 && scan.dark_number(sensor, at) >= 0) {
    const drivers::AdcScan::Pair pair = scan.pair(sensor, at);
    counts = pair.dark - pair.lit;
  } else {
    // the scan has not come round yet, which a program of the robot would have waited for
    counts = board_.ir().counts(sensor, at, -1) -
             board_.ir().counts(sensor, at, drivers::scan_flash_cycles(sensor));
  }
  return std::clamp(counts, 0, kFullScale);
}

double Puck::light(int sensor, Cycle at) {
  drivers::AdcScan& scan = drivers_.scan();
  return scan.dark_number(sensor, at) >= 0 ? scan.dark(sensor, at) : board_.ir().counts(sensor, at, -1);
}

/// Left, centre, right: two registers each, the high byte first.
double Puck::ground(int sensor, Cycle at) {
  std::uint8_t high = 0, low = 0;
  read_registers(board_.i2c(), board::kGroundAddress, 2 * sensor, &high, 1, at);
  read_registers(board_.i2c(), board::kGroundAddress, 2 * sensor + 1, &low, 1, at);
  return high << 8 | low;
}

/// mm to the first thing straight ahead.
double Puck::time_of_flight(Cycle at) const {
  const sim::Scene* scene = board_.scene();
  if (!scene) return kTofMostMm;
  const sim::Clicks now = board_.clock().click_at(at);
  const sim::Pose2 pose = scene->pose(board_.setup().robot, now);
  const sim::Vec2 ahead = sim::Frame2(pose).turn({1, 0});
  const sim::Ray ray{{pose.x_m + kTofForwardM * ahead.x, pose.y_m + kTofForwardM * ahead.y, kTofHeightM},
                     {ahead.x, ahead.y, 0}};
  sim::SceneHit hit;
  if (!scene->cast(ray, kTofMostMm / 1000, board_.setup().robot, now, &hit)) return kTofMostMm;
  return std::round(hit.distance_m * 1000);
}

void Puck::take_ranges(const sim::DeviceDesc& desc, std::int64_t tag, Cycle at, link_packet& to) const {
  std::vector<double> seen;
  if (const sim::Scene* scene = board_.scene())
    seen = ranges(*scene, board_.setup().robot, desc, board_.clock().click_at(at));
  link_begin(&to, LINK_NUMBERS);
  link_int(&to, tag);
  link_numbers(&to, seen.data(), seen.size());
  link_end(&to);
}

/// m/s2: forward, left, up.
sim::Vec3 Puck::acceleration(Cycle at) {
  if (has_lsm_) {
    std::uint8_t bytes[6];
    read_registers(board_.i2c(), board::kLsmAccAddress, 0x28, bytes, 6, at);
    // the library's own scale, 768 counts of 1 g; its first axis is the sensor's second
    const auto scaled = [&](int axis) {
      return ((word_of(bytes + 2 * axis) >> 4) - (word_of(bytes + 2 * axis) >> 6)) * kG / kAccPerG;
    };
    return {scaled(0), scaled(1), scaled(2)};
  }
  drivers::AdcScan& scan = drivers_.scan();
  const drivers::AdcScan::AccRing& ring = scan.acc_scan(at);
  const std::int64_t samples = scan.clock().acc_samples(at);
  const auto mean = [&](std::size_t axis) {
    if (samples == 0)
      return static_cast<double>(board_.convert(board::kAccChannel + static_cast<int>(axis), at));
    double sum = 0;
    const int count = static_cast<int>(std::min<std::int64_t>(samples, kAccMean));
    for (int back = 0; back < count; ++back)
      sum += ring[axis][static_cast<std::size_t>((samples - back) % drivers::kAccSamples)];
    return sum / count;
  };
  const auto scaled = [&](std::size_t axis) { return (mean(axis) - kAccZero) * kG / kAccPerG; };
  return {scaled(1), scaled(0), scaled(2)};
}

/// In Webots' units of the e-puck's gyroscope: about forward, left, up.
sim::Vec3 Puck::rates(Cycle at) {
  std::uint8_t bytes[6];
  read_registers(board_.i2c(), board::kLsmGyroAddress, 0x28 | 0x80, bytes, 6, at);
  const auto scaled = [&](int axis) {
    return word_of(bytes + 2 * axis) * kGyroDegPerCount * kRadPerDeg * kGyroScale;
  };
  return {scaled(0), scaled(1), scaled(2)};
}

void Puck::take_sound(int microphone, std::int64_t tag, Cycle at, link_packet& to) {
  const drivers::AdcScan& scan = drivers_.scan();
  const std::int64_t count = scan.clock().interrupts(at),
                     first = std::max<std::int64_t>(0, count - drivers::kMicSamples);
  std::vector<std::int16_t> samples;
  for (std::int64_t n = first; n < count; ++n)
    samples.push_back(static_cast<std::int16_t>((scan.mic_sample(microphone, n) - kMicZero) * kMicScale));
  link_begin(&to, LINK_SOUND);
  link_int(&to, tag);
  link_bytes(&to, samples.data(), samples.size() * sizeof samples[0]);
  link_end(&to);
}

void Puck::take_packets(const Device& device, std::int64_t tag, link_packet& to) {
  board::PacketDevices& packets = board_.packets();
  packets.latch(device.index);
  while (const sim::ReceivedPacket* packet = packets.head(device.index)) {
    put_packet(to, tag, *packet, in_axes(board_, packet->direction));
    packets.drop(device.index);
  }
}

void Puck::tell_playing(Cycle at, link_packet& to) {
  const std::string plays = sound_ >= 0 && at < sound_until_ ? playing_ : "";
  if (plays == told_playing_) return;
  told_playing_ = plays;
  for (std::size_t i = 0; i < devices_.size(); ++i)
    if (devices_[i].kind == Kind::Speaker) {
      link_begin(&to, LINK_PLAYING);
      link_int(&to, static_cast<std::int64_t>(i) + 1);
      link_text(&to, plays.c_str());
      link_end(&to);
    }
}

// --- time

Cycle Puck::next_event() const {
  Cycle next = wheels_.next_event();
  if (camera_) next = std::min(next, camera_->next_event());
  if (again_) next = std::min(next, sound_until_);
  return next;
}

void Puck::run(Cycle at) {
  for (Cycle next; (next = next_event()) <= at;) {
    wheels_.run(next);
    if (camera_) camera_->run(next);
    if (again_ && sound_until_ <= next) {
      const StoredSound& sound = kSounds[sound_];
      speaker_.play(sound.offset, sound.samples, next);
      sound_until_ =
          speaker_.next_group(next) + sound.samples * drivers::kCodecGroupCycles / drivers::kCodecGroup;
    }
  }
}

struct Puck::Kept {
  std::vector<Device> devices;
  std::int64_t recognition_period_ms;
};

std::shared_ptr<const Puck::Kept> Puck::keep() const {
  return std::make_shared<Kept>(Kept{devices_, recognition_period_ms_});
}

void Puck::adopt(const Kept& kept, Cycle at) {
  devices_ = kept.devices;
  for (Device& device : devices_)
    if (device.period_ms > 0) enable(device, device.period_ms, at);
  recognition_period_ms_ = kept.recognition_period_ms;
}

void Puck::stop(Cycle at) {
  wheels_.stop(at);
  again_ = false;
  if (speaks_) speaker_.stop(at);
  for (Device& device : devices_) device.period_ms = 0;
}

}  // namespace programs
