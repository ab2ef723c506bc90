/* SPDX-License-Identifier: MPL-2.0 */
/* Checks for the tests in C: what fails is printed and counted; a program that finds nothing prints nothing. */
#ifndef NPFEM_TESTS_CHECK_H
#define NPFEM_TESTS_CHECK_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "npfem/npfem.h"

static int failures = 0;

/* Passes `found` through; reports it, and the library's message, when it is not what was expected. */
static int32_t report(int right, int32_t found, const char* call, int line) {
  if (!right) {
    char message[2048] = "";
    npfem_last_error(message, (int32_t)sizeof message);
    fprintf(stderr, "line %d: %s gave %d; last error: %s\n", line, call, (int)found, message);
    ++failures;
  }
  return found;
}

/* A call that must succeed; what it returned. */
#define OK(call) must_succeed((call), #call, __LINE__)
static int32_t must_succeed(int32_t found, const char* call, int line) {
  return report(found >= 0, found, call, line);
}

/* Something that must hold. */
#define HOLDS(condition) report((condition), 0, #condition, __LINE__)

#endif
