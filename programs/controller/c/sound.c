/* SPDX-License-Identifier: MIT
 * Microphones and loudspeakers.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "programs/controller/c/library.h"

/* --- microphone ------------------------------------------------------------------------------------------- */

struct recording {
  size_t size;
  void* bytes;
};

static struct device* microphone(WbDeviceTag tag, const char* function) {
  return device_of(tag, WB_NODE_MICROPHONE, function);
}

void take_sound(const struct link_record* record) {
  struct device* d = any_device(record->ints[0]);
  struct recording* r;
  if (!d || d->kind != WB_NODE_MICROPHONE) return;
  if (!d->own) d->own = memset(grow(0, sizeof *r), 0, sizeof *r);
  r = d->own;
  if (record->texts[0].size > r->size || !r->bytes) r->bytes = grow(r->bytes, record->texts[0].size);
  r->size = record->texts[0].size;
  memcpy(r->bytes, record->texts[0].bytes, r->size);
}

void wb_microphone_enable(WbDeviceTag tag, int sampling_period) {
  device_enable(microphone(tag, "wb_microphone_enable"), sampling_period);
}
void wb_microphone_disable(WbDeviceTag tag) { device_enable(microphone(tag, "wb_microphone_disable"), 0); }
int wb_microphone_get_sampling_period(WbDeviceTag tag) {
  const struct device* d = microphone(tag, "wb_microphone_get_sampling_period");
  return d ? d->period : 0;
}
const void* wb_microphone_get_sample_data(WbDeviceTag tag) {
  const struct device* d = microphone(tag, "wb_microphone_get_sample_data");
  return d && d->own ? ((const struct recording*)d->own)->bytes : 0;
}
int wb_microphone_get_sample_size(WbDeviceTag tag) {
  const struct device* d = microphone(tag, "wb_microphone_get_sample_size");
  return d && d->own ? (int)((const struct recording*)d->own)->size : 0;
}

/* --- speaker ---------------------------------------------------------------------------------------------- */

struct speaker {
  char* playing; /* a line a sound */
  char language[16], engine[16];
};

static struct device* speaker_device(WbDeviceTag tag, const char* function) {
  return device_of(tag, WB_NODE_SPEAKER, function);
}
static struct speaker* speaker_of(struct device* d) {
  struct speaker* s = d->own;
  if (s) return s;
  d->own = s = grow(0, sizeof *s);
  s->playing = copy_text("", 0);
  strcpy(s->language, "en-US");
  strcpy(s->engine, "pico");
  return s;
}
static struct speaker* speaker(WbDeviceTag tag, const char* function) {
  struct device* d = speaker_device(tag, function);
  return d ? speaker_of(d) : 0;
}

void take_playing(const struct link_record* record) {
  struct device* d = any_device(record->ints[0]);
  struct speaker* s;
  if (!d || d->kind != WB_NODE_SPEAKER) return;
  s = speaker_of(d);
  free(s->playing);
  s->playing = copy_text(record->texts[0].bytes, record->texts[0].size);
}

/* a file of the program's folder by its whole path, anything else as it was named */
static const char* name_of(const char* sound) { return access(sound, R_OK) == 0 ? absolute_path(sound) : sound; }

static const char* line_of(const char* lines, const char* sound) {
  size_t n = strlen(sound);
  const char* at;
  for (at = lines; *at; at += strcspn(at, "\n"), at += *at == '\n')
    if (strcspn(at, "\n") == n && strncmp(at, sound, n) == 0) return at;
  return 0;
}

static void play(struct device* d, const char* sound, double volume, double pitch, double balance, bool loop) {
  struct speaker* s = speaker_of(d);
  struct link_packet* out = command(LINK_PLAY);
  link_int(out, d->tag);
  link_text(out, sound);
  link_number(out, volume);
  link_number(out, pitch);
  link_number(out, balance);
  link_int(out, loop);
  command_end();
  /* it plays from now on, as far as the program can see */
  if (!line_of(s->playing, sound)) {
    size_t n = strlen(s->playing), m = strlen(sound);
    s->playing = grow(s->playing, n + m + 2);
    memcpy(s->playing + n, sound, m);
    strcpy(s->playing + n + m, "\n");
  }
}

void wb_speaker_play_sound(WbDeviceTag left, WbDeviceTag right, const char* sound, double volume, double pitch,
                           double balance, bool loop) {
  struct device* d = speaker_device(left ? left : right, "wb_speaker_play_sound");
  if (!d) return;
  if (!sound || !*sound) {
    WARN("wb_speaker_play_sound(): got no sound, expected a file or a name");
    return;
  }
  sound = name_of(sound);
  play(d, sound, volume, pitch, balance, loop);
  if (left && right && left != right) {
    d = speaker_device(right, "wb_speaker_play_sound");
    if (d) play(d, sound, volume, pitch, balance, loop);
  }
}

void wb_speaker_stop(WbDeviceTag tag, const char* sound) {
  struct speaker* s = speaker(tag, "wb_speaker_stop");
  struct link_packet* out;
  if (!s) return;
  sound = sound && *sound ? name_of(sound) : "";
  out = command(LINK_SILENCE);
  link_int(out, tag);
  link_text(out, sound);
  command_end();
  if (!*sound) {
    s->playing[0] = 0;
  } else {
    char* at = (char*)line_of(s->playing, sound);
    if (at) memmove(at, at + strlen(sound) + 1, strlen(at + strlen(sound) + 1) + 1);
  }
}

bool wb_speaker_is_sound_playing(WbDeviceTag tag, const char* sound) {
  const struct speaker* s = speaker(tag, "wb_speaker_is_sound_playing");
  if (!s) return false;
  return sound && *sound ? line_of(s->playing, name_of(sound)) != 0 : s->playing[0] != 0;
}

/* the robot cannot speak */
bool wb_speaker_set_engine(WbDeviceTag tag, const char* engine) {
  struct speaker* s = speaker(tag, "wb_speaker_set_engine");
  if (!s || !engine) return false;
  snprintf(s->engine, sizeof s->engine, "%s", engine);
  return true;
}
bool wb_speaker_set_language(WbDeviceTag tag, const char* language) {
  struct speaker* s = speaker(tag, "wb_speaker_set_language");
  if (!s || !language) return false;
  snprintf(s->language, sizeof s->language, "%s", language);
  return true;
}
const char* wb_speaker_get_engine(WbDeviceTag tag) {
  const struct speaker* s = speaker(tag, "wb_speaker_get_engine");
  return s ? s->engine : "";
}
const char* wb_speaker_get_language(WbDeviceTag tag) {
  const struct speaker* s = speaker(tag, "wb_speaker_get_language");
  return s ? s->language : "";
}
void wb_speaker_speak(WbDeviceTag tag, const char* text, double volume) {
  (void)text, (void)volume;
  if (speaker(tag, "wb_speaker_speak")) WARN("wb_speaker_speak(): text is not spoken; play a sound");
}
bool wb_speaker_is_speaking(WbDeviceTag tag) { return (void)speaker(tag, "wb_speaker_is_speaking"), false; }
