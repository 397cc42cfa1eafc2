/* look.h: from where to look at a mesh so that some of its faces are in front */
#ifndef TOOLS_LOOK_H
#define TOOLS_LOOK_H

#include "app.h"

enum { LOOK_TEXT = 64 };

/** Unless --view was given, sets o->view to where these faces are seen from the front: against their mean normal.
 *
 *  text   [out]  LOOK_TEXT bytes that o->view then points to.
 *  faces  [in]   count faces of m; NULL: all. Without an area they change nothing.
 */
void look_at_faces(char *text, app_output *o, const mesh *m, const sl_int *faces, sl_int count);

#endif
