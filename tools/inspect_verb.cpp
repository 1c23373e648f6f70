// SPDX-License-Identifier: MIT
// twinpuck inspect: explains one reading of a sensor, or shows response curves. The explaining is done by
// sensor_report.cpp and curve_report.cpp, the drawing by sim_core/record.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "hal_sim/twin/twin.h"
#include "outputs/curve_report.h"
#include "outputs/output_folder.h"
#include "outputs/run_files.h"
#include "outputs/sensor_report.h"
#include "sim_core/base/did_you_mean.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

struct InspectArguments {
  std::string world, robot, profile, picture, plot;
  int sensor = -1;
  double at_s = 0;
  std::optional<std::uint64_t> seed;
  std::vector<double> colour{1, 1, 1};
  double roughness = 0;
  std::vector<std::string> of_curves;  // options that were given and say what the wall of curves is
  bool json = false;
};

int wrong(const std::string& text) {
  complain({"command line: " + text});
  return kBadInput;
}

/// The profiles that "NAME,NAME" or "all" means; empty after a complaint.
std::vector<outputs::CurveRequest> profiles_of(const std::string& names) {
  std::vector<outputs::CurveRequest> out;
  std::vector<std::string> known;
  for (const sim::ProximityProfile& p : sim::proximity_profiles()) known.push_back(p.name);
  std::string rest = names == "all" ? fmt::format("{}", fmt::join(known, ",")) : names;
  while (true) {
    const std::string name = rest.substr(0, rest.find(','));
    const sim::ProximityProfile* profile = sim::find_profile(name);
    if (!profile) {
      wrong(fmt::format("--profile: got '{}', expected all or {}{}", name, fmt::join(known, ", "),
                        sim::did_you_mean_tail(name, known)));
      return {};
    }
    out.push_back({name, sim::config_of(*profile)});
    if (rest.find(',') == std::string::npos) return out;
    rest = rest.substr(rest.find(',') + 1);
  }
}

sim::Surface surface_of(const InspectArguments& a) {
  sim::Surface s;
  s.colour = {a.colour[0], a.colour[1], a.colour[2]};
  s.ir_reflectance = a.colour[0];
  s.roughness = a.roughness;
  return s;
}

int show_curves(const InspectArguments& a, const std::vector<outputs::CurveRequest>& curves) {
  const sim::Surface surface = surface_of(a);
  if (!a.json) std::cout << outputs::curve_table(curves, surface);
  if (a.plot.empty()) return kPass;
  std::vector<sim::CurveLine> lines;
  for (const outputs::CurveRequest& c : curves) lines.push_back(outputs::curve_line(c, surface));
  sim::CurvePlotOptions options;
  options.title = curves.size() == 1 ? "Response of " + curves[0].name : "Response of proximity sensors";
  options.caption = fmt::format("flat wall of colour [{:g}, {:g}, {:g}], roughness {:g}", a.colour[0],
                                a.colour[1], a.colour[2], a.roughness);
  options.band = "band: one standard deviation, or half width";
  const std::string failed = sim::write_curve_plot(a.plot, lines, options);
  if (failed.empty()) return kPass;
  complain({failed});
  return kInvalidRun;
}

int show_reading(const InspectArguments& a, const outputs::SensorReport& report, const sim::Scene& scene) {
  outputs::CurveRequest own{fmt::format("{} sensor {}", report.robot, report.sensor), report.proximity.config,
                            report.gain, report.offset_counts};
  if (!a.picture.empty()) {
    outputs::CurveRequest plain = own;
    plain.gain = 1, plain.offset_counts = 0;
    if (!plain.config.rays_answer_singly) plain.config.rays = 1, plain.config.aperture_rad = 0;  // the table
    sim::SensorPictureOptions options;
    options.title = fmt::format("{}, sensor {} at {:g} s", report.robot, report.sensor, report.at_s);
    options.caption =
        fmt::format("{:.2f} mm / {:.3g} = {:.2f} mm apparent; dark {} - lit {} = {} counts without noise",
                    1000 * report.proximity.distance_m, report.proximity.factor,
                    1000 * report.proximity.response.apparent_distance_m, report.dark.counts,
                    report.lit.counts, report.prox_counts);
    const std::string failed =
        sim::write_sensor_picture(a.picture, scene, report.robot_index, scene.now(), report.proximity,
                                  outputs::curve_line(plain, sim::Surface{}), options);
    if (!failed.empty()) {
      complain({failed});
      return kInvalidRun;
    }
  }
  if (a.plot.empty() && a.profile.empty()) return kPass;
  std::vector<outputs::CurveRequest> curves{own};
  if (!a.profile.empty()) {
    for (outputs::CurveRequest& c : profiles_of(a.profile)) curves.push_back(std::move(c));
    if (curves.size() == 1) return kBadInput;
  }
  return show_curves(a, curves);
}

/// Whether picture and plot are files of their own that can be written.
bool can_draw(const InspectArguments& a, const sim::WorldDesc* world, std::vector<std::string>& problems) {
  sim::FileUses files;
  if (world) outputs::note_world(*world, {}, {}, files);
  files.writes(a.picture, "--picture");
  files.writes(a.plot, "--plot");
  files.check(problems);
  return problems.empty() && outputs::can_write(a.picture, "--picture", problems) &&
         outputs::can_write(a.plot, "--plot", problems);
}

