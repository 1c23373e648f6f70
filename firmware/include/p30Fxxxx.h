/* SPDX-License-Identifier: MIT
 * <p30Fxxxx.h> chooses the device header; the e-puck has one device.
 */
#ifndef __TWINPUCK__
#include_next <p30Fxxxx.h>
#else
#include "p30F6014A.h"
#endif
