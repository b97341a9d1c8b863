#!/usr/bin/env bash
# A program compiled by zig cc is told that its processor supports nothing.
#
# Version: ziglang 0.17.1 (PyPI), run on 2026-12-01 on Linux x86-64.
# Behaviour: __builtin_cpu_supports, by which C chooses code for SSE, AVX and so on at run time,
# compiles and links without a warning, and answers 0 to every name: also to sse2, which every
# x86-64 processor has, and after __builtin_cpu_init. cpuid itself says what there is. So a library
# that chooses by it runs its slowest code, and nothing fails.
# Output seen: what is asked for, cpuid, __builtin_cpu_supports
#   sse2 1 0
#   sse 1 0
#   mmx 1 0
# Way out: ask cpuid, with <cpuid.h>.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "ziglang==0.17.1"
cd "$work"
cat >look.c <<'END'
#include <cpuid.h>
#include <stdio.h>

int main(void) {
    unsigned a, b, c, d;
    int other = !__get_cpuid(1, &a, &b, &c, &d);
    const int has[] = {d >> 26 & 1, d >> 25 & 1, d >> 23 & 1};
    __builtin_cpu_init();
    const int told[] = {__builtin_cpu_supports("sse2"), __builtin_cpu_supports("sse"),
                        __builtin_cpu_supports("mmx")};
    const char *const names[] = {"sse2", "sse", "mmx"};
    for (int k = 0; k < 3; ++k) {
        printf("%s %d %d\n", names[k], has[k], !!told[k]);
        other |= !has[k] || told[k];
    }
    return other;
}
END
ZIG_GLOBAL_CACHE_DIR="$work/cache" "$work/venv/bin/python" -m ziglang cc \
    -target x86_64-linux-musl -Wall -Wextra -Werror look.c -o look
./look
