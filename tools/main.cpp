// SPDX-License-Identifier: MIT
// twinpuck: the command. Verbs live in files of their own.
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

#include "sim_core/load/world_loader.h"
#include "tools/printable.h"
#include "tools/verbs.h"

namespace tools {
namespace {
// names that a mistyped word on the command line may have meant
std::vector<std::string> known_words(const CLI::App& app) {
  std::vector<std::string> words;
  for (const auto* o : app.get_options())
    for (const auto& name : o->get_lnames()) words.push_back("--" + name);
  for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    words.push_back(verb->get_name());
  return words;
}

int usage_error(const CLI::App& app, const CLI::ParseError& e, int argc, char** argv) {
  const CLI::App* at = &app;
  for (const auto* verb : app.get_subcommands()) at = verb;
  std::string line = "command line: " + std::string(e.what());
  const bool extras = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  const bool missing = e.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError);
  for (int i = 1; i < argc && (extras || missing); ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    const auto words = known_words(*at);
    if (std::find(words.begin(), words.end(), word) != words.end() || word == at->get_name()) continue;
    if (std::string(e.what()).find(word) == std::string::npos && extras) continue;
    const std::string guess = sim::did_you_mean(word, words);
    line = "command line: unknown word: got '" + word + "', expected an option or verb of `twinpuck" +
           (at == &app ? "" : " " + at->get_name()) + "`" +
           (guess.empty() ? "" : "; did you mean '" + guess + "'?");
    break;
  }
  std::cerr << line << "\nTry `twinpuck " << (at == &app ? "" : at->get_name() + " ") << "--help`.\n";
  return kBadInput;
}
}  // namespace
}  // namespace tools

int main(int argc, char** argv) {
  const tools::PrintableStream out(std::cout), error(std::cerr);
  // what cannot be written is an error of the call, not the end of the program
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  int exit_code = tools::kPass;
  CLI::App app{"Twinpuck: the firmware twin of the e-puck robot"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "twinpuck " TWINPUCK_VERSION);
  tools::add_run(app, exit_code);
  tools::add_check(app, exit_code);
  tools::add_build(app, exit_code);
  tools::add_lint(app, exit_code);
  tools::add_cycles(app, exit_code);
  tools::add_new(app, exit_code);
  tools::add_inspect(app, exit_code);
  tools::add_list(app, exit_code);
  tools::add_import(app, exit_code);
  tools::add_lab(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return tools::usage_error(app, e, argc, argv);
  } catch (const std::filesystem::filesystem_error& e) {
    // a loop of links, a folder that may not be read: whatever was named, it is the user's to mend
    tools::complain({(e.path1().empty() ? "file system" : e.path1().string()) +
                     ": cannot be used: " + e.code().message()});
    return tools::kBadInput;
  } catch (const std::exception& e) {
    std::cerr << "twinpuck: internal error: " << e.what() << '\n';
    return tools::kInternal;
  }
  return exit_code;
}
