/* gltf_file.h: a glTF 2 file in memory: its JSON document, its buffers, and accessors to their
 * numbers */
#ifndef TOOLS_GLTF_FILE_H
#define TOOLS_GLTF_FILE_H

#include <cjson/cJSON.h>

#include "tools/io/input.h"
#include "tools/io/scalar.h"

/** One of the top-level arrays of the document. */
typedef struct gltf_list {
    const char *name;
    int64_t count;
    const cJSON **item; /* count objects */
} gltf_list;

/** The bytes of a buffer. */
typedef struct gltf_buffer {
    const char *at; /* NULL: not loaded yet */
    int64_t length;
    char *decoded; /* owned: from a data URI */
    input file;    /* owned: a file beside the document */
} gltf_buffer;

/** The rows of a sparse accessor. */
typedef struct gltf_block {
    char *rows;
    struct gltf_block *next;
} gltf_block;

typedef struct gltf_file {
    input *in; /* the file; borrowed; receives the messages of errors */
    cJSON *root;
    const char *chunk; /* the binary chunk of a .glb; NULL without one */
    int64_t chunk_length;
    gltf_list buffers, views, accessors, meshes, nodes, scenes;
    gltf_buffer *buffer; /* buffers.count */
    int64_t loaded;      /* bytes of all buffers so far */
    gltf_block *made;    /* owned */
} gltf_file;

/** Reads the container and the document, and checks the version and the extensions that the file
 *  requires.
 *
 *  f   [out]  release with gltf_close, also on error.
 *  in  [in]   its content: text (.gltf), or a container that begins with glTF (.glb).
 *  Returns  true; false: malformed, version other than 2, an extension that changes how geometry is
 *           stored, more than 256 MB of text, out of memory.
 */
bool gltf_open(gltf_file *f, input *in);

/** Releases everything. */
void gltf_close(gltf_file *f);

/** Reads the member `name` of an object, an integer in 0..limit-1.
 *
 *  of, number  [in]   the object, for messages: "accessor", 3.
 *  k           [out]  -1 if there is no such member.
 *  Returns  true; false: not such an integer.
 */
bool gltf_integer(const gltf_file *f, const cJSON *object, const char *name, int64_t limit,
                  const char *of, int64_t number, int64_t *k);

/** Reads the member `name` of an object, an array of `count` finite numbers. Without such a member
 *  the values stay as they are. Returns false if it is something else. */
bool gltf_numbers(const gltf_file *f, const cJSON *object, const char *name, int count,
                  const char *of, int64_t number, double *values);

/** The member `name`, which must be an array of objects, or does not exist. */
bool gltf_list_open(const gltf_file *f, gltf_list *list, const cJSON *object, const char *name);

/** Loads buffer `number`, unless it is loaded: the binary chunk, a data URI, or a file. */
bool gltf_load_buffer(gltf_file *f, int64_t number);

/** Numbers in a buffer: count rows of `width` components. */
typedef struct gltf_accessor {
    const char *at;
    int64_t count, stride; /* rows, and bytes from one to the next */
    int width;
    scalar_type type;
    bool normalized; /* integers stand for 0..1 or -1..1 */
} gltf_accessor;

/** Finds the numbers of accessor `number` and checks that all of them are in their buffer, which is
 *  loaded if need be. The rows of a sparse accessor are copied, and those that it replaces
 *  replaced.
 *
 *  a  [out]  valid until gltf_close.
 *  Returns  true; false: out of range or malformed; a buffer that is missing, truncated or not in
 *           the folder of the document; more than 256 bytes of sparse rows for each byte of the
 *           file; out of memory.
 */
bool gltf_accessor_open(gltf_file *f, gltf_accessor *a, int64_t number);

/** One number. */
double gltf_value(const gltf_accessor *a, int64_t row, int component);

#endif
