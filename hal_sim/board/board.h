// SPDX-License-Identifier: MIT
// The e-puck, electrically: everything between the processor's pins and the world, for one robot.
//
//   the chip's pins --------------.
//   drivers known by heart -------+--> Board --> wheel angles, LEDs, IR light      (to the world)
//                                      Board <-- sim::sense_proximity, irradiance  (from the Scene)
//
// Modelled: port latches, directions and pin levels; two steppers that follow their coils; IR circuit; LEDs;
// selector; remote control's receiver; battery, fed by what is on. Motion sensors: accelerometer.h (before
// revision 1.3), lsm330.h (1.3).
//
// Every method takes the cycle of this robot's clock at which it happens. Cycles never go back between calls
// that change something. Nothing depends on who looked before: const methods have no side effects, and a
// sample has one value however often it is read. One Board is used by one thread at a time.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal_sim/board/battery.h"
#include "hal_sim/board/battery_params.h"
#include "hal_sim/board/camera.h"
#include "hal_sim/board/clock.h"
#include "hal_sim/board/codec.h"
#include "hal_sim/board/cycle.h"
#include "hal_sim/board/damage.h"
#include "hal_sim/board/data_eeprom.h"
#include "hal_sim/board/diagnosis.h"
#include "hal_sim/board/i2c_bus.h"
#include "hal_sim/board/noise.h"
#include "hal_sim/board/packet_devices.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/pin_driver.h"
#include "hal_sim/board/remote.h"
#include "hal_sim/board/sound_params.h"
#include "hal_sim/board/uart.h"
#include "hal_sim/board/virtual_devices.h"
#include "hal_sim/board/wiring.h"

namespace sim {
class Scene;
class SoundField;
bool has_light(const Scene& scene);
}  // namespace sim

namespace board {

/// Hardware revisions that firmware can tell apart.
enum class Revision {
  Analogue,  ///< rev 1.0 to 1.2: MMA7260 accelerometer on AN5 to AN7
  Rev13,     ///< rev 1.3: LSM330 on I2C, battery voltage on AN7
};

inline constexpr int kRingSensors = 8;

/// Camera of a robot that does not say which one it carries.
constexpr CameraKind usual_camera(Revision revision) {
  return revision == Revision::Rev13 ? CameraKind::Po8030d : CameraKind::Po3030k;
}

/// What distinguishes one robot from another; fixed while it is powered.
struct Setup {
  int robot = 0;                   ///< index in the Scene
  std::uint64_t seed = 1;          ///< of all noise of this robot
  int selector = 0;                ///< position 0 to 15
  double battery_v = 4.0;          ///< V at power-up with nothing but the electronics on, 3.0 to 4.2
  double battery_wh = kBatteryWh;  ///< Wh, energy of a full battery
  Revision revision = Revision::Analogue;
  std::array<double, 2> wheel_ratio{1.0, 1.0};  ///< true over nominal wheel size, left and right
  std::array<double, kRingSensors> ir_gain{1, 1, 1, 1, 1, 1, 1, 1};  ///< factor on the reflected response
  std::array<double, kRingSensors> ir_offset_counts{};  ///< added to dark - lit where nothing reflects
  double ir_noise_scale = 1.0;                          ///< factor on the profile's relative noise; 0 = none
  double ambient_noise_counts = 0;  ///< standard deviation of every conversion of an IR channel, counts
  double ambient_counts_per_w_m2 = kAmbientCountsPerWm2;  ///< fall of the dark sample with light
  CameraKind camera = CameraKind::Po3030k;
  CameraMount camera_mount = CameraMount::Upright;
  double camera_noise = 1;                    ///< factor on the camera's noise; 0 none
  double mic_noise_counts = kMicNoiseCounts;  ///< standard deviation of every conversion of a microphone
  std::array<double, 3> acc_offset_m_s2{};    ///< added to the specific force: forward, left, up
  std::array<double, 3> gyro_offset_rad_s{};  ///< added to the angular rates about these axes
  double motion_noise_scale = 1;              ///< factor on the noise of accelerometer and gyroscope
  double clock_ppm = 0;                       ///< crystal error, parts per million, positive = fast
  double boot_delay_s = 0;                    ///< s from the world's beginning to the first instruction
  std::string name;                           ///< in the world
  sim::WebotsDesc webots;                     ///< of the world
  std::vector<sim::DeviceDesc> devices;       ///< that only programs for Webots' interfaces know
};

/// One conversion of a proximity sensor's phototransistor, before any noise.
struct IrConversion {
  double irradiance_w_m2 = 0;    ///< W/m2, lamps and ambient light
  double light_counts = 0;       ///< counts that this light pulls the sample below darkness
  double reflection_counts = 0;  ///< counts that the flash adds to that, this sensor's gain included
  double relative_noise = 0;     ///< of the reflection: standard deviation, or half width when uniform; the
                                 ///< board's own noise scale is not in it
  bool uniform_noise = false;
  double offset_counts = 0;  ///< of a lit sample
  double settled = 1;        ///< part of the flash that the phototransistor has followed, 0 to 1
  /// Without noise, not rounded and not held within the converter's range.
  double counts() const { return kAdcMax - light_counts - (reflection_counts + offset_counts) * settled; }
};

/// How a wheel turns: its angle, the rate per cycle, and until when; `until` not after the instant asked for:
/// known at that instant only.
struct WheelTurn {
  double angle_rad = 0, rate_rad = 0;
  Cycle until = 0;
};

/// What the converter makes of a level given in counts: rounded, 0 to 4095.
inline int adc_counts(double level) {
  level += 0.5;
  if (!(level >= 1)) return 0;
  return level < kAdcMax ? static_cast<int>(level) : kAdcMax;
}

class Board {
 public:
  explicit Board(const Setup& setup);
  ~Board();
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;

