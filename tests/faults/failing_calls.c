// Preloaded into a program and its children: makes one system call of a kind fail, or all from a given one on.
//
//   DUSTBENCH_FAULT=KIND:N:ERRNO     kinds: write fsync open rename mkdir fork alloc unsynced; N+ is the N-th call and all after it
//   DUSTBENCH_FAULT_BELOW=FOLDER     only files below it count (except for fork and alloc)
//   DUSTBENCH_FAULT_COUNT=FILE       eight bytes that all processes share: the number of calls so far
//
// With N = 0 nothing fails and calls are only counted. `unsynced` is the rename of a file, or of a folder with a file, that the same
// process has not synchronised (fsync) since it was last written: after a loss of power it could be empty.
#define _GNU_SOURCE  // NOLINT(bugprone-reserved-identifier): the name is glibc's
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

static const char* kind;
static const char* below;
static long first;
static int all, error;
static long* calls;

__attribute__((constructor)) static void begin(void) {
    const char* const fault = getenv("DUSTBENCH_FAULT");
    const char* const file = getenv("DUSTBENCH_FAULT_COUNT");
    below = getenv("DUSTBENCH_FAULT_BELOW");
    if (!fault || !file) return;
    static char name[16];
    char rest[64] = "";
    if (sscanf(fault, "%15[a-z]:%ld%63s", name, &first, rest) != 3) return;
    all = rest[0] == '+';
    error = atoi(rest + all + 1);
    const int handle = (int)(long)open(file, O_RDWR | O_CLOEXEC);
    void* const shared = mmap(NULL, sizeof *calls, PROT_READ | PROT_WRITE, MAP_SHARED, handle, 0);
    close(handle);
    if (shared == MAP_FAILED) return;
    calls = shared;
    kind = name;
}

static int fails(const char* now) {
    if (!kind || strcmp(kind, now) != 0) return 0;
    const long call = __atomic_add_fetch(calls, 1, __ATOMIC_SEQ_CST);
    if (first == 0 || (all ? call < first : call != first)) return 0;
    errno = error;
    return 1;
}

static int isBelow(const char* path) {
    return kind && below && path && strncmp(path, below, strlen(below)) == 0;
}

static int handleIsBelow(int handle) {
    if (!kind || !below || handle < 3) return 0;
    char link[64], path[PATH_MAX];
    snprintf(link, sizeof link, "/proc/self/fd/%d", handle);
    const ssize_t length = readlink(link, path, sizeof path - 1);
    if (length < 0) return 0;
    path[length] = 0;
    return isBelow(path);
}

#define REAL(name) ((__typeof__(&(name)))dlsym(RTLD_NEXT, #name))

// The files on disk, by inode. A process of a small suite has a few hundred.
static ino_t synced[4096];
static size_t syncedCount;

static void forget(int handle) {
    struct stat file;
    if (!kind || strcmp(kind, "unsynced") != 0 || fstat(handle, &file) != 0) return;
    for (size_t i = 0; i < syncedCount; ++i)
        if (synced[i] == file.st_ino) synced[i] = 0;
}

static int isUnsynced(const char* path, const struct stat* file, int type, struct FTW* place) {
    (void)path, (void)place;
    if (type != FTW_F) return 0;
    for (size_t i = 0; i < syncedCount; ++i)
        if (synced[i] == file->st_ino) return 0;
    return 1;
}

int fsync(int handle) {
    if (handleIsBelow(handle) && fails("fsync")) return -1;
    struct stat file;
    if (kind && fstat(handle, &file) == 0 && syncedCount < sizeof synced / sizeof *synced) synced[syncedCount++] = file.st_ino;
    return REAL(fsync)(handle);
}

ssize_t write(int handle, const void* data, size_t bytes) {
    forget(handle);
    if (kind && !strcmp(kind, "write") && handleIsBelow(handle) && fails("write")) return -1;
    return REAL(write)(handle, data, bytes);
}

ssize_t writev(int handle, const struct iovec* parts, int count) {
    forget(handle);
    if (kind && !strcmp(kind, "write") && handleIsBelow(handle) && fails("write")) return -1;
    return REAL(writev)(handle, parts, count);
}

int rename(const char* from, const char* to) {
    if (isBelow(to) && fails("rename")) return -1;
    // Files without a final name are synchronised with their folder.
    if (isBelow(to) && !strstr(to, "/.unfinished-") && nftw(from, isUnsynced, 16, FTW_PHYS) == 1 && fails("unsynced")) return -1;
    return REAL(rename)(from, to);
}

int mkdir(const char* path, mode_t mode) {
    if (isBelow(path) && fails("mkdir")) return -1;
    return REAL(mkdir)(path, mode);
}

FILE* fopen(const char* path, const char* mode) {
    if (isBelow(path) && fails("open")) return NULL;
    return REAL(fopen)(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
    if (isBelow(path) && fails("open")) return NULL;
    return REAL(fopen64)(path, mode);
}

#define OPEN(name)                                            \
    int name(const char* path, int flags, ...) {              \
        va_list more;                                         \
        va_start(more, flags);                                \
        const mode_t mode = (mode_t)va_arg(more, unsigned);   \
        va_end(more);                                         \
        if (isBelow(path) && fails("open")) return -1;        \
        return REAL(name)(path, flags, mode);                 \
    }
OPEN(open)
OPEN(open64)

pid_t fork(void) {
    if (fails("fork")) return -1;
    return REAL(fork)();
}

// While a library is loaded, it constructs static objects; exceptions from these cannot be caught.
static __thread int loading;

void* dlopen(const char* path, int flags) {
    ++loading;
    void* const library = REAL(dlopen)(path, flags);
    --loading;
    return library;
}

extern void* __libc_malloc(size_t);  // NOLINT(bugprone-reserved-identifier): glibc's own

// Small allocations occur in every library.
void* malloc(size_t bytes) {
    if (bytes >= 50000 && !loading && fails("alloc")) return NULL;
    return __libc_malloc(bytes);
}
