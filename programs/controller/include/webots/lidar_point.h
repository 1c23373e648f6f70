/* SPDX-License-Identifier: MIT
 * A point that a lidar sees, for C and C++.
 */
#ifndef WB_LIDAR_POINT_H
#define WB_LIDAR_POINT_H

typedef struct {
  float x, y, z; /* m, in the lidar's axes */
  int layer_id;
  float time; /* s */
} WbLidarPoint;

#endif
