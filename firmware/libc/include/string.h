/* SPDX-License-Identifier: MIT
 * Firmware libc: memory and strings. */
#ifndef TP_LIBC_STRING_H
#define TP_LIBC_STRING_H
#include <stddef.h>
void* memcpy(void* __to, const void* __from, size_t __n);
void* memmove(void* __to, const void* __from, size_t __n);
void* memset(void* __to, int __value, size_t __n);
int memcmp(const void* __a, const void* __b, size_t __n);
void* memchr(const void* __s, int __c, size_t __n);
size_t strlen(const char* __s);
char* strcpy(char* __to, const char* __from);
char* strncpy(char* __to, const char* __from, size_t __n);
char* strcat(char* __to, const char* __from);
char* strncat(char* __to, const char* __from, size_t __n);
int strcmp(const char* __a, const char* __b);
int strncmp(const char* __a, const char* __b, size_t __n);
int strcasecmp(const char* __a, const char* __b);
int strcoll(const char* __a, const char* __b);
size_t strxfrm(char* __to, const char* __from, size_t __n);
char* strchr(const char* __s, int __c);
char* strrchr(const char* __s, int __c);
char* strstr(const char* __s, const char* __part);
size_t strspn(const char* __s, const char* __set);
size_t strcspn(const char* __s, const char* __set);
char* strpbrk(const char* __s, const char* __set);
char* strtok(char* __s, const char* __separators);
char* strerror(int __number);
#endif
