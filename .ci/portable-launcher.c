/* bin/dustbench of the portable file: says in one line that the C library is too old, else runs libexec/dustbench.
 *
 * Without it, the loader prints a line for each version and library that it does not find. It starts without the C
 * library's own start-up code, which is newer than the libraries that it is for: all symbols here are of glibc 2.2.5. */
#include <gnu/libc-version.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAJOR = 2, MINOR = 36, CANNOT_RUN = 3 };

static void say(const char *text) {
    const ssize_t ignored = write(STDERR_FILENO, text, strlen(text));
    (void)ignored;
}

static void require_libc(void) {
    const char *version = gnu_get_libc_version();
    char *rest;
    const long major = strtol(version, &rest, 10), minor = *rest == '.' ? strtol(rest + 1, NULL, 10) : 0;
    if (major > MAJOR || (major == MAJOR && minor >= MINOR)) return;
    say("dustbench: this system has glibc ");
    say(version);
    say(", needed: 2.36 or newer (Debian 12, Ubuntu 24.04, Fedora 37)\n");
    _exit(CANNOT_RUN);
}

__attribute__((used)) static void launch(long *stack) {
    char **arguments = (char **)(stack + 1), **environment = arguments + stack[0] + 1;
    static const char program[] = "libexec/dustbench";
    char path[PATH_MAX + sizeof program];
    require_libc();
    /* …/bin/dustbench → …/libexec/dustbench */
    ssize_t length = readlink("/proc/self/exe", path, PATH_MAX);
    for (int slashes = 0; length > 0 && slashes < 2; --length) slashes += path[length - 1] == '/';
    if (length < 0) length = 0;
    path[length] = '/';
    memcpy(path + length + 1, program, sizeof program);
    execve(path, arguments, environment);
    say("dustbench: cannot run ");
    say(path);
    say("; unpack the archive again\n");
    _exit(CANNOT_RUN);
}

/* The stack holds the number of arguments, the arguments, NULL, the environment, NULL. */
__asm__(".globl _start\n_start:\n\tmov %rsp, %rdi\n\tand $-16, %rsp\n\tcall launch\n\thlt\n");
