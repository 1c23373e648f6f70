// SPDX-License-Identifier: MIT
// A class: a folder of folders, one a student. Each program is built and each exercise tried in a process of
// its own, for a limited time, so whatever is handed in comes to a row.
//
//   DIR/anna/obstacle/*.c --find--> build, a process each --> try, a process each --> Class:
//                                                                                     student x exercise
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "exercises/run.h"

namespace lab {

struct Student {
  std::string name;    ///< the folder's
  std::string folder;  ///< as it was named, for commands
  Programs programs;
  std::vector<Cell> cells;  ///< one an exercise, in their order
};

struct Class {
  std::vector<const Exercise*> exercises;
  Setting setting;
  std::string options;            ///< what `lab --replay` needs besides: "--hal sim --full"
  std::vector<Student> students;  ///< by name
};

/// Whether `folder` holds no program of the lab's (`known`: all their names), and folders in it hold some
/// that are wanted.
bool is_class(const std::string& folder, const std::set<std::string>& known,
              const std::set<std::string>& wanted, bool by_id);

/// Tries everything, `setting.jobs` at a time, each piece for at most `limit_s` real seconds. `row` gets
/// every student, by name, as soon as those before are known. Notes go to stderr. Where `setting.is_over`
/// says so, what is left is not tried, and its cells say that.
void try_class(const std::string& folder, const twin::Options& options, bool by_id, double limit_s,
               Class& all, const std::function<void(const Student&)>& row);

/// "twinpuck lab --replay I1:corners:3 --mine DIR --picture I1.png --report I1.html";
/// empty: no run tells why.
std::string replay_command(const Cell& cell, const std::string& mine, const std::string& options);

/// A word as a shell takes it.
std::string shell_word(const std::string& word);

}  // namespace lab
