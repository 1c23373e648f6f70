/* SPDX-License-Identifier: MIT
 * Types of the interface that Webots offers to controllers in C.
 * int has 16 bits and double 32 on the robot, the PC's widths in programs of the PC. See docs/webots.md.
 */
#ifndef WB_TYPES_H
#define WB_TYPES_H

#include <math.h> /* INFINITY */
#include <stdbool.h>

#include "../twinpuck.h"

/** A device of the robot; 0 is no device. */
typedef unsigned short WbDeviceTag;

typedef struct WbImageStructPrivate* WbImageRef;
typedef struct WbMotionStructPrivate* WbMotionRef;
typedef struct WbNodeStructPrivate* WbNodeRef;
typedef struct WbFieldStructPrivate* WbFieldRef;
typedef struct WbProtoStructPrivate* WbProtoRef;

#define WB_ANGULAR 0
typedef enum { WB_ROTATIONAL = 0, WB_LINEAR } WbJointType;

#ifndef WB_DEPRECATED
#define WB_DEPRECATED
#endif

#endif
