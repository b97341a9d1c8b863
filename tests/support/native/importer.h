/* What the drivers share: libraries of any platform, loads that are the same everywhere, arguments
 * as numbers, bits as text. */
#ifndef APNC_TESTS_IMPORTER_H
#define APNC_TESTS_IMPORTER_H

#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
static void *open_library(const char *path) { return (void *)LoadLibraryA(path); }
static void *symbol(void *library, const char *name) {
    return (void *)(uintptr_t)GetProcAddress((HMODULE)library, name);
}
#else
#include <dlfcn.h>
static void *open_library(const char *path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void *symbol(void *library, const char *name) { return dlsym(library, name); }
#endif

#define MOST 512
#define TS   (1.0 / 60.0)

static void *library;

/* A function of the library; ends the program if it is missing. */
static void *function(const char *name) {
    void *found = symbol(library, name);
    if (!found) {
        fprintf(stderr, "%s is missing\n", name);
        exit(1);
    }
    return found;
}

/* Opens the library; ends the program if it cannot be loaded. */
static void open_or_exit(const char *path) {
    library = open_library(path);
    if (library) return;
    fprintf(stderr, "%s cannot be loaded\n", path);
    exit(1);
}

/* Stance patterns of unequal rates with noise; only operations that round alike everywhere. */
static double load(uint64_t *seed, long tick, int foot) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    const double noise = (double)(*seed >> 11) / 9007199254740992.0;
    const long period = 41 + 3 * foot;
    return tick % period < period / 2 ? 8.0 + 6.0 * noise : 0.0;
}

static char **next; /* argument to read next */

static unsigned long number(void) { return *next ? strtoul(*next++, NULL, 10) : 0; }

static size_t count(void) {
    const unsigned long n = number();
    if (n > MOST) exit(2);
    return n;
}

/* The bits of the values as one line. */
static void show(const double *values, size_t n) {
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        printf("%016" PRIx64 "%c", bits, i + 1 < n ? ' ' : '\n');
    }
}

#endif
