/* main.c: entry point of sparse-local: finds the command and runs it */
#include <stdio.h>
#include <string.h>

#include "app.h"
#include "command.h"
#include "near_word.h"
#include "tools/io/output_file.h"

typedef struct command {
    const char *name;
    const char *summary;
    int (*run)(int argc, char **argv);
} command;

static const command commands[] = {
    {"info", "mesh statistics and the cost of factoring its Laplacian", command_info},
    {"heat", "heat diffusion from source vertices, solved at selected vertices", command_heat},
    {"adf", "auto-diffusion function at selected vertices or all", command_adf},
    {"hks", "heat kernel signatures: the auto-diffusion function at several times", command_hks},
    {"pairs", "heat exchanged by pairs of vertices, by three methods", command_pairs},
    {"reach", "the columns of L that a local solve visits, as pictures", command_reach},
    {"unwrap", "planar layout of a surface: texture coordinates", command_unwrap},
    {"geodesic", "distances on the surface by the heat method, Voronoi cells", command_geodesic},
    {"vectors", "tangent vectors carried over the surface, logarithmic map", command_vectors},
    {"deform", "a mesh deformed by handles that are grabbed, moved, released", command_deform},
    {"edit", "a system or a mesh edited at random places, and a factor that follows", command_edit},
    {"save", "factors the Laplacian of a mesh and saves the factor in a file", command_save},
    {"view", "a page for a browser: the mesh and fields on it, to turn and to query", command_view},
    {"query", "answers local solves with a saved factor, from standard input", command_query},
};

enum { N_COMMANDS = sizeof commands / sizeof *commands };

static void print_usage(FILE *out) {
    (void)fprintf(out, "Solves sparse linear systems locally on triangle meshes.\n\n"
                       "usage: sparse-local COMMAND [options] MESH\n\n"
                       "Commands:\n");
    for (int k = 0; k < N_COMMANDS; k++) {
        (void)fprintf(out, "  %-10s %s\n", commands[k].name, commands[k].summary);
    }
}

static const command *command_named(const char *name) {
    for (int k = 0; k < N_COMMANDS; k++) {
        if (strcmp(name, commands[k].name) == 0) {
            return &commands[k];
        }
    }
    return NULL;
}

static int refuse_command(const char *name) {
    static const char *const methods[][2] = {
        {"param", "harmonic"}, {"arap", "arap"}, {"scp", "scp"}};
    const char *meant = NULL;
    for (int k = 0; k < 3; k++) {
        if (strcmp(name, methods[k][0]) == 0) {
            (void)fprintf(stderr, "sparse-local: %s is unwrap --method %s now\n", name,
                          methods[k][1]);
            return 2;
        }
    }
    for (int k = 0; k < N_COMMANDS; k++) {
        meant = near_word(name, meant, commands[k].name);
    }
    if (meant != NULL) {
        (void)fprintf(stderr, "sparse-local: unknown command %s; did you mean %s?\n", name, meant);
    } else {
        (void)fprintf(stderr, "sparse-local: unknown command %s\n", name);
    }
    print_usage(stderr);
    return 2;
}

static int print_help(void) {
    print_usage(stdout);
    (void)printf("\nMESH is");
    options_print_wrapped(app_mesh_help, 0, 7);
    (void)printf("\nRun sparse-local COMMAND --help for the options and output of a command.\n");
    return 0;
}

int main(int argc, char **argv) {
    output_begin_program("sparse-local");
    if (argc < 2) {
        print_usage(stderr);
        return 2;
    }
    if (strcmp(argv[1], "--version") == 0) {
        (void)printf("sparse-local %d.%d.%d%s\n", SL_VERSION_MAJOR, SL_VERSION_MINOR,
                     SL_VERSION_PATCH, SL_VERSION_SUFFIX);
        return 0;
    }
    const bool wants_help = strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
                            strcmp(argv[1], "help") == 0;
    if (wants_help && argc == 2) {
        return print_help();
    }
    const char *name = argv[wants_help ? 2 : 1]; /* help NAME is NAME --help */
    const command *found = command_named(name);
    if (found == NULL) {
        return refuse_command(name);
    }
    if (wants_help) {
        char help[] = "--help", *words[3] = {argv[2], help, NULL};
        return found->run(2, words);
    }
    return found->run(argc - 1, argv + 1);
}