  const Setup& setup() const { return setup_; }
  const RobotClock& clock() const { return clock_; }

  // --- the world

  /// The frozen scene that sensors see until the next call; null: a dark void. Called before each run window.
  void look_at(const sim::Scene* scene) {
    scene_ = scene;
    is_lit_ = scene && sim::has_light(*scene);
    if (is_soldered_) find_sound();
  }
  const sim::Scene* scene() const { return scene_; }

  /// Angle the wheel has turned since power-up, rad, forward positive, wheel ratio included. The rotor needs
  /// up to kRotorMoveCycles to follow a step, so constant speed gives a constant rim speed. O(1). `at` not
  /// before the last command.
  double wheel_angle_rad(Wheel wheel, Cycle at) const;
  /// The same, how fast it grows, and until when at that rate, unless somebody commands the motor.
  WheelTurn wheel_turn(Wheel wheel, Cycle at) const;
  /// Full steps since power-up, forward positive, not wrapped, lost steps not counted.
  std::int64_t steps(Wheel wheel, Cycle at) const;
  std::int64_t left_steps(Cycle at) const { return steps(Wheel::Left, at); }
  std::int64_t right_steps(Cycle at) const { return steps(Wheel::Right, at); }
  /// Coils A to D in bits 0 to 3.
  unsigned coils(Wheel wheel, Cycle at) const;
  /// Bits 0 to 7 the ring, 8 body, 9 front.
  std::uint32_t leds(Cycle at) const;
  /// Dark minus lit of the last completed pair of samples, or of a noise-free pair taken at `at` when no
  /// driver runs. No side effects, and what firmware reads later does not depend on it.
  int proximity_counts(int sensor, Cycle at) const;
  /// Everything that must repeat from run to run.
  std::uint64_t state_hash(Cycle at) const;

  // --- pins and registers

  enum class Register { Tris, Port, Lat };
  /// Word of port 'A' 'B' 'C' 'D' 'F' 'G' as the processor reads it now; other letters read 0. PORT gives pin
  /// levels: selector, battery detector and remote receiver included.
  std::uint16_t port_read(char port, Register reg, Cycle at) const;
  /// Writing PORT writes the latch. Motor coils move at once; LEDs follow.
  void port_write(char port, Register reg, std::uint16_t value, Cycle at);
  /// One latch bit, as BSET/BCLR do it (the read half of the instruction included).
  void latch_bit(char port, int bit, bool level, Cycle at);
  /// First cycle after `at` at which a PORT or LAT word can change by itself; kNever if it cannot.
  Cycle port_horizon(char port, Cycle at) const;

  /// As when it was first switched on, from world time `now` on, which is cycle `at`: rotors, devices, parts,
  /// battery, data EEPROM, noise, the clock's fractions and the boot delay. Selector, sensors that somebody
  /// defined, keys and the ends of UARTs stay. Behind processor_reset().
  void begin_again(sim::Clicks now, Cycle at);
  /// When that was last; 0: never.
  Cycle begun_at() const { return noise_.begun_at(); }
  /// The reset button, or asm("reset"): pins to inputs, drivers stop, wheels stay where they are. Wiring,
  /// selector, UART ends and the noise's sample numbers stay.
  void processor_reset(Cycle at);
  /// Selector turned by hand (or a test) while running.
  void turn_selector(int position);
  void set_battery(double volts, Cycle at);

