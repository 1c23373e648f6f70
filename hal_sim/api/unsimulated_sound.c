/* SPDX-License-Identifier: MIT
 * Codec and loudspeaker.
 */
#include "codec/e_sound.h"
#include "unsimulated.h"
#define DEVICE "sound codec"

/* variables of the driver that programs read and set */
__attribute__((weak)) int e_dci_unavailable; /* not 0 while a sound plays */
__attribute__((weak)) int e_stop_flag;       /* set to end it */

UNSIMULATED_VOID(e_init_sound, (void))
UNSIMULATED_VOID(e_play_sound, (int sound_offset, int sound_length))
UNSIMULATED_VOID(e_close_sound, (void))
UNSIMULATED_VOID(e_init_dci_master, (void))
UNSIMULATED_VOID(e_init_codec_slave, (void))
UNSIMULATED_VOID(e_sub_dci_kickoff, (int offset, int length))
