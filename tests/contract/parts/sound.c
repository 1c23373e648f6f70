/* SPDX-License-Identifier: MIT
 * Sound: 2160 samples at 7200 a second last 0.3 s. */
#include "say.h"
#include <codec/e_sound.h>

extern volatile int e_dci_unavailable; /* of the driver, in none of its headers */

int main(void) {
  begin();
  e_init_sound();
  e_play_sound(0, 2160);
  pause_ms(250);
  say("plays", e_dci_unavailable != 0);
  pause_ms(100);
  say("still", e_dci_unavailable != 0);
  e_close_sound();
  end();
}
