/* source_list.h: the sources that --from names: vertices, or curves along edges, from a file too */
#ifndef TOOLS_SOURCE_LIST_H
#define TOOLS_SOURCE_LIST_H

#include "app.h"
#include "tools/geometry/edge_curve.h"

/** The part of a help text that is the same for all options that read a source_list. */
#define SOURCE_LIST_HELP \
    "3,17,100-200, random:5 or @FILE, a file of them; curve:3,17,100 or curve:@FILE, all points " \
    "of the curve along edges through these vertices, where each line of the file, or part " \
    "before a semicolon, is a curve"

typedef struct source_list {
    sl_int *vertices, count;
    edge_curve curve; /* all zero: the vertices alone are sources; else its vertices are */
} source_list;

/** Reads the sources without repetitions; dies if the text is malformed.
 *
 *  out   [out]  release with source_list_free.
 *  text  [in]   NULL: app_default_vertex.
 */
void source_list_read(source_list *out, const char *option_name, const char *text, const mesh *m);

void source_list_free(source_list *s);

#endif
