/* run_command.h: runs a command of sparse-local in a child process and keeps its output */
#ifndef SL_TEST_RUN_COMMAND_H
#define SL_TEST_RUN_COMMAND_H

/* The program defines _POSIX_C_SOURCE 200809L before its first include, and uses files_set_up. */
#include "temporary_files.h"

#include <sys/wait.h>

#include "tools/cli/command.h"
#include "tools/draw/picture.h"

/* Replaces png_write.c, so that libpng is not needed: writes a text file with the size of the image
 * and the number of pixels that are not white. */
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

/* Splits `words` at blanks and runs the command with --verbose. Returns what it wrote to standard
 * output and standard error; the caller frees it. exit_status: -1 if a signal killed it. */
static inline char *run_command(int (*command)(int argc, char **argv), const char *words,
                                int *exit_status) {
    char copy[1024], word_verbose[] = "--verbose", *argv[RUN_WORDS + 1];
    const char *path = files_path("output.txt");
    int argc = 0, status = 0;
    size_t length;
    assert_true(strlen(words) < sizeof copy);
    (void)strcpy(copy, words);
    for (char *word = strtok(copy, " "); word != NULL; word = strtok(NULL, " ")) {
        assert_true(argc < RUN_WORDS);
        argv[argc++] = word;
    }
    assert_true(argc < RUN_WORDS);
    argv[argc++] = word_verbose;
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
    char *output = files_get(path, &length);
    output[length] = '\0';
    return output;
}

/* Fails unless the command ends with this status and its output contains text. */
static inline void command_says(int (*command)(int argc, char **argv), const char *words,
                                int status, const char *text) {
    int got;
    char *output = run_command(command, words, &got);
    if (got != status || strstr(output, text) == NULL) {
        print_error("%s: status %d instead of %d, or not \"%s\" in:\n%s\n", words, got, status,
                    text, output);
        fail();
    }
    free(output);
}

/* The number that follows the first occurrence of text. */
static inline double number_after(const char *output, const char *text) {
    const char *at = strstr(output, text);
    assert_non_null(at); /* the text does not occur */
    return strtod(at + strlen(text), NULL);
}

#endif