  // --- damage: damage.h, line_damage.h

  /// Null: nothing was ever wrong with it.
  const Damage* damage() const { return damage_.get(); }
  /// For doing damage; made when it is asked for first. Sensors that a program has never read before see it
  /// from the cycles on that its numbers name; who changes dead LEDs or held pins calls damage_changed().
  Damage& be_damaged();
  /// Steps of a wheel are lost from `at` on as damage() says.
  void steps_changed(Wheel wheel, Cycle at);
  /// Counts that the accelerometer's outputs stand still at, from `at` on.
  void stick_accelerometer(bool is, Cycle at);
  /// LEDs or pins were changed.
  void damage_changed(Cycle at);
  /// Can a level be forced on this pin? Inputs, and those of LEDs.
  static bool can_be_held(char port, int bit);
  /// Somebody holds a pin at a level, or (empty) lets it go.
  void hold_pin(char port, int bit, std::optional<bool> level, Cycle at);
  /// Levels with those that somebody holds.
  std::uint16_t with_held_pins(int port, std::uint16_t levels) const {
    if (!damage_) return levels;
    const auto p = static_cast<std::size_t>(port);
    return static_cast<std::uint16_t>((levels & ~damage_->held_pins[p]) |
                                      (damage_->held_levels[p] & damage_->held_pins[p]));
  }
  /// The LEDs that a program has switched on, dead ones too.
  std::uint32_t driven_leds(Cycle at) const;
  void set_clock_ppm(double ppm, sim::Clicks at);
  void weaken_battery(double drop_v, double more_ohm, Cycle at) { battery_.weaken(drop_v, more_ohm, at); }
  /// While one of these lives, somebody outside asks: what is wrong has not been noticed by the robot.
  class Unseen {
   public:
    explicit Unseen(const Board& board) : damage_(board.damage()) {
      if (damage_) ++damage_->unseen;
    }
    ~Unseen() {
      if (damage_) --damage_->unseen;
    }
    Unseen(const Unseen&) = delete;
    Unseen& operator=(const Unseen&) = delete;

   private:
    const Damage* damage_;
  };

  // --- checks

  /// What the program makes of the board that an e-puck would not do for it, or would suffer from; up to
  /// `at`, in no order. Costs nothing while nobody asks.
  std::vector<Diagnosis> diagnoses(Cycle at) const;

  // --- devices

  /// A model of the chip is soldered on: its pins alone move the board's, and it asks for the microphones
  /// at every conversion.
  void solder() { is_soldered_ = true; }
  /// Whoever moves pins by itself; null: nobody. Outlives the board's use or takes itself away.
  void attach(PinDriver* driver) { driver_ = driver; }
  /// The motor itself, for a PinDriver.
  Stepper& own_motor(Wheel wheel) { return motors_[static_cast<std::size_t>(wheel)]; }

  /// Has publish_sound() anything to tell?
  bool has_sound_news() const { return is_any_used_ && codec_.has_news(); }
  Codec& codec() { return codec_; }
  const Codec& codec() const { return codec_; }
  /// The motor of a wheel, brought to `at`.
  Stepper& stepper(Wheel wheel, Cycle at);
  /// UART 1 (Bluetooth) or 2 (RS232).
  /// Is a byte on its way to the robot?
  bool is_receiving(Cycle at) {
    return is_any_used_ && (uarts_[0].next_arrival(at) < kNever || uarts_[1].next_arrival(at) < kNever);
  }
  Uart& uart(int number) { return uarts_[static_cast<std::size_t>(number - 1)]; }
  const Uart& uart(int number) const { return uarts_[static_cast<std::size_t>(number - 1)]; }
  /// Camera, motion sensors and turrets hang here.
  I2cBus& i2c() { return i2c_; }
  const I2cBus& i2c() const { return i2c_; }
  /// Null: the robot carries none.
  Camera* camera() { return camera_.get(); }
  const Camera* camera() const { return camera_.get(); }
  /// The processor's side of the bus.
  /// Emitters and receivers of packets, and sensors that a supervisor defines: for programs written
  /// for Webots' interfaces.
  PacketDevices& packets() { return packets_; }
  VirtualDevices& virtual_devices() { return virtual_; }
  const VirtualDevices& virtual_devices() const { return virtual_; }
  /// Plugs a turret or another part in; before power-up.
  void plug_in(std::unique_ptr<Part> part);
  const std::vector<std::unique_ptr<Part>>& parts() const { return parts_; }
  /// Voltage that a part puts on the analogue input AN`channel`, V; empty: none does.
  std::optional<double> part_analogue_v(int channel, Cycle at) const;
  /// Counts on AN`channel` where something else than the analogue accelerometer is connected: a part, or what
  /// revision 1.3 has there. Empty: the accelerometer's. Whatever samples AN5 to AN7 asks this first.
  std::optional<int> counts_of_others(int channel, Cycle at) const;
  /// e_init_port(): latches 0, directions as the library wants them, the I2C module on. (Its
  /// cost is the caller's.)
  void init_ports(Cycle at);
  /// Until when exchange() has nothing to do and nothing that firmware has not asked for
  /// happens; `at`: not known.
  Cycle horizon(Cycle at) const;
  /// Tick boundary: bytes from outside enter, bytes sent so far go out, old bookkeeping is dropped.
  void exchange(Cycle at);

