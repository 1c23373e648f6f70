/* SPDX-License-Identifier: MIT
 * The samples that e_play_sound() plays, 7200 a second: five words synthesised by us, at the library's offsets. On the
 * chip they lie in program memory, 16 bits in each instruction word, and are read by table instructions, since they are
 * more than the 32 KB that the chip's window to program memory shows at a time.
 */
#ifndef HAL_DSPIC_SOUND_BANK_H
#define HAL_DSPIC_SOUND_BANK_H

#define HAL_BANK_SAMPLES 19044u

/** Sample `index`; 0 beyond the bank's end. */
int hal_bank_sample(unsigned int index);

#endif
