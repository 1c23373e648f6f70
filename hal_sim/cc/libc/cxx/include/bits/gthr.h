// SPDX-License-Identifier: MIT
// Firmware has no threads.
#pragma once
typedef int __gthread_mutex_t;
typedef int __gthread_recursive_mutex_t;
inline int __gthread_active_p() { return 0; }