  /// The same sample without noise: what a conversion is made of. `lit_for` as below.
  IrConversion ir_conversion(int sensor, Cycle at, Cycle lit_for) const;
  /// Counts of a proximity sensor's phototransistor that is held at `at`, its emitter having been on for
  /// `lit_for` cycles (negative: off). Noise of this and of the other inputs: noise.h.
  int ir_counts(int sensor, Cycle at, Cycle lit_for) const;
  /// Is every dark sample at the converter's top: no light, no noise?
  bool is_dark() const { return setup_.ambient_noise_counts == 0 && !is_lit_ && !damage_; }
  /// Counts of microphone 0 right, 1 left, 2 back that is held at `at`: 0 to 4095. Linear,
  /// all frequencies alike.
  int mic_counts(int microphone, Cycle at) const;
  /// What draws the noise of this robot's samples.
  const SampleNoise& noise() const { return noise_; }
  /// Counts of a single conversion of input AN`channel`, held at `at`; -1: nothing is known of that input.
  int convert(int channel, Cycle at) const;
  /// Battery as the library's raw value on AN7 (revision 1.3); 0 on others.
  int battery_counts(Cycle at) const;
  const Battery& battery() const { return battery_; }
  /// Something was switched on or off: the battery's current from `at` on. Whoever changes a device beside
  /// port_write() calls it. Motors count with the mean of their rhythm.
  void follow_power(Cycle at) {
    emitters_a_ = emitters_a(at);
    other_a_ = other_a(at);
    follow_motors(at);
  }
  /// The same when it was only the motors.
  void follow_motors(Cycle at) {
    coils_a_[0] = coils_a(Wheel::Left, at);
    follow_motor(Wheel::Right, at);
  }
  void follow_motor(Wheel wheel, Cycle at) {
    coils_a_[static_cast<std::size_t>(wheel)] = coils_a(wheel, at);
    draw(at);
  }
  /// The robot is switched off for good: nothing is drawn.
  void switch_off() { battery_.draw(0, 0); }
  /// Data EEPROM; resets leave it alone.
  DataEeprom& eeprom() { return eeprom_; }
  /// What somebody does with a remote control.
  RemoteReceiver& remote() { return remote_; }
  const RemoteReceiver& remote() const { return remote_; }
  /// Tells the air what the loudspeaker began or ended, at the tick boundary `now`.
  void publish_sound(sim::SoundField& field, sim::Clicks now);

  int selector() const { return setup_.selector; }
  /// For models of the chip: has exchange() put a byte on a wire, since it was last taken note of?
  bool has_wire_news() const { return has_wire_news_; }
  bool take_wire_news() { return std::exchange(has_wire_news_, false); }

