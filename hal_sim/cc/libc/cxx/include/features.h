/* SPDX-License-Identifier: MIT
 * What the C++ library's headers ask about the C library: it is not the PC's. */
#define __GLIBC_PREREQ(major, minor) 0
