/* SPDX-License-Identifier: MIT
 * Loudspeaker: the five sounds that the library stores.
 */
#include <string.h>

#include "codec/e_sound.h"
#include "core.h"
#include "webots/speaker.h"

#define SOUNDS 5

/* the driver's own: not 0 while a sound plays; set to end it */
extern int e_dci_unavailable;
extern int e_stop_flag;

struct sound {
  const char* name;
  int offset, length; /* samples [lib: codec/e_sound.h] */
};

static const struct sound kSounds[SOUNDS] = {{"haa", 0, 2112},
                                             {"spaah", 2116, 1760},
                                             {"ouah", 3878, 3412},
                                             {"yaouh", 7294, 3732},
                                             {"wouaaaah", 11028, 8016}};
static const struct sound* repeated; /* is begun again whenever it has ended */
static struct webots_device* speaker;

/* "sounds/haa.wav" is "haa" */
static const struct sound* find(const char* file) {
  const char* base = strrchr(file, '/');
  int i;
  base = base ? base + 1 : file;
  for (i = 0; i < SOUNDS; i++) {
    size_t n = strlen(kSounds[i].name);
    if (strncmp(base, kSounds[i].name, n) == 0 && (base[n] == 0 || base[n] == '.')) return &kSounds[i];
  }
  return 0;
}

static void repeat(struct webots_device* device) {
  (void)device;
  if (repeated && !e_dci_unavailable) e_play_sound(repeated->offset, repeated->length);
}

void wb_speaker_play_sound(WbDeviceTag left, WbDeviceTag right, const char* sound, double volume, double pitch,
                           double balance, bool loop) {
  const struct sound* wanted = find(sound);
  (void)right, (void)volume, (void)pitch, (void)balance;
  if (!webots_device_of(left, WB_NODE_SPEAKER, "wb_speaker_play_sound")) return;
  if (!wanted) {
    webots_warn("wb_speaker_play_sound", "got a sound that the robot does not store");
    return;
  }
  if (!speaker) {
    speaker = webots_device_of(left, WB_NODE_SPEAKER, "wb_speaker_play_sound");
    e_init_sound();
  }
  repeated = loop ? wanted : 0;
  webots_enable(speaker, loop ? 1 : 0, repeat);
  e_play_sound(wanted->offset, wanted->length);
}

void wb_speaker_stop(WbDeviceTag tag, const char* sound) {
  (void)tag, (void)sound;
  repeated = 0;
  if (speaker) e_stop_flag = 1;
}

bool wb_speaker_is_sound_playing(WbDeviceTag tag, const char* sound) {
  return (void)tag, (void)sound, e_dci_unavailable != 0;
}