 private:
  static int port_index(char port);
  /// Counts of a microphone without noise.
  double mic_level(int microphone, Cycle at) const;
  void find_sound();
  __attribute__((noinline)) int damaged_ir_counts(int sensor, Cycle at, Cycle lit_for) const;
  __attribute__((noinline)) int mic_counts_in_sound(int microphone, Cycle at) const;
  /// Levels of microphones are in 2^-kMicFraction counts, whole: a robot's are converted
  /// 50,000 times a second.
  static constexpr int kMicFraction = 24;
  int with_mic_noise(std::int64_t level, int microphone, Cycle at) const;
  unsigned pulses(Cycle at) const { return driver_ ? driver_->pulses(at) : 0; }
  bool owns_emitters() const { return driver_ && driver_->owns_emitters(); }
  /// Cycles for which the emitter line of a sensor has been on by its latch alone; -1 when off.
  Cycle line_on_for(int sensor, Cycle at) const;
  const Stepper& stepper_at(Wheel wheel, Cycle at) const {
    return driver_ ? driver_->motor_at(wheel, at) : motors_[static_cast<std::size_t>(wheel)];
  }
  void connect_steppers(Cycle at);
  /// Counts that the flash adds to a lit sample, noise included.
  double reflected_counts(int sensor, Cycle at, Cycle lit_for) const;
  /// Part of the flash that a phototransistor has followed, 0 to 1.
  double settled_share(int sensor, Cycle lit_for) const;
  /// Share of the time for which a wheel's two coils are energised while nothing new is commanded, 0 to 1.
  double coil_duty(Wheel wheel, Cycle at) const;
  /// Tells whoever looks at pins that a latch or a direction has changed.
  void outputs_changed(Cycle at);
  /// Lines whose latch or direction changes from what they are now: how long have they been on?
  void note_pulses(std::size_t port, std::uint16_t new_lat, std::uint16_t new_tris, Cycle at);
  /// Is the pin an output, and its latch 1?
  bool output_high(Pin pin) const;
  /// What everything that is on draws, A: the IR emitters, the motors, and all else.
  double emitters_a(Cycle at) const;
  double coils_a(Wheel wheel, Cycle at) const;
  double other_a(Cycle at) const;
  void draw(Cycle at) { battery_.draw(other_a_ + coils_a_[0] + coils_a_[1] + emitters_a_, at); }
  /// Nothing but pins moves coils and emitters: no driver in closed form runs, no part hears of pins.
  bool is_led_by_pins() const;
  void write_coils(std::uint16_t value, Cycle at);
  /// Latch of a port of which only emitter lines change.
  void write_emitters(std::size_t port, std::uint16_t value, Cycle at);

  // what every run looks at, together
  const sim::Scene* scene_ = nullptr;
  PinDriver* driver_ = nullptr;
  RobotClock clock_;
  bool is_lit_ = false;       // do lamps shine in the scene, or ambient light?
  bool is_any_used_ = false;  // of the devices below and the parts; until then nobody looks at them
  bool has_wire_news_ = false;
  bool is_soldered_ = false;
  bool may_hear_ =
      true;  // false: nothing sounds in the scene, found out once a tick for the models of the chip

  Setup setup_;
  RemoteReceiver remote_{clock_};

  std::array<std::uint16_t, kPorts> lat_{};  // of D the high byte only: the low one is the coils
  std::array<std::uint16_t, kPorts> tris_{};
  std::array<Cycle, 4> line_since_{};  // when the latch of an emitter line was last set
  std::array<Cycle, 4> lit_since_{};   // when its pin last went high
  struct LongPulse {
    std::int64_t count = 0;
    Cycle first = 0;
    Cycle longest = 0;
  };
  std::array<LongPulse, 4> long_pulses_{};
  double other_a_ = kProcessorA + kBluetoothA + kBoardA, coils_a_[2] = {0, 0},
         emitters_a_ = 0;  // as followed last

  std::unique_ptr<Damage> damage_;
  Stepper motors_[2] = {Stepper(-1), Stepper(+1)};
  Codec codec_;
  std::array<Uart, 2> uarts_;
  I2cBus i2c_;
  Battery battery_;
  DataEeprom eeprom_;
  std::unique_ptr<Camera> camera_;
  std::vector<std::unique_ptr<Part>> parts_;
  struct Settled {
    Cycle lit_for = -1;
    double share = 0;
  };
  mutable std::array<Settled, 2>
      settled_;  // flashes have two lengths nearly always: their exponentials, once
  SampleNoise noise_;
  std::int64_t mic_noise_per_face_;                          // of SampleNoise::dice(), as levels
  std::shared_ptr<const std::vector<std::int16_t>> on_air_;  // samples of the codec's line that the air plays
  PacketDevices packets_{clock_, setup_.robot, setup_.devices};
  VirtualDevices virtual_;
};

// --- what a converter asks for 50,000 times a second

inline int Board::with_mic_noise(std::int64_t level, int microphone, Cycle at) const {
  level += mic_noise_per_face_ * noise_.dice(NoiseOf::Microphone, microphone, at);
  return static_cast<int>(std::clamp<std::int64_t>(level >> kMicFraction, 0, kAdcMax));
}

inline int Board::mic_counts(int microphone, Cycle at) const {
  constexpr auto kSilence = static_cast<std::int64_t>((kMicIdleCounts + 0.5) * (1 << kMicFraction));
  return may_hear_ ? mic_counts_in_sound(microphone, at) : with_mic_noise(kSilence, microphone, at);
}

}  // namespace board
