/* Runs a command and prints one line of JSON on stderr with wall clock and CPU time of it and all
 * its children, and the peak memory of the largest one. (Python cannot tell: a child of a large
 * process starts with its parent's peak.) */
#define _DEFAULT_SOURCE /* wait4 */
#include <stdio.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double clock_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e9 * (double)now.tv_sec + (double)now.tv_nsec;
}

static double time_ns(struct timeval time)
{
    return 1e9 * (double)time.tv_sec + 1e3 * (double)time.tv_usec;
}

int main(int count, char **words)
{
    double begin_ns = clock_ns();
    pid_t child = count > 1 ? fork() : -1;
    if (child < 0) {
        fprintf(stderr, "usage: spent COMMAND [WORD...]\n");
        return 64;
    }
    if (child == 0) {
        execvp(words[1], words + 1);
        perror(words[1]);
        _exit(127);
    }
    int status;
    struct rusage spent;
    if (wait4(child, &status, 0, &spent) < 0 || !WIFEXITED(status))
        return 1;
    fprintf(stderr, "{\"part\":\"spent\",\"wall_ns\":%.0f,\"cpu_ns\":%.0f,\"peak_kB\":%ld}\n",
            clock_ns() - begin_ns, time_ns(spent.ru_utime) + time_ns(spent.ru_stime),
            spent.ru_maxrss);
    return WEXITSTATUS(status);
}
