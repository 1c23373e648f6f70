// SPDX-License-Identifier: MIT
// The samples that e_play_sound() plays: the library's five sounds at its offsets and lengths, but
// synthesised by us and so with other voices. Each is a buzz of harmonics through the resonances of a mouth
// that moves from vowel to vowel, with breath or hiss where the word has it. The same bits on every machine.
//
//   haa 0..2111   spaah 2116..3875   ouah 3878..7289   yaouh 7294..11025   wouaaaah 11028..19043
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

namespace board {

/// kSoundBankSamples values, lowest bit 0, 7200 a second. Computed at the first call (some milliseconds).
const std::shared_ptr<const std::vector<std::int16_t>>& sound_bank();

}  // namespace board
