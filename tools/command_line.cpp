// SPDX-License-Identifier: MIT
#include "tools/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <regex>

#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/world_loader.h"
#include "tools/verbs.h"

namespace tools {

namespace fs = std::filesystem;

CLI::Validator between(double least, double most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return std::string();
        return fmt::format("got {}, expected {:g} to {:g}", text, least, most);
      },
      fmt::format("{:g} to {:g}", least, most));
}

CLI::Validator named() {
  return CLI::Validator(
      [](std::string& text) { return text.empty() ? "got '', expected the name of a file" : std::string(); },
      "");
}

CLI::Validator folder() {
  return CLI::Validator(
      [](std::string& text) {
        std::error_code none;
        return std::filesystem::is_directory(text, none)
                   ? std::string()
                   : fmt::format("got '{}', expected a folder that is there", text);
      },
      "");
}

CLI::Validator seed_range() {
  return CLI::Validator(
      [](std::string& text) {
        std::uint64_t seed = 0;
        const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), seed);
        if (wrong == std::errc() && end == text.data() + text.size()) return std::string();
        return fmt::format("got {}, expected 0 to {}", text, kMostSeed);
      },
      "NONNEGATIVE");
}

std::string world_here(const char* missing) {
  std::error_code none;
  if (!std::filesystem::is_regular_file("world.toml", none)) throw CLI::RequiredError(missing);
  return "world.toml";
}

void want_one_world(const CLI::App& verb, const CLI::Option& world, const CLI::Option& replay,
                    std::string& name, std::vector<std::string>& problems) {
  if (world.count() + replay.count() == 0) name = world_here("WORLD or --replay");
  if (replay.count() == 0) return;
  if (world.count() > 0)
    problems.push_back("command line: WORLD: got '" + world.results().front() +
                       "' besides --replay, expected the recording alone, which holds its world");
  for (const std::string option : {"--fw", "--hal", "--opt", "--supervisor", "--seed"})
    if (verb.get_option(option)->count() > 0)
      problems.push_back("command line: " + option +
                         ": got one besides --replay, expected the recording alone, which says it");
}

CLI::Option* one_each(CLI::Option* option) { return option->allow_extra_args(false); }

void add_hal(CLI::App& verb, std::string& hal) {
  verb.add_option(
          "--hal", hal,
          "what controllers built from source are linked with: sim, whose busy drivers are the simulator's, "
          "or dspic, the image that is flashed; default: the world's, else sim")
      ->check(CLI::IsMember({"sim", "dspic"}));
  const auto gone = [](const std::string& way) {
    throw CLI::ValidationError("--way", "got " + way +
                                            ", expected --hal sim or --hal dspic; native is --hal "
                                            "sim now, chip is --hal dspic");
  };
  verb.add_option_function<std::string>("--way", gone)->group("");
}

void add_firmware(CLI::App& verb, std::vector<std::string>& firmware) {
  one_each(verb.add_option(
      "--fw", firmware,
      "[ROBOT=]FILE: a .elf or .hex, a folder of C files, or a controller's name; without ROBOT, for "
      "every robot"));
}

