/* SPDX-License-Identifier: MIT
 * An object that a camera has recognised, for C and C++. Programs of the PC only.
 */
#ifndef WB_CAMERA_RECOGNITION_OBJECT_H
#define WB_CAMERA_RECOGNITION_OBJECT_H

typedef struct {
  int id;                   /* of its node */
  double position[3];       /* m, in the camera's axes */
  double orientation[4];    /* axis and angle, rad, in the camera's axes */
  double size[2];           /* m, width and height */
  int position_on_image[2]; /* pixels, its middle */
  int size_on_image[2];     /* pixels */
  int number_of_colors;
  double *colors;           /* red, green, blue of each, 0 to 1 */
  char *model;
} WbCameraRecognitionObject;

#endif
