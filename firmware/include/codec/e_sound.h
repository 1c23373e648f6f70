/* SPDX-License-Identifier: MIT
 * The five sounds stored in the library, played at 7200 samples a second through codec and loudspeaker.
 * The interrupt of the data converter interface (priority 4) feeds four samples at a time.
 *
 *   sound   "haa"  "spaah"  "ouah"  "yaouh"  "wouaaaah"
 *   offset     0     2116     3878     7294      11028
 *   length  2112     1760     3412     3732       8016
 *
 * Two variables of the driver are read by programs that declare them themselves: extern int e_dci_unavailable
 * (not 0 while a sound plays) and extern int e_stop_flag (set to end it).
 */
#ifndef _SOUND
#define _SOUND

/** Switches the codec on and configures it. Blocks for some milliseconds. */
void e_init_sound(void);

/** Plays `sound_length` samples from `sound_offset`. Returns at once; a sound that plays is replaced.
 *  The length must be a multiple of 4, otherwise the end is missed and memory is played. */
void e_play_sound(int sound_offset, int sound_length);

/** Codec off; e_init_sound() before the next sound. */
void e_close_sound(void);

/** Parts of the driver, not for controllers. */
void e_init_dci_master(void);
void e_init_codec_slave(void);
void e_sub_dci_kickoff(int, int);

#endif
