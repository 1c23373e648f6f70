// SPDX-License-Identifier: MIT
#include "tools/output_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "tools/command_line.h"

namespace tools {

namespace {

void add_picture_options(CLI::App& verb, outputs::PictureArguments& a) {
  verb.option_defaults()->group("Pictures and films");
  verb.add_option("--picture", a.picture, "PNG or SVG of the world with the robots' ways")->check(named());
  verb.add_flag(
      "--rays", a.rays,
      "draw the sensors' rays in picture and film: red up to what they met, orange as much farther as "
      "a dark colour lets it seem, green beyond");
  one_each(
      verb.add_option("--heatmap", a.heatmaps,
                      "where the robots spent their time: a PNG or SVG with a colour bar, or a CSV of cells")
          ->allow_extra_args(false)
          ->check(named()));
  verb.add_option("--heatmap-cell", a.heatmap_cell_m, "side of a cell (m)")
      ->check(between(1e-3, 100))
      ->capture_default_str();
  verb.add_option("--heatmap-scale", a.heatmap_scale, "colours by orders of magnitude or in proportion")
      ->check(CLI::IsMember({"log", "linear"}))
      ->capture_default_str();
  verb.add_option("--film", a.film, "WebM (.webm) or animated PNG (.png, .apng) of the run")->check(named());
  verb.add_option("--film-fps", a.film_fps, "frames in a second of film")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  verb.add_option("--film-speed", a.film_speed, "simulated seconds in a second of film")
      ->check(between(1e-3, 1e5))
      ->capture_default_str();
  verb.add_option("--film-size", a.film_size_px, "longer side of the film (pixels)")
      ->check(CLI::Range(160, 4096))
      ->capture_default_str();
  verb.add_option("--film-trail", a.film_trail_s, "simulated seconds of way behind each robot; 0: none")
      ->check(between(0, 1e6))
      ->capture_default_str();
}

void add_trace_options(CLI::App& verb, outputs::TraceArguments& a) {
  verb.option_defaults()->group("Traces");
  verb.add_option("--vcd", a.vcd,
                  "value change dump of pins, motors, interrupts, variables (docs/looking.md)")
      ->check(named());
  verb.add_option(
          "--vcd-signals", a.signals,
          "ROBOT:SIGNAL, several separated by commas: LED0, RA6, LATD, left_coils, T1, TX1, a variable; "
          "ROBOT may be '*'")
      ->delimiter(',');
  verb.add_option("--vcd-from", a.from_s, "first second of the window")->check(between(0, 1e7));
  verb.add_option("--vcd-to", a.to_s, "last second of the window")->check(between(0, 1e7));
  verb.add_option("--vcd-trigger", a.trigger,
                  "ROBOT:SIGNAL=VALUE: the window begins when the signal has the value");
  verb.add_option("--trace", a.timeline,
                  "time line of main program, interrupts, agendas and counters (JSON for ui.perfetto.dev)")
      ->check(named());
  verb.add_option("--trace-max-mb", a.most_timeline_mb, "the time line ends before it is larger")
      ->check(between(0.001, 1e6))
      ->capture_default_str();
  verb.add_option("--vcd-max-mb", a.most_mb, "the dump ends before it is larger")
      ->check(between(0.001, 1e6))
      ->capture_default_str();
}

}  // namespace

void add_output_options(CLI::App& verb, outputs::OutputArguments& a) {
  verb.option_defaults()->group("Outputs");
  verb.add_option("--record", a.record, "CSV of poses, steps, sensors and LEDs")->check(named());
  verb.add_option("--record-every", a.record_every_s, "seconds between rows of a robot")
      ->check(between(1e-4, 1e6))
      ->capture_default_str();
  verb.add_option("--summary", a.summary, "JSON of what the run came to")->check(named());
  verb.add_option("--report", a.report,
                  "HTML file of the run to look at in a browser: scrub, plots, time line, serial text, traps")
      ->check(named());
  verb.add_option("--save-images", a.images,
                  "folder for every picture that a program gets from its camera (PNG)")
      ->check(named());
  verb.add_option("--save-sound", a.sound_folder,
                  "folder for what each robot's loudspeaker plays, a WAV file each")
      ->check(named());
  verb.add_option("--coverage", a.coverage,
                  "lcov file that counts of lines, branches and functions of the programs are added to; "
                  "builds controllers with -O0 (docs/testing.md)")
      ->check(named());
  add_picture_options(verb, a.pictures);
  add_trace_options(verb, a.traces);
}

void add_profile_options(CLI::App& verb, outputs::ProfileArguments& a) {
  verb.option_defaults()->group("Checks");
  verb.add_flag("--profile", a.profile,
                "exact cycles of functions, interrupts, turns of the main loop and waits, and the deepest "
                "stack");
  verb.add_option("--profile-json", a.file, "the same as a JSON file")->check(named());
  verb.add_option("--budgets", a.budgets,
                  "TOML file of what functions and interrupts may take (docs/time.md); exit code 1 when "
                  "one takes more")
      ->check(named());
}

void refuse_without_output(const CLI::App& verb, std::vector<std::string>& problems) {
  struct Row {
    const char* option;
    std::vector<const char*> outputs;
  };
  const Row rows[] = {{"--record-every", {"--record"}},  {"--rays", {"--picture", "--film"}},
                      {"--heatmap-cell", {"--heatmap"}}, {"--heatmap-scale", {"--heatmap"}},
                      {"--film-fps", {"--film"}},        {"--film-speed", {"--film"}},
                      {"--film-size", {"--film"}},       {"--film-trail", {"--film"}},
                      {"--vcd-from", {"--vcd"}},         {"--vcd-to", {"--vcd"}},
                      {"--vcd-max-mb", {"--vcd"}},       {"--trace-max-mb", {"--trace"}}};
  for (const auto& [option, outputs] : rows)
    if (verb.get_option(option)->count() > 0 &&
        std::none_of(outputs.begin(), outputs.end(),
                     [&](const char* output) { return verb.get_option(output)->count() > 0; }))
      problems.push_back(fmt::format("command line: {}: got no {}, expected the output that it is for",
                                     option, fmt::join(outputs, " or ")));
}

}  // namespace tools