int inspect_world(const InspectArguments& a) {
  std::vector<std::string> problems;
  std::optional<sim::WorldDesc> opened = open_world(a.world, problems);
  if (!opened) {
    complain(problems);
    return kBadInput;
  }
  sim::WorldDesc& world = *opened;
  if (a.seed) world.seed = *a.seed;
  if (world.robots.empty())
    return wrong(world.file + ": inspect: got a world without robots, expected one or more");
  int robot = a.robot.empty() ? 0 : -1;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    names.push_back(world.robots[i].name);
    if (world.robots[i].name == a.robot) robot = static_cast<int>(i);
  }
  if (robot < 0) {
    const std::string tail = sim::did_you_mean_tail(a.robot, names);
    if (names.size() > 12) names.resize(12), names.push_back("...");
    return wrong(
        fmt::format("--robot: got '{}', expected one of {}{}", a.robot, fmt::join(names, ", "), tail));
  }
  const int sensors =
      static_cast<int>(world.model_of(world.robots[static_cast<std::size_t>(robot)])->proximity.size());
  if (a.sensor >= sensors)
    return wrong(fmt::format("--sensor: got {}, expected 0 to {}", a.sensor, sensors - 1));
  if (a.sensor < 0 && (!a.picture.empty() || !a.plot.empty() || !a.profile.empty()))
    return wrong(fmt::format("--sensor: got none, expected 0 to {} for a picture or a curve", sensors - 1));
  twin::Options options;
  options.world_folder = fs::path(world.file).parent_path().string();
  options.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  if (a.at_s == 0)
    for (sim::RobotDesc& r : world.robots) r.firmware.clear();  // nothing runs: no need to build anything
  for (const std::string& notice : sim::proximity_notices(world)) std::cerr << notice << '\n';
  if (!can_draw(a, &world, problems)) {
    complain(problems);
    return kBadInput;
  }
  auto twin = twin::Twin::open(std::move(world), options, problems);
  if (!twin) {
    complain(problems);
    return kBadInput;
  }
  sim::Simulation& simulation = twin->simulation();
  while (simulation.now() < sim::from_seconds(a.at_s)) simulation.step();
  const sim::Scene& scene = simulation.scene();
  if (a.sensor >= 0) {
    const outputs::SensorReport report = outputs::report_sensor(*twin, a.world, robot, a.sensor);
    std::cout << (a.json ? to_json(report).dump(2) + "\n" : to_text(report));
    return show_reading(a, report, scene);
  }
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  std::string text =
      fmt::format("{}: robot {} at {:.4g} s, without noise; --sensor N explains one\n", a.world,
                  scene.world().robots[static_cast<std::size_t>(robot)].name, sim::to_seconds(scene.now())) +
      outputs::overview_head();
  for (int s = 0; s < sensors; ++s) {
    const outputs::SensorReport report = outputs::report_sensor(*twin, a.world, robot, s);
    text += outputs::overview_line(report);
    all.push_back(to_json(report));
  }
  std::cout << (a.json ? all.dump(2) + "\n" : text);
  return kPass;
}

int inspect(const InspectArguments& a) {
  for (const double part : a.colour)
    if (part < 0 || part > 1)
      return wrong(fmt::format("--colour: got {}, expected three numbers from 0 to 1", part));
  for (const auto& [option, file] : {std::pair{"--picture", &a.picture}, {"--plot", &a.plot}}) {
    const std::string kind = fs::path(*file).extension().string();
    if (!file->empty() && kind != ".png" && kind != ".svg")
      return wrong(fmt::format("{}: got '{}', expected a name that ends in .png or .svg", option, *file));
  }
  if (!a.of_curves.empty() && a.profile.empty() && a.plot.empty())
    return wrong(fmt::format("{}: got no --profile or --plot, expected curves, whose wall it is of",
                             a.of_curves.front()));
  if (!a.world.empty()) return inspect_world(a);
  if (a.profile.empty())
    return wrong("inspect: got no world, expected a WORLD, or --profile NAME for curves");
  if (!a.robot.empty() || a.sensor >= 0 || !a.picture.empty() || a.at_s != 0)
    return wrong(
        "inspect: got --robot, --sensor, --at or --picture without a world, expected a WORLD with them");
  const std::vector<outputs::CurveRequest> curves = profiles_of(a.profile);
  std::vector<std::string> problems;
  if (curves.empty() || !can_draw(a, nullptr, problems)) {
    complain(problems);
    return kBadInput;
  }
  if (a.json) std::cout << outputs::curve_json(curves, surface_of(a)).dump(2) << '\n';
  return show_curves(a, curves);
}

}  // namespace

void add_inspect(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("inspect", "Explain a sensor's reading, or show response curves");
  auto a = std::make_shared<InspectArguments>();
  verb->add_option("WORLD", a->world, "world file, or the name of one in worlds/");
  verb->add_option("--robot", a->robot, "which robot; the first otherwise");
  verb->add_option("--sensor", a->sensor, "which proximity sensor, from 0; all in one table otherwise")
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--at", a->at_s, "run the world's firmware for so many simulated seconds first")
      ->check(between(0, 1e6));
  verb->add_option("--seed", a->seed, "the world's seed instead of the file's")->check(seed_range());
  verb->add_option("--picture", a->picture, "draw the reading: PNG or SVG")->check(named());
  verb->add_option("--profile", a->profile, "NAME,NAME or all: response curves of these profiles");
  verb->add_option("--plot", a->plot, "plot response curves: PNG or SVG")->check(named());
  verb->add_option("--colour,--color", a->colour, "R,G,B of the wall in curves, each 0 to 1")
      ->delimiter(',')
      ->expected(3)
      ->check(between(0, 1));
  verb->add_option("--roughness", a->roughness, "of that wall, 0 to 1; the new colour rule asks for it")
      ->check(between(0, 1));
  verb->add_flag("--json", a->json, "for scripts");
  verb->callback([a, verb, &exit_code] {
    for (const char* option : {"--colour", "--roughness"})
      if (verb->get_option(option)->count() > 0) a->of_curves.push_back(option);
    exit_code = inspect(*a);
  });
}

}  // namespace tools
