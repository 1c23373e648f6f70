/* SPDX-License-Identifier: MIT
 * libcontroller inside: one connection to the simulator, the robot's devices, and what every file needs of
 * both.
 *
 *   a getter reads what the last step brought; a setter writes a record into `session.out`; wb_robot_step()
 * sends the packet and takes the samples until DONE; a question (ask()) is sent at once and waits for its
 * answer.
 *
 * Assumptions: one thread calls (as in Webots); the simulator is another process, whose records the codec has
 * checked for their form but not for their numbers. Nothing is allocated in a step but by what grows.
 */
#ifndef PROGRAMS_CONTROLLER_C_LIBRARY_H
#define PROGRAMS_CONTROLLER_C_LIBRARY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "programs/controller/c/public.h"
#include "programs/link/packet.h"

/* --- the connection: session.c */

enum session_state {
  SESSION_NONE,   /* not begun */
  SESSION_RUNS,   /* steps are answered */
  SESSION_OVER,   /* the run has ended: questions are answered, steps not */
  SESSION_CLOSED, /* nobody is there any more */
};

struct session {
  enum session_state state;
  bool supervisor; /* may ask of the world */
  bool nue;        /* axes of worlds before R2022 */
  bool stepping;   /* between wb_robot_step_begin() and its end */
  bool told_end;   /* a step has returned -1 */
  int64_t seed;
  int64_t time_ns;   /* since the program began */
  int64_t passed_ms; /* by the last step */
  double basic_step_ms;
  double speed_unit_rad_s; /* of differential wheels */
  char *robot, *model, *project, *world, *title, *custom;
  unsigned stamp;    /* changes when the world may have changed: at a step, and at a command to the world */
  unsigned firmware; /* changes when variables of firmware may have changed, and nothing else has */
  unsigned steps;    /* that have ended */
  struct link_packet out;
};
extern struct session session;

/** Begins the session if it has not begun. A program that cannot reach the simulator ends here, with
 * status 1. */
void session_begin(void);
static inline void session_ready(void) {
  if (session.state == SESSION_NONE) session_begin();
}

/** A record for the next packet; members follow, then command_end(). */
struct link_packet* command(int record);
void command_end(void);

/** Sends what has been said, with the question as its last record, and waits for the answer. Its number; 0:
 * there is none, because the run is closed. The members are valid until the next question or step. */
int ask(struct link_record* answer);

/** Sends what has been said so far. */
void session_flush(void);

/** 0 for HELLO: C; others call twinpuck_language(). */
extern int session_language;

/* --- warnings: "Warning: ..." on stderr, 20 times from one place */

void warn(int* told, const char* format, ...) __attribute__((format(printf, 2, 3)));
#define WARN(...)              \
  do {                         \
    static int told_;          \
    warn(&told_, __VA_ARGS__); \
  } while (0)

/** The program ends, with status 1. */
void fatal(const char* format, ...) __attribute__((format(printf, 1, 2), noreturn));

/** A copy, as strdup(); null becomes an empty text. */
char* copy_text(const char* bytes, size_t size);
/** More memory, or the end of the process. */
void* grow(void* old, size_t bytes);
/** The absolute path of a file of the program's folder; valid until the next call. */
const char* absolute_path(const char* file);

/* --- devices: devices.c */

#define DEVICE_VALUES 8

struct device {
  WbDeviceTag tag;
  bool fresh; /* a sample has come */
  WbNodeType kind;
  int period;     /* ms; 0: disabled */
  int count;      /* of values that came */
  int info_count; /* of numbers of DEVICE */
  double values[DEVICE_VALUES];
  float floats[DEVICE_VALUES]; /* the same, in the interface of 2005 */
  double* info;
  char *name, *model;
  void* own; /* what its kind keeps */
};

extern struct device** device_by_tag; /* null where there is none */
extern int device_tags;               /* how long it is */

