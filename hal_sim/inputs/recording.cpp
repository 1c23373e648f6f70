// SPDX-License-Identifier: MIT
#include "hal_sim/inputs/recording.h"

#include <fmt/format.h>

#include <stdexcept>

#include "sim_core/base/input_file.h"

namespace inputs {

namespace {

constexpr std::size_t kLongestRecording = 256u << 20;  // bytes

std::string hex(std::uint64_t n) { return fmt::format("{:016x}", n); }

std::string line_of(sim::Clicks at, Json input) {
  input.erase("id");
  input["at"] = at;
  return input.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Json to_json(const Opening& o) {
  Json firmware = Json::array();
  for (const auto& choice : o.options.firmware) firmware.push_back({choice.robot, choice.value});
  return {{"twinpuck_inputs", 1},
          {"file", o.file},
          {"text", o.text},
          {"seed", o.seed},
          {"firmware", firmware},
          {"hal", o.options.hal},
          {"opt", o.options.optimisation},
          {"supervisors", o.supervisors}};
}

Recorder::Recorder(const std::string& path, const Opening& opening) : file_(path, "--record-inputs") {
  file_.append(to_json(opening).dump() + "\n");
}

void Recorder::note(sim::Clicks at, const Json& input) { file_.append(line_of(at, input)); }

void Recorder::end(sim::Clicks at, std::uint64_t digest) {
  note(at, {{"do", "end"}, {"digest", hex(digest)}});
  file_.close();
}

std::string recording_text(const Opening& opening, const std::vector<Json>& inputs, sim::Clicks end,
                           std::uint64_t digest) {
  std::string text = to_json(opening).dump() + "\n";
  for (const Json& input : inputs) text += line_of(input.at("at").get<sim::Clicks>(), input);
  return text + line_of(end, {{"do", "end"}, {"digest", hex(digest)}});
}

std::unique_ptr<Replay> Replay::open(const std::string& path, std::vector<std::string>& problems) {
  std::string text;
  const std::string wrong = sim::read_input_file(path, kLongestRecording, text);
  if (!wrong.empty()) {
    problems.push_back(path + ": " + wrong);
    return nullptr;
  }
  auto replay = std::make_unique<Replay>();
  int number = 0;
  try {
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin);
      if (end == std::string::npos) break;  // cut off: the last line is not whole
      const Json line = Json::parse(text.substr(begin, end - begin));
      begin = end + 1;
      if (number++ == 0) {
        if (line.at("twinpuck_inputs").get<int>() != 1) throw std::runtime_error("version: expected 1");
        Opening& o = replay->opening;
        o.file = line.at("file").get<std::string>();
        o.text = line.at("text").get<std::string>();
        o.seed = line.at("seed").get<std::uint64_t>();
        o.options.hal = line.value("hal", "");
        // what recordings of before have beside it
        const std::string way = line.value("way", "");
        if (way == "native")
          throw std::runtime_error("way: got native, which is gone; record the inputs anew");
        if (way == "chip" && o.options.hal.empty()) o.options.hal = "dspic";
        o.options.optimisation = line.at("opt").get<std::string>();
        o.supervisors = line.at("supervisors").get<std::vector<std::string>>();
        for (const Json& choice : line.at("firmware"))
          o.options.firmware.push_back({choice.at(0).get<std::string>(), choice.at(1).get<std::string>()});
      } else if (line.at("do") == "end") {
        replay->end_ = line.at("at").get<sim::Clicks>();
        replay->digest_ = std::stoull(line.at("digest").get<std::string>(), nullptr, 16);
      } else {
        if (line.at("at").get<sim::Clicks>() < 0) throw std::runtime_error("at: expected 0 or more");
        replay->inputs_.push_back(line);
      }
    }
    if (number == 0) throw std::runtime_error("got an empty file, expected a recording of inputs");
  } catch (const std::exception& e) {
    problems.push_back(fmt::format("{}:{}: {}", path, number, e.what()));
    return nullptr;
  }
  return replay;
}

void Replay::resume(twin::Options& options) const {
  options.hal = opening.options.hal;
  options.optimisation = opening.options.optimisation;
  options.firmware = opening.options.firmware;
}

void Replay::finish(Inputs& inputs, sim::Simulation& simulation, std::vector<std::string>& problems) {
  apply_due(inputs, simulation.now());
  if (end_ < 0 || simulation.now() < end_ || simulation.digest() == digest_) return;
  problems.push_back(
      fmt::format("replay: got digest {}, expected {} as recorded: world, program or Twinpuck are others",
                  hex(simulation.digest()), hex(digest_)));
}

void Replay::apply_due(Inputs& inputs, sim::Clicks now) {
  for (; next() <= now; ++at_) inputs.apply(inputs_[at_]);
}

}  // namespace inputs
