// SPDX-License-Identifier: MIT
#include "hal_sim/inputs/recording.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <stdexcept>

#include "compiler/cache/object_cache.h"
#include "sim_core/base/input_file.h"

namespace inputs {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestRecording = 256u << 20;  // bytes
constexpr std::size_t kLargestImage = 64u << 20;       // bytes

std::string hex(std::uint64_t n) { return fmt::format("{:016x}", n); }

std::string line_of(sim::Clicks at, Json input) {
  input.erase("id");
  input["at"] = at;
  return input.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

namespace {

/// Images are named as in the file, which may have been moved together with them.
std::string beside(const std::string& recording, const std::string& image) {
  return (fs::path(recording).parent_path() / image).lexically_normal().string();
}

std::string hash_of(const std::string& file) {
  std::string bytes;
  return sim::read_input_file(file, kLargestImage, bytes).empty() ? cc::content_hash(bytes) : "";
}

}  // namespace

Json to_json(const Opening& o) {
  Json firmware = Json::array();
  for (const auto& choice : o.options.firmware) firmware.push_back({choice.robot, choice.value});
  // coverage is counted in programs of -O0
  const std::string level =
      !o.options.coverage.empty() && o.options.optimisation.empty() ? "-O0" : o.options.optimisation;
  return {{"twinpuck_inputs", 1},
          {"file", o.file},
          {"text", o.text},
          {"seed", o.seed},
          {"firmware", firmware},
          {"hal", o.options.hal},
          {"opt", level},
          {"sanitize", o.options.sanitize},
          {"supervisors", o.supervisors}};
}

namespace {
Json with_images(Json line, const std::vector<Opening::Image>& images) {
  for (const Opening::Image& i : images) line["images"].push_back({i.robot, i.program, i.file, i.hash});
  return line;
}
}  // namespace

RunImages images_of(const twin::Twin& twin) {
  RunImages run;
  std::map<std::string, std::string> hashes;  // by file
  for (int r = 0; r < twin.robots(); ++r) {
    const std::string& file = twin.image_path(r);
    if (file.empty()) continue;
    const auto [known, is_new] = hashes.try_emplace(file);
    if (is_new) {
      std::string bytes;
      if (const std::string wrong = sim::read_input_file(file, kLargestImage, bytes); !wrong.empty())
        run.error = file + ": " + wrong;
      known->second = cc::content_hash(bytes);
      run.bytes.try_emplace(known->second, std::move(bytes));
    }
    const sim::RobotDesc& robot = twin.world().robots[static_cast<std::size_t>(r)];
    run.images.push_back({robot.name, robot.firmware, file, known->second});
  }
  return run;
}

Recorder::Recorder(const std::string& path, const Opening& opening, const RunImages& run,
                   const std::string& option)
    : path_(path), option_(option), file_(path, option) {
  if (!run.error.empty()) file_.fail(run.error);
  std::vector<Opening::Image> images = run.images;
  for (Opening::Image& image : images) image.file = keep(run.bytes.at(image.hash), image.hash);
  file_.append(with_images(to_json(opening), images).dump() + "\n");
}

/// A copy of an image under the name of its content; the name as it is written down.
std::string Recorder::keep(const std::string& bytes, const std::string& hash) {
  const std::string folder = fs::path(path_).filename().string() + ".images";
  std::string name = folder + "/" + hash + ".elf";
  const std::string kept = beside(path_, name);
  std::error_code error;
  if (fs::exists(kept, error)) return name;
  fs::create_directories(beside(path_, folder), error);
  sim::OutputFile copy(kept, option_);
  copy.append(bytes);
  copy.close();
  if (!copy.error().empty()) file_.fail(copy.error());
  return name;
}

void Recorder::note(sim::Clicks at, const Json& input) {
  Json noted = input;
  if (input.at("do") == "program") {
    const std::string image = input.at("image").get<std::string>();
    std::string bytes;
    if (const std::string wrong = sim::read_input_file(image, kLargestImage, bytes); !wrong.empty())
      file_.fail(image + ": " + wrong);
    noted["image"] = keep(bytes, cc::content_hash(bytes));
  }
  file_.append(line_of(at, noted));
}

void Recorder::end(sim::Clicks at, std::uint64_t digest) {
  note(at, {{"do", "end"}, {"digest", hex(digest)}});
  file_.close();
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
      ++number;
      const Json line = Json::parse(text.substr(begin, end - begin));
      begin = end + 1;
      // The first line says of what run this is.
      if (number == 1) {
        if (const int version = line.at("twinpuck_inputs"); version != 1)
          throw std::runtime_error(fmt::format("version: got {}, expected 1", version));
        Opening& o = replay->opening;
        o.file = line.at("file").get<std::string>();
        o.text = line.at("text").get<std::string>();
        o.seed = line.at("seed").get<std::uint64_t>();
        o.options.hal = line.value("hal", "");
        // what recordings of before have beside it
        const std::string way = line.value("way", "");
        if (way == "native")
          throw std::runtime_error("way: got native, which is gone, expected chip; record the inputs anew");
        if (way == "chip" && o.options.hal.empty()) o.options.hal = "dspic";
        o.options.optimisation = line.at("opt").get<std::string>();
        o.options.sanitize = line.value("sanitize", false);
        o.supervisors = line.at("supervisors").get<std::vector<std::string>>();
        for (const Json& choice : line.at("firmware"))
          o.options.firmware.push_back({choice.at(0).get<std::string>(), choice.at(1).get<std::string>()});
        for (const Json& image : line.value("images", Json::array()))
          o.images.push_back({image.at(0).get<std::string>(), image.at(1).get<std::string>(),
                              beside(path, image.at(2).get<std::string>()), image.at(3).get<std::string>()});
      } else if (line.at("do") == "end") {
        replay->end_ = line.at("at").get<sim::Clicks>();
        replay->digest_ = std::stoull(line.at("digest").get<std::string>(), nullptr, 16);
      } else {
        if (const sim::Clicks at = line.at("at"); at < 0)
          throw std::runtime_error(fmt::format("at: got {}, expected 0 or more (clicks)", at));
        replay->inputs_.push_back(line);
        if (line.at("do") == "program")
          replay->inputs_.back()["image"] = beside(path, line.at("image").get<std::string>());
      }
    }
    if (number == 0) throw std::runtime_error("inputs: got an empty file, expected a recording");
  } catch (const std::runtime_error& e) {
    problems.push_back(fmt::format("{}:{}: {}", path, number, e.what()));
    return nullptr;
  } catch (const std::exception&) {  // of what is no JSON, or not of its kind
    problems.push_back(fmt::format(
        "{}:{}: inputs: got a line of another kind, expected one that view --record-inputs writes", path,
        number));
    return nullptr;
  }
  return replay;
}

