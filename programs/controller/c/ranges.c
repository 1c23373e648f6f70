/* SPDX-License-Identifier: MIT
 * Lidars and range finders: a picture of distances.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/library.h"

#define MOST_SIDE 8192 /* of a picture that is believed */
#define LIDAR_HZ 10    /* how often it turns, as Webots' own lidar */
#define GREY 255.0

/* numbers of DEVICE */
enum { RANGES_COLUMNS, RANGES_ROWS, RANGES_FOV, RANGES_NEAR, RANGES_FAR, RANGES_VERTICAL };

struct ranges {
  int columns, rows;
  float* image; /* m, rows from the top; infinite before the first sample */
  bool has_points;
  WbLidarPoint* points; /* null: not asked for yet */
};

static struct ranges* state_of(struct device* d) {
  struct ranges* r = d->own;
  double columns, rows;
  size_t i;
  if (r) return r;
  columns = device_info(d, RANGES_COLUMNS, 1);
  rows = device_info(d, RANGES_ROWS, 1);
  if (!(columns >= 1 && columns <= MOST_SIDE && rows >= 1 && rows <= MOST_SIDE)) columns = rows = 1;
  d->own = r = grow(0, sizeof *r);
  memset(r, 0, sizeof *r);
  r->columns = (int)columns;
  r->rows = (int)rows;
  r->image = grow(0, sizeof *r->image * (size_t)r->columns * (size_t)r->rows);
  for (i = 0; i < (size_t)r->columns * (size_t)r->rows; i++) r->image[i] = INFINITY;
  return r;
}

/* in the lidar's own axes: x ahead, y left, z up, or x right, y up, -z ahead in worlds before R2022 */
static void make_points(const struct device* d, struct ranges* r) {
  double fov = device_info(d, RANGES_FOV, 0), vertical = device_info(d, RANGES_VERTICAL, 0);
  int i, count = r->columns * r->rows;
  if (!r->points) r->points = grow(0, sizeof *r->points * (size_t)count);
  for (i = 0; i < count; i++) {
    WbLidarPoint* p = &r->points[i];
    double left = fov * (0.5 - (i % r->columns + 0.5) / r->columns);
    double up = r->rows > 1 ? vertical * (0.5 - (i / r->columns) / (r->rows - 1.0)) : 0, m = r->image[i];
    double ahead_m = m * cos(up) * cos(left), left_m = m * cos(up) * sin(left),
           up_m = up == 0 ? 0 : m * sin(up);
    /* what is not there is far away on all axes */
    if (isinf(m)) ahead_m = left_m = up_m = INFINITY;
    p->x = (float)(session.nue ? -left_m : ahead_m);
    p->y = (float)(session.nue ? up_m : left_m);
    p->z = (float)(session.nue ? -ahead_m : up_m);
    p->layer_id = i / r->columns;
    p->time = 0;
  }
}

bool take_ranges(struct device* d, const double* values, size_t count) {
  struct ranges* r;
  size_t i;
  if (d->kind != WB_NODE_LIDAR && d->kind != WB_NODE_RANGE_FINDER) return false;
  r = state_of(d);
  if (count > (size_t)r->columns * (size_t)r->rows) count = (size_t)r->columns * (size_t)r->rows;
  for (i = 0; i < count; i++) r->image[i] = (float)values[i];
  if (r->has_points) make_points(d, r);
  d->fresh = true;
  return true;
}