void add_seed_and_threads(CLI::App& verb, std::optional<std::uint64_t>& seed, int& threads) {
  verb.add_option("--seed", seed, "the world's seed, 0 or more, instead of the file's")->check(seed_range());
  verb.add_option("--threads", threads, "threads that run firmware; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

std::string find_world(const std::string& name, std::vector<std::string>& problems) {
  const twin::FoundWorld found = twin::find_world(name, problems);
  if (!found.notice.empty()) std::cerr << found.notice << '\n';
  return found.file;
}

std::optional<sim::WorldDesc> open_world(const std::string& name, std::vector<std::string>& problems) {
  const std::string file = find_world(name, problems);
  if (file.empty()) return std::nullopt;
  sim::LoadedWorld loaded = twin::load_world(file);
  if (!loaded.world) problems.push_back(loaded.report(file));
  return std::move(loaded.world);
}

namespace {

/// Names that a mistyped word may have meant.
std::vector<std::string> known_words(const CLI::App& app) {
  std::vector<std::string> words;
  for (const auto* o : app.get_options())
    for (const auto& name : o->get_lnames()) words.push_back("--" + name);
  for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    words.push_back(verb->get_name());
  return words;
}

const CLI::App* root_of(const CLI::App& app) {
  const CLI::App* at = &app;
  while (at->get_parent()) at = at->get_parent();
  return at;
}

/// "--for: [text]" or "Could not convert: --for = 5s": the option, and what was given for it.
std::string option_in(const std::string& message) {
  const std::size_t at = message.find("--");
  return at == std::string::npos ? "" : message.substr(at, message.find_first_of(" :=", at) - at);
}

/// The word after an option on the command line, or in it after '='.
std::string given_for(const std::string& option, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == option && i + 1 < argc) return argv[i + 1];
    if (word.rfind(option + "=", 0) == 0) return word.substr(option.size() + 1);
  }
  return "";
}

std::string in_the_houses_grammar(const CLI::App& at, const std::string& path, const CLI::ParseError& e,
                                  int argc, char** argv) {
  std::string said = e.what();
  const auto is = [&](CLI::ExitCodes code) { return e.get_exit_code() == static_cast<int>(code); };
  const std::string option = option_in(said);
  if (is(CLI::ExitCodes::ExtrasError)) {
    // CLI11 lists what nobody took: the first of it
    const auto left = at.remaining(true);
    const std::string word = left.empty() ? "" : left.front().substr(0, left.front().find('='));
    if (!word.empty()) {
      const bool is_option = word[0] == '-';
      const std::string guess = sim::did_you_mean(word, known_words(at));
      if (is_option || !guess.empty() || at.get_parent() == nullptr)
        return "unknown word: got '" + word + "', expected " +
               (at.get_parent() ? "an option of `" : "a verb of `") + path + "`" +
               (guess.empty() ? "" : "; did you mean '" + guess + "'?");
      return "one word too many: got '" + word + "', expected options only after those before it";
    }
  }
  if (is(CLI::ExitCodes::ConversionError) && !option.empty())
    return option + ": got '" + given_for(option, argc, argv) + "', expected a number" +
           (option == "--for" ? " of seconds" : "") + ", without a unit";
  if (is(CLI::ExitCodes::ArgumentMismatch) && said.find(": 1 required") != std::string::npos &&
      !option.empty())
    return option + ": got nothing, expected a value";
  const auto verb_is = [&](const std::string& word) {
    return "verb: got '" + word + "', expected one of those that `twinpuck --help` lists" +
           sim::did_you_mean_tail(word, known_words(*root_of(at)));
  };
  if (at.get_name() == "help" && argc > 2) return verb_is(argv[2]);
  if (is(CLI::ExitCodes::RequiredError) && !at.get_parent() && argc > 1) return verb_is(argv[1]);
  if (is(CLI::ExitCodes::RequiredError))
    return said.find("subcommand") != std::string::npos
               ? "verb: missing, expected one of those that `twinpuck --help` lists"
               : said.substr(0, said.find(' ')) + ": missing, expected as in `" + path + " --help`";
  // CLI11's own words: "--port: Value 70000 not in range 0 to 65535", "KIND: wrlds not in {worlds,parts}"
  static const std::regex kRange("(.*: )Value (.*) not in range (.*)"), kSet("(.*: )(.*) not in \\{(.*)\\}");
  std::smatch part;
  if (std::regex_match(said, part, kRange)) {
    const std::string range = part[3];
    return part[1].str() + "got " + part[2].str() + ", expected " +
           (range.size() > 100 ? "0 or more" : range);  // up to the largest double
  }
  if (std::regex_match(said, part, kSet))
    return part[1].str() + "got '" + part[2].str() + "', expected one of " +
           std::regex_replace(part[3].str(), std::regex(","), ", ");
  return said;
}

}  // namespace

int usage_error(const CLI::App& app, const CLI::ParseError& e, int argc, char** argv) {
  const CLI::App* at = &app;
  for (const auto* verb : app.get_subcommands()) at = verb;
  const std::string path = at == &app ? "twinpuck" : "twinpuck " + at->get_name();
  std::cerr << "command line: " << in_the_houses_grammar(*at, path, e, argc, argv) << "\nTry `" << path
            << " --help`.\n";
  return kBadInput;
}

void add_help(CLI::App& app) {
  app.footer(
      "Examples:\n"
      "  twinpuck run maze --fw obstacle --for 60 --picture maze.png\n"
      "  twinpuck new my_robot\n"
      "  twinpuck help run\n\n"
      "Exit codes:\n"
      "  0 good   1 a test failed, or an input has errors   2 wrong usage or bad input, nothing ran\n"
      "  3 firmware trapped or reset   4 no progress   5 nothing selected   6 internal error\n"
      "  7 an output was lost   124 --host-limit   130 interrupted");
  auto* verb = app.add_subcommand("help", "What a verb does and which options it takes");
  auto name = std::make_shared<std::string>();
  verb->add_option("VERB", *name, "a verb; without one, the list of verbs");
  verb->callback([&app, name] {
    if (name->empty()) {
      std::cout << app.help();
      return;
    }
    for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; }))
      if (known->get_name() == *name) {
        std::cout << known->help("twinpuck");
        return;
      }
    throw CLI::ExtrasError(std::vector<std::string>{*name});
  });
}

bool split_choices(const std::vector<std::string>& words, const char* option,
                   std::vector<twin::Choice>& choices) {
  for (const auto& w : words) {
    const auto eq = w.find('=');
    if (w.empty() || eq == 0 || eq + 1 == w.size()) {
      complain({"command line: " + std::string(option) + ": got '" + w +
                "', expected VALUE for every robot, or ROBOT=VALUE"});
      return false;
    }
    if (eq == std::string::npos)
      choices.push_back({"*", w});
    else
      choices.push_back({w.substr(0, eq), w.substr(eq + 1)});
  }
  return true;
}

}  // namespace tools
