/* SPDX-License-Identifier: MIT
 * Cameras: their picture, and the objects that they recognise on it.
 */
#include <math.h>
#include <string.h>

#include "programs/controller/c/library.h"

#define MOST_SIDE 8192 /* pixels, of a picture that is believed */

/* numbers of DEVICE */
enum { CAMERA_COLUMNS, CAMERA_ROWS, CAMERA_FOV, CAMERA_NEAR, CAMERA_RECOGNISES };

struct camera {
  struct image picture; /* the newest */
  int recognition_period;
  WbCameraRecognitionObject* objects;
  int object_count, object_room;
};

static struct camera* state_of(struct device* d) {
  struct camera* c = d->own;
  int width, height;
  size_t bytes;
  if (c) return c;
  width = (int)device_info(d, CAMERA_COLUMNS, 52);
  height = (int)device_info(d, CAMERA_ROWS, 39);
  if (width < 1 || width > MOST_SIDE || height < 1 || height > MOST_SIDE) width = height = 1;
  bytes = 4 * (size_t)width * (size_t)height;
  d->own = c = grow(0, sizeof *c);
  memset(c, 0, sizeof *c);
  c->picture.width = width;
  c->picture.height = height;
  c->picture.bgra = grow(0, bytes);
  memset(c->picture.bgra, 0, bytes);
  return c;
}

static struct device* device(WbDeviceTag tag, const char* function) { return device_of(tag, WB_NODE_CAMERA, function); }
static struct camera* camera(WbDeviceTag tag, const char* function) {
  struct device* d = device(tag, function);
  return d ? state_of(d) : 0;
}

/* --- the picture */

void take_picture(const struct link_record* record) {
  struct device* d = any_device(record->ints[0]);
  const struct image* to;
  int64_t columns = record->ints[1], first = record->ints[3];
  size_t row, size = record->texts[0].size;
  if (!d || d->kind != WB_NODE_CAMERA) return;
  to = &state_of(d)->picture;
  row = 4 * (size_t)to->width;
  if (columns != to->width || record->ints[2] != to->height || first < 0 || first > to->height || size % row ||
      size / row > (size_t)(to->height - first)) {
    WARN("the simulator: got a picture of %d x %d pixels for \"%s\", expected %d x %d", (int)columns, (int)record->ints[2],
         d->name, to->width, to->height);
    return;
  }
  memcpy(to->bgra + (size_t)first * row, record->texts[0].bytes, size);
  d->fresh = true;
}

SAMPLING(camera, device)

const unsigned char* wb_camera_get_image(WbDeviceTag tag) {
  struct device* d = device(tag, "wb_camera_get_image");
  if (!d) return 0;
  if (d->period == 0) {
    WARN("wb_camera_get_image(): got \"%s\", which is not enabled, expected one with a sampling period", d->name);
    return 0;
  }
  return state_of(d)->picture.bgra;
}

int wb_camera_get_width(WbDeviceTag tag) {
  const struct camera* c = camera(tag, "wb_camera_get_width");
  return c ? c->picture.width : -1;
}
int wb_camera_get_height(WbDeviceTag tag) {
  const struct camera* c = camera(tag, "wb_camera_get_height");
  return c ? c->picture.height : -1;
}
double wb_camera_get_near(WbDeviceTag tag) { return device_info(device(tag, "wb_camera_get_near"), CAMERA_NEAR, NAN); }

/* the robot's lens is fixed */
double wb_camera_get_fov(WbDeviceTag tag) { return device_info(device(tag, "wb_camera_get_fov"), CAMERA_FOV, NAN); }
double wb_camera_get_min_fov(WbDeviceTag tag) { return wb_camera_get_fov(tag); }
double wb_camera_get_max_fov(WbDeviceTag tag) { return wb_camera_get_fov(tag); }
static void fixed(WbDeviceTag tag, const char* function) {
  const struct device* d = device(tag, function);
  if (d) WARN("%s(): the lens of \"%s\" is fixed, and its exposure its own", function, d->name);
}
void wb_camera_set_fov(WbDeviceTag tag, double fov) { (void)fov, fixed(tag, "wb_camera_set_fov"); }
void wb_camera_set_exposure(WbDeviceTag tag, double exposure) { (void)exposure, fixed(tag, "wb_camera_set_exposure"); }
void wb_camera_set_focal_distance(WbDeviceTag tag, double focal_distance) {
  (void)focal_distance, fixed(tag, "wb_camera_set_focal_distance");
}
double wb_camera_get_exposure(WbDeviceTag tag) { return device(tag, "wb_camera_get_exposure") ? 1 : NAN; }
double wb_camera_get_focal_length(WbDeviceTag tag) { return device(tag, "wb_camera_get_focal_length") ? 0 : NAN; }
double wb_camera_get_focal_distance(WbDeviceTag tag) { return device(tag, "wb_camera_get_focal_distance") ? 0 : NAN; }
double wb_camera_get_min_focal_distance(WbDeviceTag tag) { return device(tag, "wb_camera_get_min_focal_distance") ? 0 : NAN; }
double wb_camera_get_max_focal_distance(WbDeviceTag tag) { return device(tag, "wb_camera_get_max_focal_distance") ? 0 : NAN; }

void wb_camera_move_window(WbDeviceTag tag, int x, int y) { (void)x, (void)y, (void)device(tag, "wb_camera_move_window"); }
int wb_camera_get_type(WbDeviceTag tag) { return (void)device(tag, "wb_camera_get_type"), WB_CAMERA_COLOR; }