void Replay::resume(twin::Options& options) const {
  options.hal = opening.options.hal;
  options.optimisation = opening.options.optimisation;
  options.firmware = opening.options.firmware;
  options.sanitize |= opening.options.sanitize;
  std::map<std::string, bool> is_same;  // by image that was kept
  const std::string folder = fs::path(opening.file).parent_path().string();
  for (const Opening::Image& image : opening.images) {
    const auto known = is_same.find(image.file + image.program);
    bool same = known != is_same.end() && known->second;
    if (known == is_same.end()) {
      std::vector<std::string> problems;
      const std::string built = twin::provide_image(image.program, folder, options, problems);
      same = !built.empty() && hash_of(built) == image.hash;
      is_same[image.file + image.program] = same;
    }
    if (!same) options.firmware.push_back({image.robot, image.file});
  }
}

void Replay::finish(Inputs& inputs, sim::Simulation& simulation, std::vector<std::string>& problems) {
  apply_due(inputs, simulation.now());
  if (end_ < 0 || simulation.now() < end_ || simulation.digest() == digest_) return;
  problems.push_back(
      fmt::format("replay: got digest {}, expected {} as recorded; world, program or Twinpuck are others",
                  hex(simulation.digest()), hex(digest_)));
}

std::string Replay::cut_off(const std::string& path) {
  return path +
         ": inputs: got a recording without its end, expected a last line with a digest; nothing is compared";
}

void Replay::apply_due(Inputs& inputs, sim::Clicks now) {
  for (; next() <= now; ++at_) inputs.apply(inputs_[at_]);
}

}  // namespace inputs
