/* main.c: the program sparse-local: finds the command */
#include <stdio.h>
#include <string.h>

#include "app.h"
#include "command.h"

typedef struct command {
    const char *name;
    const char *summary;
    int (*run)(int argc, char **argv);
} command;

static const command commands[] = {
    {"info", "what a mesh is, and what its factorization costs", command_info},
    {"heat", "heat that flows from some vertices, wanted at some others", command_heat},
    {"adf", "auto-diffusion: the heat that stays, for some vertices or all", command_adf},
    {"hks", "heat-kernel signatures: auto-diffusion over a range of times", command_hks},
    {"pairs", "heat that pairs of vertices exchange; one tree against two", command_pairs},
    {"reach", "pictures of what a local solve touches", command_reach},
    {"param", "a patch laid out in the plane by harmonic coordinates", command_param},
    {"arap", "a patch laid out with its lengths kept: as rigid as possible", command_arap},
    {"scp", "a patch laid out with its angles kept: spectral conformal", command_scp},
    {"geodesic", "distances along the surface by the heat method; nearest sites", command_geodesic},
};

enum { N_COMMANDS = sizeof commands / sizeof *commands };

static void print_usage(FILE *out) {
    (void)fprintf(out, "usage: sparse-local COMMAND [options] MESH\n\n"
                       "Local solutions of sparse linear systems on triangle meshes.\n\n"
                       "commands (each has --help):\n");
    for (int k = 0; k < N_COMMANDS; k++) {
        (void)fprintf(out, "  %-10s %s\n", commands[k].name, commands[k].summary);
    }
}

int main(int argc, char **argv) {
    if (argc < 2) {
        print_usage(stderr);
        return 2;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0 ||
        strcmp(argv[1], "help") == 0) {
        print_usage(stdout);
        (void)printf("\nMESH is");
        options_print_wrapped(app_mesh_help, 0, 7);
        return 0;
    }
    for (int k = 0; k < N_COMMANDS; k++) {
        if (strcmp(argv[1], commands[k].name) == 0) {
            return commands[k].run(argc - 1, argv + 1);
        }
    }
    (void)fprintf(stderr, "sparse-local: there is no command %s\n", argv[1]);
    print_usage(stderr);
    return 2;
}
