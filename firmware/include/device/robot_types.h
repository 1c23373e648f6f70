/* SPDX-License-Identifier: MIT
 * Types of the interface that Webots offered from 2005 to 2008 (versions 5.x).
 */
#ifndef DEVICE_ROBOT_TYPES_H
#define DEVICE_ROBOT_TYPES_H

#include "../twinpuck.h"

/** A device of the robot; 0 is no device. */
typedef unsigned short DeviceTag;

/** A node of the world, for supervisor programs. */
typedef struct NodeStruct* NodeRef;

#endif
