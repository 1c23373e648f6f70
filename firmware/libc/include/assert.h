/* SPDX-License-Identifier: MIT
 * Firmware libc: a failed assertion stops the robot with file, line and text. */
#undef assert
#ifdef NDEBUG
#define assert(condition) ((void)0)
#else
void tp_assert_failed(const char* __file, int __line, const char* __text);
#define assert(condition) ((condition) ? (void)0 : tp_assert_failed(__FILE__, __LINE__, #condition))
#endif
