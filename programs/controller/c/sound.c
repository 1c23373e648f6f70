/* SPDX-License-Identifier: MIT
 * Microphones and loudspeakers.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "programs/controller/c/library.h"

/* --- microphone */

struct recording {
  size_t size;
  void* bytes;
};

SENSOR(microphone, WB_NODE_MICROPHONE)

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

const void* wb_microphone_get_sample_data(WbDeviceTag tag) {
  const struct device* d = microphone(tag, "wb_microphone_get_sample_data");
  return d && d->own ? ((const struct recording*)d->own)->bytes : 0;
}
int wb_microphone_get_sample_size(WbDeviceTag tag) {
  const struct device* d = microphone(tag, "wb_microphone_get_sample_size");
  return d && d->own ? (int)((const struct recording*)d->own)->size : 0;
}

/* --- speaker */

#define NAME_BYTES 128 /* of a sound */

struct speaker {
  char* playing;           /* a line a sound, as the simulator says */
  char begun[NAME_BYTES];  /* by this program since the last step: it plays, as far as can be seen */
  char language[16], engine[16];
  struct speaker* next;
};
static struct speaker* speakers;

static struct device* speaker_device(WbDeviceTag tag, const char* function) {
  return device_of(tag, WB_NODE_SPEAKER, function);
}
static struct speaker* speaker_of(struct device* d) {
  struct speaker* s = d->own;
  if (s) return s;
  d->own = s = memset(grow(0, sizeof *s), 0, sizeof *s);
  s->playing = copy_text("", 0);
  strcpy(s->language, "en-US");
  strcpy(s->engine, "pico");
  s->next = speakers;
  return speakers = s;
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

/* from here on it is the simulator's word that counts: it may have refused the sound */
void speakers_step(void) {
  struct speaker* s;
  for (s = speakers; s; s = s->next) s->begun[0] = 0;
}

/* a file of the program's folder by its whole path, anything else as it was named */
static const char* name_of(const char* sound) { return access(sound, R_OK) == 0 ? absolute_path(sound) : sound; }

/* "sounds/haa.wav" is "haa": the simulator may say either */
static size_t stem_of(const char* text, size_t size, const char** stem) {
  const char* at = text + size;
  while (at > text && at[-1] != '/') at--;
  *stem = at;
  for (size = (size_t)(text + size - at); memchr(at, '.', size); size--) continue;
  return size;
}

static bool is_same(const char* line, size_t size, const char* sound) {
  const char *a, *b;
  size_t n = stem_of(line, size, &a);
  return stem_of(sound, strlen(sound), &b) == n && memcmp(a, b, n) == 0;
}

static bool is_among(const char* lines, const char* sound) {
  for (; *lines; lines += *lines == '\n') {
    size_t size = strcspn(lines, "\n");
    if (is_same(lines, size, sound)) return true;
    lines += size;
  }
  return false;
}

static void play(struct device* d, const char* sound, double volume, double pitch, double balance, bool loop) {
  struct link_packet* out = command(LINK_PLAY);
  link_int(out, d->tag);
  link_text(out, name_of(sound));
  link_number(out, volume);
  link_number(out, pitch);
  link_number(out, balance);
  link_int(out, loop);
  command_end();
  snprintf(speaker_of(d)->begun, NAME_BYTES, "%s", sound);
}

void wb_speaker_play_sound(WbDeviceTag left, WbDeviceTag right, const char* sound, double volume, double pitch,
                           double balance, bool loop) {
  struct device* d = speaker_device(left ? left : right, "wb_speaker_play_sound");
  if (!d) return;
  if (!sound || !*sound) {
    WARN("wb_speaker_play_sound(): got no sound, expected a file or a name");
    return;
  }
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
  out = command(LINK_SILENCE);
  link_int(out, tag);
  link_text(out, sound && *sound ? name_of(sound) : "");
  command_end();
  if (!sound || !*sound) s->playing[0] = 0;
  if (!sound || !*sound || is_among(s->begun, sound)) s->begun[0] = 0;
}

bool wb_speaker_is_sound_playing(WbDeviceTag tag, const char* sound) {
  const struct speaker* s = speaker(tag, "wb_speaker_is_sound_playing");
  if (!s) return false;
  if (!sound || !*sound) return s->playing[0] || s->begun[0];
  return is_among(s->playing, sound) || is_among(s->begun, sound);
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
