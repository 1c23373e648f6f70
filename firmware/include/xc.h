/* SPDX-License-Identifier: MIT
 * <xc.h> chooses the device header; the e-puck has one device.
 */
#ifndef __TWINPUCK__
#include_next <xc.h>
#else
#include <stdint.h>

#include "p30F6014A.h"
#endif
