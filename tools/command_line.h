// SPDX-License-Identifier: MIT
// What the verbs share of the command line: messages in the house's grammar, help, and the meaning of names.
#pragma once
#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/twin/firmware_store.h"
#include "outputs/complain.h"

namespace tools {

/// A check of options: a number within bounds. (CLI11's own ranges take nan for one.)
CLI::Validator between(double least, double most);

/// The world of the folder one is in, as `new` makes it; a complaint that `missing` is missing, where there
/// is none.
std::string world_here(const char* missing);

/// Of options that name a file to be written: not an empty one.
CLI::Validator named();
/// A folder that is there.
CLI::Validator folder();
inline constexpr std::uint64_t kMostSeed = UINT64_MAX;
/// A world's seed, exactly.
CLI::Validator seed_range();
/// WORLD or --replay, one of them, and beside a recording nothing that it says itself: else lines in `problems`,
/// or CLI's error where both are missing.
void want_one_world(const CLI::App& verb, const CLI::Option& world, const CLI::Option& replay,
                    std::string& name, std::vector<std::string>& problems);

/// The world file that a name means (twin/world_file.h), told when it could mean another one. Empty, with a
/// line in `problems`, when there is none.
std::string find_world(const std::string& name, std::vector<std::string>& problems);

/// That world, read and checked; none, with lines in `problems`, when there is no such file
/// or it has mistakes.
std::optional<sim::WorldDesc> open_world(const std::string& name, std::vector<std::string>& problems);

/// After parse() has thrown: one line that says what was wrong, and where help is. Returns the exit code.
int usage_error(const CLI::App& app, const CLI::ParseError& e, int argc, char** argv);

/// `twinpuck help` and `twinpuck help VERB`.
void add_help(CLI::App& app);

/// An option that may be given several times, each time with one value: so that what
/// follows is not swallowed.
CLI::Option* one_each(CLI::Option* option);
/// "--hal sim|dspic" of a verb that builds or runs controllers; --way, which came before it, says so.
void add_hal(CLI::App& verb, std::string& hal);
/// "--fw" of a verb that runs a world; and "--seed", "--threads".
void add_firmware(CLI::App& verb, std::vector<std::string>& firmware);
void add_seed_and_threads(CLI::App& verb, std::optional<std::uint64_t>& seed, int& threads);

/// "ROBOT=VALUE" of each word; what names no robot is for every robot. False, told, when one is neither.
bool split_choices(const std::vector<std::string>& words, const char* option,
                   std::vector<twin::Choice>& choices);

using outputs::complain;

}  // namespace tools