/** Null, after a warning, unless the tag is of that kind. */
struct device* wrong_tag(WbDeviceTag tag, WbNodeType kind, const char* function);
static inline struct device* device_of(WbDeviceTag tag, WbNodeType kind, const char* function) {
  if (tag < device_tags && device_by_tag[tag] && device_by_tag[tag]->kind == kind) return device_by_tag[tag];
  return wrong_tag(tag, kind, function);
}
/** Any device of that tag; null: there is none. */
static inline struct device* any_device(int64_t tag) {
  return tag > 0 && tag < device_tags ? device_by_tag[tag] : 0;
}
/** A hidden one (battery, keyboard), or the first of a kind where name is null; null: there is none. */
struct device* hidden_device(const char* name);
struct device* first_device(WbNodeType kind, const char* name);
/** A member of DEVICE's numbers, `otherwise` where it was not told. */
static inline double device_info(const struct device* device, int index, double otherwise) {
  return device && index < device->info_count ? device->info[index] : otherwise;
}

/** The tag of a name; asks the simulator for one that was not told; 0 and a warning: there is none. */
WbDeviceTag find_device(const char* name, const char* function);

/** ENABLE; 0 or less: no more. */
void device_enable(struct device* device, int period);
/* enable, disable and period of a kind, whose device `found` gives by its tag */
#define SAMPLING(name, found)                                                                         \
  void wb_##name##_enable(WbDeviceTag tag, int sampling_period) {                                     \
    device_enable(found(tag, "wb_" #name "_enable"), sampling_period);                                \
  }                                                                                                   \
  void wb_##name##_disable(WbDeviceTag tag) { device_enable(found(tag, "wb_" #name "_disable"), 0); } \
  int wb_##name##_get_sampling_period(WbDeviceTag tag) {                                              \
    const struct device* d = found(tag, "wb_" #name "_get_sampling_period");                          \
    return d ? d->period : 0;                                                                         \
  }
#define SENSOR(name, KIND)                                            \
  static struct device* name(WbDeviceTag tag, const char* function) { \
    return device_of(tag, KIND, function);                            \
  }                                                                   \
  SAMPLING(name, name)
/** One number of a sensor, NaN before the first; a warning where it is not enabled. */
double device_value(const struct device* device, const char* function);
/** Several numbers, NaN before the first and for no device. */
const double* device_values(const struct device* device, const char* function);
/** Where there is nothing to point to: 16 NaN, so that a program that was warned goes on. */
const double* no_numbers(void);
/** As the interface of 2005 has them: zeros before the first. */
const float* device_floats(struct device* device);

/** DEVICE's record becomes a device. */
struct device* device_add(const struct link_record* record);
/** What a step brings for a device; the record may be any. */
void take_sample(const struct link_record* record);

/* what each kind does with its records */
void take_picture(const struct link_record* record);
/** Of a lidar or range finder; false: it is none. */
bool take_ranges(struct device* device, const double* values, size_t count);
void take_recognition(const struct link_record* record);
void take_sound(const struct link_record* record);
void take_packet(const struct link_record* record);
void take_keys(const struct link_record* record);
void take_playing(const struct link_record* record);
void take_followed(const struct link_record* record);
/* at the end of a step, once its samples have come */
void emitters_step(void);
void speakers_step(void);
void old_supervisor_step(void);
void keyboard_step(void);
/* before a step is asked for */
void followed_step(void);

/** A key that is down, each once a step, then `none`. */
long next_key(long none);

/* --- images: picture.c */

/** Rows from the top, 4 bytes a pixel: blue, green, red, alpha. */
struct image {
  int width, height;
  unsigned char* bgra;
};
/** Writes a PNG, or a JPEG where the name says so (quality 1 to 100). False, and a warning: it could not be
 * written. */
bool image_write(const struct image* image, const char* file, int quality, bool with_alpha,
                 const char* function);
/** Reads a PNG or JPEG; false, and a warning: it could not be read. */
bool image_read(struct image* image, const char* file, const char* function);

/* --- signals: crash.c */

void crash_install(int socket);

#endif
