/* SPDX-License-Identifier: MIT
 * The camera's reset pin, and the word of the data EEPROM that tells how the camera is mounted.
 * Source: [lib: camera/fast_2_timer/e_common.c], facts restated.
 */
#include "hal.h"

#define RESET_ROUNDS 50
#define EEPROM_PAGE 0x7F

void hal_camera_reset(void) {
  CAM_RESET = 0;
  hal_pause(RESET_ROUNDS);
  CAM_RESET = 1;
  hal_pause(RESET_ROUNDS);
}

int hal_eeprom_word(unsigned int offset) {
  unsigned int saved = TBLPAG;
  int word;
  TBLPAG = EEPROM_PAGE;
  word = (int)__builtin_tblrdl(offset);
  TBLPAG = saved;
  return word;
}
