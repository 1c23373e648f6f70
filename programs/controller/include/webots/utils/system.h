/* SPDX-License-Identifier: MIT
 * Functions of the system that Webots has for all of its platforms.
 */
#ifndef WBU_SYSTEM_H
#define WBU_SYSTEM_H

#include <webots/types.h>

TP_C_BEGIN

/** As getenv(); null: it is not set. */
const char* wbu_system_getenv(const char* variable);
/** The path itself. */
const char* wbu_system_short_path(const char* path);
/** A folder for files that need not last, by TMPDIR. */
const char* wbu_system_tmpdir(void);
/** Webots' own folder for its run: ours has none, the same as wbu_system_tmpdir(). */
const char* wbu_system_webots_instance_path(bool refresh);

TP_C_END

#endif