#define RANGES(kind, KIND)                                                                              \
  SENSOR(kind, KIND)                                                                                    \
  static struct ranges* kind##_ranges(WbDeviceTag tag, const char* function) {                          \
    struct device* d = kind(tag, function);                                                             \
    return d ? state_of(d) : 0;                                                                         \
  }                                                                                                     \
  const float* wb_##kind##_get_range_image(WbDeviceTag tag) {                                           \
    struct device* d = kind(tag, "wb_" #kind "_get_range_image");                                       \
    if (!d) return 0;                                                                                   \
    if (d->period == 0) {                                                                               \
      WARN("wb_" #kind                                                                                  \
           "_get_range_image(): got \"%s\", which is not enabled, expected one with a sampling period", \
           d->name);                                                                                    \
      return 0;                                                                                         \
    }                                                                                                   \
    return state_of(d)->image;                                                                          \
  }                                                                                                     \
  double wb_##kind##_get_fov(WbDeviceTag tag) {                                                         \
    return device_info(kind(tag, "wb_" #kind "_get_fov"), RANGES_FOV, 0);                               \
  }                                                                                                     \
  double wb_##kind##_get_min_range(WbDeviceTag tag) {                                                   \
    return device_info(kind(tag, "wb_" #kind "_get_min_range"), RANGES_NEAR, 0);                        \
  }                                                                                                     \
  double wb_##kind##_get_max_range(WbDeviceTag tag) {                                                   \
    return device_info(kind(tag, "wb_" #kind "_get_max_range"), RANGES_FAR, 0);                         \
  }

/* --- range finders */

RANGES(range_finder, WB_NODE_RANGE_FINDER)

int wb_range_finder_get_width(WbDeviceTag tag) {
  const struct ranges* r = range_finder_ranges(tag, "wb_range_finder_get_width");
  return r ? r->columns : 0;
}
int wb_range_finder_get_height(WbDeviceTag tag) {
  const struct ranges* r = range_finder_ranges(tag, "wb_range_finder_get_height");
  return r ? r->rows : 0;
}
/* grey: black is near, white the farthest */
int wb_range_finder_save_image(WbDeviceTag tag, const char* filename, int quality) {
  struct device* d = range_finder(tag, "wb_range_finder_save_image");
  const struct ranges* r;
  struct image grey;
  size_t i, count;
  bool good;
  if (!d) return -1;
  r = state_of(d);
  count = (size_t)r->columns * (size_t)r->rows;
  grey.width = r->columns;
  grey.height = r->rows;
  grey.bgra = grow(0, 4 * count);
  for (i = 0; i < count; i++) {
    double part = r->image[i] / device_info(d, RANGES_FAR, 1);
    memset(grey.bgra + 4 * i, (int)(GREY * (part < 1 ? part : 1)), 4);
    grey.bgra[4 * i + 3] = 255;
  }
  good = image_write(&grey, filename, quality, false, "wb_range_finder_save_image");
  free(grey.bgra);
  return good ? 0 : -1;
}

/* --- lidars */

RANGES(lidar, WB_NODE_LIDAR)

const float* wb_lidar_get_layer_range_image(WbDeviceTag tag, int layer) {
  const struct ranges* r = lidar_ranges(tag, "wb_lidar_get_layer_range_image");
  const float* image = r ? wb_lidar_get_range_image(tag) : 0;
  return image && layer >= 0 && layer < r->rows ? image + (size_t)layer * (size_t)r->columns : 0;
}
void wb_lidar_enable_point_cloud(WbDeviceTag tag) {
  struct device* d = lidar(tag, "wb_lidar_enable_point_cloud");
  if (!d) return;
  state_of(d)->has_points = true;
  make_points(d, state_of(d));
}
void wb_lidar_disable_point_cloud(WbDeviceTag tag) {
  struct ranges* r = lidar_ranges(tag, "wb_lidar_disable_point_cloud");
  if (r) r->has_points = false;
}
bool wb_lidar_is_point_cloud_enabled(WbDeviceTag tag) {
  const struct ranges* r = lidar_ranges(tag, "wb_lidar_is_point_cloud_enabled");
  return r && r->has_points;
}
const WbLidarPoint* wb_lidar_get_point_cloud(WbDeviceTag tag) {
  const struct ranges* r = lidar_ranges(tag, "wb_lidar_get_point_cloud");
  if (!r) return 0;
  if (!r->has_points) {
    WARN(
        "wb_lidar_get_point_cloud(): got a lidar without points, expected wb_lidar_enable_point_cloud() "
        "before");
    return 0;
  }
  return r->points;
}
const WbLidarPoint* wb_lidar_get_layer_point_cloud(WbDeviceTag tag, int layer) {
  const struct ranges* r = lidar_ranges(tag, "wb_lidar_get_layer_point_cloud");
  const WbLidarPoint* points = r ? wb_lidar_get_point_cloud(tag) : 0;
  return points && layer >= 0 && layer < r->rows ? points + (size_t)layer * (size_t)r->columns : 0;
}
int wb_lidar_get_number_of_points(WbDeviceTag tag) {
  const struct ranges* r = lidar_ranges(tag, "wb_lidar_get_number_of_points");
  return r ? r->columns * r->rows : 0;
}
int wb_lidar_get_horizontal_resolution(WbDeviceTag tag) {
  const struct ranges* r = lidar_ranges(tag, "wb_lidar_get_horizontal_resolution");
  return r ? r->columns : 0;
}
int wb_lidar_get_number_of_layers(WbDeviceTag tag) {
  const struct ranges* r = lidar_ranges(tag, "wb_lidar_get_number_of_layers");
  return r ? r->rows : 0;
}
double wb_lidar_get_vertical_fov(WbDeviceTag tag) {
  return device_info(lidar(tag, "wb_lidar_get_vertical_fov"), RANGES_VERTICAL, 0);
}

/* it sees all its points at once, however often it is said to turn */
double wb_lidar_get_frequency(WbDeviceTag tag) { return lidar(tag, "wb_lidar_get_frequency") ? LIDAR_HZ : 0; }
double wb_lidar_get_min_frequency(WbDeviceTag tag) {
  return lidar(tag, "wb_lidar_get_min_frequency") ? LIDAR_HZ : 0;
}
double wb_lidar_get_max_frequency(WbDeviceTag tag) {
  return lidar(tag, "wb_lidar_get_max_frequency") ? LIDAR_HZ : 0;
}
void wb_lidar_set_frequency(WbDeviceTag tag, double frequency) {
  (void)frequency, (void)lidar(tag, "wb_lidar_set_frequency");
}
