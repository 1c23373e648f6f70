// SPDX-License-Identifier: MIT
// A translated stretch as bytes that can lie anywhere: what the translator makes, what is kept in a
// file, and what runs.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dspic30/translate/stretch.h"

namespace dspic::translate {

struct MachineCode {
  /// Eight bytes at `offset` that become an address: of what is named, and so many bytes behind it.
  struct Address {
    std::uint32_t offset = 0;
    std::string name;  ///< a function of the program's; interpreter(): of a word; "": these bytes themselves
    std::uint32_t addend = 0;
  };
  std::string
      bytes;  ///< instructions from the first byte on, and their constants; none: it cannot be translated
  std::vector<Address> addresses;
};

/// What Address::name calls the function that interprets a word, those that leave a stretch, by a jump,
/// straight on or by a return, the one that runs an instruction as it is decoded by then: never the stretch
/// that begins there; the one of a call of the host's, and answered().
std::string interpreter(std::uint32_t word);
inline constexpr const char *kArrive = "arrive", *kGoOn = "go on", *kReturn = "return", *kAlone = "alone",
                            *kHost = "host", *kTold = "told", *kHeard = "heard", *kAnswered = "answered";

/// What it calls the known routine that an item calls.
std::string known_routine(std::size_t item);

/// Names of the core's functions can be found from here on, by translated code and by the translator, even
/// where the core lies in a library that was loaded for its loader alone, such as a module of Python. True.
bool find_own_functions();

/// Put into memory, for as long as the process lives, as the code of these items. Null: a name is not known
/// here, or no memory.
Run placed(const MachineCode& code, const std::vector<Item>& items);

/// As one text, and back; false: it is not one that text_of() made of this key.
std::string text_of(const std::string& key, const MachineCode& code);
bool read_text(const std::string& text, const std::string& key, MachineCode& code);

}  // namespace dspic::translate
