/* SPDX-License-Identifier: MIT
 * Where a node touches another one, for C and C++. Programs of the PC only.
 */
#ifndef WB_CONTACT_POINT_H
#define WB_CONTACT_POINT_H

typedef struct {
  double point[3]; /* m, in the world's axes */
  int node_id;
} WbContactPoint;

#endif
