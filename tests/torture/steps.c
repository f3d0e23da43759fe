/* Ends the process at its n-th step that changes a disk: a write, a sync, a name given or taken. Loaded in advance. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <sys/types.h>
#include <unistd.h>

static long end_at = -1, steps = 0;

void arm_steps(long at) { end_at = at; steps = 0; }
long count_steps(void) { return steps; }

static void step(void) {
    if (end_at >= 0 && ++steps == end_at) kill(getpid(), SIGKILL);
}

#define STEP(kind, name, declared, given) \
    kind name declared { \
        static kind(*real) declared; \
        if (!real) real = dlsym(RTLD_NEXT, #name); \
        step(); \
        return real given; \
    }

STEP(ssize_t, write, (int f, const void *b, size_t n), (f, b, n))
STEP(ssize_t, pwrite, (int f, const void *b, size_t n, off_t o), (f, b, n, o))
STEP(ssize_t, pwrite64, (int f, const void *b, size_t n, off64_t o), (f, b, n, o))
STEP(ssize_t, sendfile, (int t, int f, off_t *o, size_t n), (t, f, o, n))
STEP(ssize_t, sendfile64, (int t, int f, off64_t *o, size_t n), (t, f, o, n))
STEP(int, fsync, (int f), (f))
STEP(int, fdatasync, (int f), (f))
STEP(int, ftruncate, (int f, off_t n), (f, n))
STEP(int, ftruncate64, (int f, off64_t n), (f, n))
STEP(int, truncate, (const char *p, off_t n), (p, n))
STEP(int, truncate64, (const char *p, off64_t n), (p, n))
STEP(int, posix_fallocate, (int f, off_t o, off_t n), (f, o, n))
STEP(int, posix_fallocate64, (int f, off64_t o, off64_t n), (f, o, n))
STEP(int, rename, (const char *a, const char *b), (a, b))
STEP(int, renameat, (int x, const char *a, int y, const char *b), (x, a, y, b))
STEP(int, link, (const char *a, const char *b), (a, b))
STEP(int, linkat, (int x, const char *a, int y, const char *b, int g), (x, a, y, b, g))
STEP(int, unlink, (const char *p), (p))
STEP(int, unlinkat, (int x, const char *p, int g), (x, p, g))
STEP(int, mkdir, (const char *p, mode_t m), (p, m))
STEP(int, rmdir, (const char *p), (p))
