/* SPDX-License-Identifier: MIT
 * Loudspeaker, device "speaker". The e-puck plays no files, but five sounds of its own. Nothing here blocks.
 */
#ifndef WB_SPEAKER_H
#define WB_SPEAKER_H

#include "types.h"

TP_C_BEGIN

/** Plays one of the five sounds stored on the robot; `sound` is its name as in codec/e_sound.h ("haa",
 * "spaah", "ouah", "yaouh", "wouaaaah", with or without a path and ".wav"); other names are refused with a
 * warning. volume, pitch, balance are ignored; loop is not 0: again and again. left and right are the same
 * loudspeaker. */
void wb_speaker_play_sound(WbDeviceTag left, WbDeviceTag right, const char* sound, double volume,
                           double pitch, double balance, bool loop);

/** Ends the sound; `sound` is null or its name. */
void wb_speaker_stop(WbDeviceTag tag, const char* sound);

/** Whether it sounds. */
bool wb_speaker_is_sound_playing(WbDeviceTag tag, const char* sound);

/* --- programs of the PC: text is not spoken, which a warning says; engine and language are kept */
bool wb_speaker_set_engine(WbDeviceTag tag, const char* engine);
bool wb_speaker_set_language(WbDeviceTag tag, const char* language);
const char* wb_speaker_get_engine(WbDeviceTag tag);
const char* wb_speaker_get_language(WbDeviceTag tag);
void wb_speaker_speak(WbDeviceTag tag, const char* text, double volume);
bool wb_speaker_is_speaking(WbDeviceTag tag);

TP_C_END

#endif
