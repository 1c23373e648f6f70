// SPDX-License-Identifier: MIT
// A program that calls hal_dspic's own functions on the chip, each in the states that matter to its time, and
// what each of these scenes took.
#pragma once
#include <string>
#include <vector>

#include "dspic30/memory/cycle.h"

namespace dev {

using dspic::Cycle;

/// Frames of the converter in one round of a scan.
inline constexpr int kFrames = 65;

/// What a scene has taken.
struct Taken {
  Cycle call = -1;                 // the call, from behind it to behind RETURN
  Cycle on = -1;                   // of it, until the converter is on
  Cycle dark = -1, lit = -1;       // of it, until the instruction that reads that value
  Cycle filled = -1;               // of it, behind the last handler's end
  std::vector<Cycle> walk;         // the T2 handler, cut at calls
  std::vector<Cycle> began;        // ADC handlers' flags were served
  std::vector<Cycle> frames;       // ADC handlers, entry and RETFIE included
  Cycle counted = -1, filed = -1;  // ADC's flag to the counters' step, to the microphones' index
  unsigned saved = 0;              // registers that the handler saves
  int saved_words = 0;             // other words
};

/// Of the scenes, in order; several may have one name.
std::vector<std::string> scene_names();

/// Runs the program to its end, built at `level`, with the selector at `selector`. What came before the first
/// scene, then each scene; empty, with lines in `problems`, on failure.
std::vector<Taken> run_scenes(const std::string& level, int selector, std::vector<std::string>& problems);

}  // namespace dev
