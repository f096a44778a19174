/* Loaded into the program that is tried (LD_PRELOAD), so that it is started once: to load and link its libraries takes ten times as
   long as to check a small case. It then reads what to do from its standard input, a line each: a folder and the arguments, between
   tabs. For each line it forks; the child carries out the program there, with its output in the files stdout and stderr of the folder.
   It answers with two lines: the number of the child, and the status with which it has ended. */

#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { most_arguments = 32 };

typedef int (*Main)(int, char**, char**);
static Main program;

static void limit(int resource, const char* name) {
  const char* const value = getenv(name);
  if (value == NULL) return;
  const rlim_t most = (rlim_t)strtoull(value, NULL, 10);
  const struct rlimit both = {most, most + (resource == RLIMIT_CPU)};
  setrlimit(resource, &both);
}

static void write_to(const char* file, int descriptor) {
  const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(1);
  close(opened);
}

/* The child of a line: goes to its folder and becomes the program with its arguments. */
static int carry_out(char* line, char* name, char** environment) {
  char* arguments[most_arguments + 2] = {name};
  int count = 1;
  line[strcspn(line, "\n")] = '\0';
  const char* const folder = strtok(line, "\t");
  for (char* next = strtok(NULL, "\t"); next != NULL && count <= most_arguments; next = strtok(NULL, "\t")) arguments[count++] = next;
  if (folder == NULL || chdir(folder) != 0) _exit(1);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0) _exit(1);
  write_to("stdout", STDOUT_FILENO);
  write_to("stderr", STDERR_FILENO);
  limit(RLIMIT_AS, "SAZARE_TRIED_MEMORY");
  limit(RLIMIT_CPU, "SAZARE_TRIED_SECONDS");
  limit(RLIMIT_CORE, "SAZARE_TRIED_CORE");
  return program(count, arguments, environment);
}

static int serve(int count, char** arguments, char** environment) {
  (void)count;
  static char line[4096];
  while (fgets(line, sizeof line, stdin) != NULL) {
    fflush(stdout);
    const pid_t child = fork();
    if (child == 0) return carry_out(line, arguments[0], environment);
    int status = 0;
    printf("%d\n", (int)child);
    fflush(stdout);
    waitpid(child, &status, 0);
    printf("%d\n", status);
    fflush(stdout);
  }
  return 0;
}

int __libc_start_main(Main main, int count, char** arguments, void (*begin)(void), void (*end)(void), void (*linker)(void), void* stack) {
  typedef int (*Start)(Main, int, char**, void (*)(void), void (*)(void), void (*)(void), void*);
  const Start start = (Start)dlsym(RTLD_NEXT, "__libc_start_main");
  program = main;
  unsetenv("LD_PRELOAD"); /* programs that this one starts are themselves */
  return start(serve, count, arguments, begin, end, linker, stack);
}
