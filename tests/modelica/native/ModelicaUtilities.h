/* What a Modelica tool brings: here an error ends the run with its message. */
#ifndef MODELICA_UTILITIES_H
#define MODELICA_UTILITIES_H

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

static inline void ModelicaError(const char *text) {
    fputs(text, stderr);
    exit(3);
}

static inline void ModelicaFormatError(const char *text, ...) {
    va_list values;
    va_start(values, text);
    vfprintf(stderr, text, values);
    va_end(values);
    exit(3);
}

#endif