int wb_camera_save_image(WbDeviceTag tag, const char* filename, int quality) {
  struct device* d = device(tag, "wb_camera_save_image");
  if (!d) return -1;
  if (d->period == 0) WARN("wb_camera_save_image(): got \"%s\", which is not enabled: a black picture", d->name);
  return image_write(&state_of(d)->picture, filename, quality, false, "wb_camera_save_image") ? 0 : -1;
}

/* --- recognition */

bool wb_camera_has_recognition(WbDeviceTag tag) {
  return device_info(device(tag, "wb_camera_has_recognition"), CAMERA_RECOGNISES, 0) != 0;
}

static struct device* recognising(WbDeviceTag tag, const char* function) {
  struct device* d = device(tag, function);
  if (!d || device_info(d, CAMERA_RECOGNISES, 0) != 0) return d;
  WARN("%s(): \"%s\" does not recognise objects; in the world it needs a Recognition", function, d->name);
  return 0;
}

static void recognise(struct device* d, int period) {
  struct link_packet* out;
  if (!d) return;
  state_of(d)->recognition_period = period > 0 ? period : 0;
  if (period <= 0) state_of(d)->object_count = 0;
  out = command(LINK_RECOGNISE);
  link_int(out, d->tag);
  link_int(out, period > 0 ? period : 0);
  command_end();
}

/* one more, with room that is kept from step to step */
static WbCameraRecognitionObject* add_object(struct camera* c) {
  if (c->object_count == c->object_room) {
    int room = c->object_room + 16;
    c->objects = grow(c->objects, (size_t)room * sizeof *c->objects);
    memset(c->objects + c->object_room, 0, (size_t)(room - c->object_room) * sizeof *c->objects);
    c->object_room = room;
  }
  return &c->objects[c->object_count++];
}

void take_recognition(const struct link_record* record) {
  struct device* d = any_device(record->ints[0]);
  WbCameraRecognitionObject* o;
  const double* v;
  size_t colours;
  int i;
  if (!d || d->kind != WB_NODE_CAMERA) return;
  if (record->number == LINK_RECOGNITION) {
    state_of(d)->object_count = 0;
    return;
  }
  if (record->lists[0].count < 13) return;
  v = record->lists[0].values;
  colours = record->lists[1].count;
  o = add_object(state_of(d));
  o->id = (int)record->ints[1];
  for (i = 0; i < 3; i++) o->position[i] = v[i];
  for (i = 0; i < 4; i++) o->orientation[i] = v[3 + i];
  for (i = 0; i < 2; i++) {
    o->size[i] = v[7 + i];
    o->position_on_image[i] = (int)v[9 + i];
    o->size_on_image[i] = (int)v[11 + i];
  }
  o->number_of_colors = (int)(colours / 3);
  o->colors = grow(o->colors, colours * sizeof(double));
  if (colours) memcpy(o->colors, record->lists[1].values, colours * sizeof(double));
  o->model = grow(o->model, record->texts[0].size + 1);
  memcpy(o->model, record->texts[0].bytes, record->texts[0].size);
  o->model[record->texts[0].size] = 0;
}

void wb_camera_recognition_enable(WbDeviceTag tag, int sampling_period) {
  recognise(recognising(tag, "wb_camera_recognition_enable"), sampling_period);
}
void wb_camera_recognition_disable(WbDeviceTag tag) { recognise(recognising(tag, "wb_camera_recognition_disable"), 0); }
int wb_camera_recognition_get_sampling_period(WbDeviceTag tag) {
  struct device* d = recognising(tag, "wb_camera_recognition_get_sampling_period");
  return d ? state_of(d)->recognition_period : 0;
}
int wb_camera_recognition_get_number_of_objects(WbDeviceTag tag) {
  struct device* d = recognising(tag, "wb_camera_recognition_get_number_of_objects");
  return d ? state_of(d)->object_count : 0;
}
const WbCameraRecognitionObject* wb_camera_recognition_get_objects(WbDeviceTag tag) {
  struct device* d = recognising(tag, "wb_camera_recognition_get_objects");
  return d && state_of(d)->object_count ? state_of(d)->objects : 0;
}
const WbCameraRecognitionObject* wb_camera_recognition_get_object(WbDeviceTag tag, int index) {
  struct device* d = recognising(tag, "wb_camera_recognition_get_object");
  return d && index >= 0 && index < state_of(d)->object_count ? &state_of(d)->objects[index] : 0;
}

/* no picture says whose each pixel is */
bool wb_camera_recognition_has_segmentation(WbDeviceTag tag) {
  return (void)device(tag, "wb_camera_recognition_has_segmentation"), false;
}
void wb_camera_recognition_enable_segmentation(WbDeviceTag tag) {
  if (device(tag, "wb_camera_recognition_enable_segmentation"))
    WARN("wb_camera_recognition_enable_segmentation(): there is no segmentation; use the objects");
}
void wb_camera_recognition_disable_segmentation(WbDeviceTag tag) {
  (void)device(tag, "wb_camera_recognition_disable_segmentation");
}
bool wb_camera_recognition_is_segmentation_enabled(WbDeviceTag tag) {
  return (void)device(tag, "wb_camera_recognition_is_segmentation_enabled"), false;
}
const unsigned char* wb_camera_recognition_get_segmentation_image(WbDeviceTag tag) {
  return (void)device(tag, "wb_camera_recognition_get_segmentation_image"), (const unsigned char*)0;
}
int wb_camera_recognition_save_segmentation_image(WbDeviceTag tag, const char* filename, int quality) {
  return (void)filename, (void)quality, (void)device(tag, "wb_camera_recognition_save_segmentation_image"), -1;
}
