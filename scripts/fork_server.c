/* A library to preload: a program that is started with it does its main() again and again, each time in a fork of its
 * own, so that a run costs no loading of libraries. scripts/fork_runner.py asks for runs.
 *
 * Requests on descriptor 0: a 32-bit length, then that many bytes, strings that each end with a zero: the folder to run
 * in, the file for what it writes to stderr, the seconds of processor time that each of its processes may use, the
 * arguments. Answers on descriptor 1: the 32-bit process number; when it
 * has ended, four 64-bit numbers: status as wait() gives it, microseconds of processors in user and system, the largest
 * resident kilobytes. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { kMostBytes = 1 << 20, kMostWords = 256 };

typedef int (*Main)(int, char**, char**);
static Main program_main;

static int read_all(void* to, size_t size) {
  for (char* at = to; size > 0;) {
    const ssize_t got = read(0, at, size);
    if (got <= 0) return 0;
    at += got;
    size -= (size_t)got;
  }
  return 1;
}

static void answer(const void* from, size_t size) {
  if (write(1, from, size) != (ssize_t)size) _exit(3);
}

/* In the fork. */
static int run(char* folder, char* errors, char* seconds, int count, char** words, char** environment) {
  if (chdir(folder) != 0) _exit(125);
  const int nothing = open("/dev/null", O_RDWR);
  const int to = open(errors, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (nothing < 0 || to < 0) _exit(125);
  dup2(nothing, 0);
  dup2(nothing, 1);
  dup2(to, 2);
  close(nothing);
  close(to);
  const struct rlimit no_core = {0, 0};
  const struct rlimit file = {1 << 28, 1 << 28};
  const rlim_t most = (rlim_t)strtoul(seconds, NULL, 10);
  const struct rlimit processor = {most, most};
  setrlimit(RLIMIT_CPU, &processor);
  setrlimit(RLIMIT_CORE, &no_core);
  setrlimit(RLIMIT_FSIZE, &file);
  return program_main(count, words, environment);
}

/* Libraries that each run would open itself, with colons between: a fork finds them loaded. One that cannot be is left to
 * the runs, which tell why. */
static void open_libraries(char* files) {
  for (char* file = files; file != NULL && *file != 0;) {
    char* const end = strchr(file, ':');
    if (end != NULL) *end = 0;
    dlopen(file, RTLD_NOW | RTLD_LOCAL);
    file = end == NULL ? NULL : end + 1;
  }
}

static int serve(int argc, char** argv, char** environment) {
  (void)argc;
  open_libraries(getenv("FORK_SERVER_OPENS"));
  unsetenv("FORK_SERVER_OPENS");
  static char bytes[kMostBytes + 1];
  for (;;) {
    uint32_t size = 0;
    if (!read_all(&size, sizeof size)) return 0;
    if (size > kMostBytes || !read_all(bytes, size)) return 3;
    char* words[kMostWords + 4] = {0};
    int count = 0;
    for (uint32_t at = 0; at < size && count < kMostWords + 3; ++count) {
      words[count] = bytes + at;
      while (at < size && bytes[at] != 0) ++at;
      bytes[at++] = 0;
    }
    if (count < 4) return 3;
    const pid_t child = fork();
    if (child < 0) return 3;
    if (child == 0) {
      unsetenv("LD_PRELOAD"); /* what it starts itself runs as it would */
      unsetenv("LD_BIND_NOW");
      words[3] = argv[0];
      return run(words[0], words[1], words[2], count - 3, words + 3, environment);
    }
    const int32_t number = child;
    answer(&number, sizeof number);
    int status = 0;
    struct rusage used;
    if (wait4(child, &status, 0, &used) != child) return 3;
    const int64_t told[4] = {status, used.ru_utime.tv_sec * (int64_t)1000000 + used.ru_utime.tv_usec,
                             used.ru_stime.tv_sec * (int64_t)1000000 + used.ru_stime.tv_usec, used.ru_maxrss};
    answer(told, sizeof told);
  }
}

int __libc_start_main(Main main, int argc, char** argv, void (*init)(void), void (*fini)(void), void (*late)(void),
                      void* stack_end) {
  typedef int (*Start)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
  const Start start = (Start)dlsym(RTLD_NEXT, "__libc_start_main");
  program_main = main;
  return start(serve, argc, argv, init, fini, late, stack_end);
}
