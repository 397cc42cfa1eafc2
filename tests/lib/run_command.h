/* run_command.h: runs a command of sparse-local in a process of its own and keeps what it says; pictures are counted,
 * not written, so that no libpng is needed */
#ifndef SL_TEST_RUN_COMMAND_H
#define SL_TEST_RUN_COMMAND_H

/* the program defines _POSIX_C_SOURCE 200809L before its first include, and runs in files_set_up's folder */
#include "files.h"

#include <sys/wait.h>

#include "../tools/command.h"
#include "../tools/picture.h"

/* In place of png_write.c: a text file of the picture's size and how many of its pixels are not white. */
bool picture_write_png(const picture *p, const char *path, char *message, size_t message_size) {
    FILE *file = fopen(path, "w");
    size_t drawn = 0;
    if (file == NULL) {
        (void)snprintf(message, message_size, "%s: cannot be written", path);
        return false;
    }
    for (size_t k = 0; k < (size_t)p->width * (size_t)p->height; k++) {
        drawn += p->at[k].r != 255 || p->at[k].g != 255 || p->at[k].b != 255;
    }
    (void)fprintf(file, "%d %d %lu\n", p->width, p->height, (unsigned long)drawn);
    return fclose(file) == 0;
}

enum { RUN_WORDS = 24 };

/* Splits the words at blanks and runs the command; returns what it wrote to both streams, which the caller frees.
 * exit_status: -1 where it died by a signal. */
static inline char *run_command(int (*command)(int argc, char **argv), const char *words,
                                int *exit_status) {
    char copy[1024], *argv[RUN_WORDS + 1];
    const char *path = files_path("said.txt");
    int argc = 0, status = 0;
    size_t length;
    assert_true(strlen(words) < sizeof copy);
    (void)strcpy(copy, words);
    for (char *word = strtok(copy, " "); word != NULL; word = strtok(NULL, " ")) {
        assert_true(argc < RUN_WORDS);
        argv[argc++] = word;
    }
    argv[argc] = NULL;
    (void)fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (freopen(path, "w", stdout) == NULL || dup2(fileno(stdout), 2) < 0) {
            _exit(99);
        }
        exit(command(argc, argv));
    }
    assert_true(waitpid(child, &status, 0) == child);
    *exit_status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    char *said = files_get(path, &length);
    said[length] = '\0';
    return said;
}

/* Fails unless the command ends with this status and says this. */
static inline void command_says(int (*command)(int argc, char **argv), const char *words,
                                int status, const char *text) {
    int got;
    char *said = run_command(command, words, &got);
    if (got != status || strstr(said, text) == NULL) {
        print_error("%s: status %d instead of %d, or not \"%s\" in:\n%s\n", words, got, status,
                    text, said);
        fail();
    }
    free(said);
}

/* The number behind the first place where text stands in what a command said. */
static inline double number_after(const char *said, const char *text) {
    const char *at = strstr(said, text);
    assert_non_null(at); /* the text is not there */
    return strtod(at + strlen(text), NULL);
}

#endif
