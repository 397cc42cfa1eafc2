/* command.h: the commands of sparse-local; each stands in its own file command_NAME.c */
#ifndef TOOLS_COMMAND_H
#define TOOLS_COMMAND_H

/* argv[0] is the name of the command. Each returns the exit status: 0, or 1 where a check failed; errors end the program
 * by themselves (app.h). */
int command_adf(int argc, char **argv);
int command_heat(int argc, char **argv);
int command_hks(int argc, char **argv);
int command_info(int argc, char **argv);
int command_pairs(int argc, char **argv);
int command_reach(int argc, char **argv);
int command_param(int argc, char **argv);
int command_geodesic(int argc, char **argv);
int command_arap(int argc, char **argv);
int command_scp(int argc, char **argv);

#endif
