/* command.h: the commands of sparse-local; command NAME is in command_NAME.c */
#ifndef TOOLS_COMMAND_H
#define TOOLS_COMMAND_H

/* argv[0] is the name of the command. Returns the exit status: 0, or 1 if a check of the results
 * failed. Errors exit the program (app.h). */
int command_adf(int argc, char **argv);
int command_heat(int argc, char **argv);
int command_hks(int argc, char **argv);
int command_info(int argc, char **argv);
int command_pairs(int argc, char **argv);
int command_reach(int argc, char **argv);
int command_unwrap(int argc, char **argv);
int command_geodesic(int argc, char **argv);
int command_save(int argc, char **argv);
int command_view(int argc, char **argv);
int command_query(int argc, char **argv);
int command_deform(int argc, char **argv);
int command_edit(int argc, char **argv);
int command_vectors(int argc, char **argv);

#endif
