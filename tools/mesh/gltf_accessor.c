/* gltf_accessor.c: the accessors of a glTF 2 file: numbers in its buffers, sparse ones as well */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "gltf_file.h"

/* Sparse accessors need no bytes for rows that are zero. A file that asks for more than this is
 * refused before memory runs out. */
enum { ROW_BYTES_PER_BYTE = 256 };

static const cJSON *member(const cJSON *object, const char *name) {
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

static bool component_type(int64_t code, scalar_type *type) {
    static const scalar_type types[7] = {SCALAR_INT8,   SCALAR_UINT8,  SCALAR_INT16, SCALAR_UINT16,
                                         SCALAR_DOUBLE, SCALAR_UINT32, SCALAR_FLOAT};
    if (code < 5120 || code > 5126 || code == 5124) {
        return false;
    }
    *type = types[code - 5120];
    return true;
}

/* Reads the type and the shape of an accessor. */
static bool read_shape(const gltf_file *f, gltf_accessor *a, const cJSON *object, int64_t number) {
    static const char *const shapes[4] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const cJSON *shape = member(object, "type");
    int64_t code = -1;
    if (!gltf_integer(f, object, "count", INT32_MAX, "accessor", number, &a->count) ||
        !gltf_integer(f, object, "componentType", 1 << 16, "accessor", number, &code)) {
        return false;
    }
    a->width = 0;
    for (int k = 0; k < 4 && cJSON_IsString(shape); k++) {
        a->width = strcmp(shape->valuestring, shapes[k]) == 0 ? k + 1 : a->width;
    }
    a->normalized = cJSON_IsTrue(member(object, "normalized"));
    return (a->count >= 0 && a->width > 0 && component_type(code, &a->type)) ||
           input_error(f->in, "accessor %lld has no valid count, type and componentType",
                       (long long)number);
}

/* Where rows of numbers are: `object` has a bufferView and perhaps a byteOffset. */
typedef struct rows {
    const cJSON *object;
    const char *of;               /* the object and the number of its accessor, for messages */
    int64_t number, count, bytes; /* of rows, and of one of them */
    const char *at;               /* found: the first one */
    int64_t stride;               /* found: bytes from one to the next */
} rows;

/* Finds rows in a buffer; at = NULL if the object has no bufferView. */
static bool find_rows(gltf_file *f, rows *r) {
    const int64_t most = INT64_C(1) << 40;
    int64_t view = -1, buffer = -1, start = -1, offset = -1, length = -1, stride = -1;
    r->at = NULL;
    if (!gltf_integer(f, r->object, "bufferView", f->views.count, r->of, r->number, &view) ||
        !gltf_integer(f, r->object, "byteOffset", most, r->of, r->number, &offset)) {
        return false;
    }
    if (view < 0) {
        return true;
    }
    const cJSON *object = f->views.item[view];
    if (!gltf_integer(f, object, "buffer", f->buffers.count, "bufferView", view, &buffer) ||
        !gltf_integer(f, object, "byteOffset", most, "bufferView", view, &start) ||
        !gltf_integer(f, object, "byteLength", most, "bufferView", view, &length) ||
        !gltf_integer(f, object, "byteStride", 253, "bufferView", view, &stride)) {
        return false;
    }
    if (buffer < 0 || length < 0) {
        return input_error(f->in, "bufferView %lld has no buffer or no byteLength",
                           (long long)view);
    }
    if (!gltf_load_buffer(f, buffer)) {
        return false;
    }
    start = start > 0 ? start : 0;
    offset = offset > 0 ? offset : 0;
    r->stride = stride > 0 ? stride : r->bytes;
    if (r->stride < r->bytes || start + length > f->buffer[buffer].length ||
        (r->count > 0 && offset + (r->count - 1) * r->stride + r->bytes > length)) {
        return input_error(f->in, "%s %lld: ends beyond its bufferView or buffer", r->of,
                           (long long)r->number);
    }
    r->at = f->buffer[buffer].at + start + offset;
    return true;
}

/* Memory for the rows of a sparse accessor, which gltf_close releases. */
static char *new_rows(gltf_file *f, int64_t number, int64_t bytes) {
    const int64_t most = ROW_BYTES_PER_BYTE * (f->in->end - f->in->data + f->loaded);
    if (bytes > most) {
        (void)input_error(f->in, "accessor %lld: more than %d bytes for each byte of the file",
                          (long long)number, (int)ROW_BYTES_PER_BYTE);
        return NULL;
    }
    gltf_block *block = (gltf_block *)malloc(sizeof *block);
    char *made = (char *)calloc((size_t)bytes + 1, 1);
    if (block == NULL || made == NULL) {
        free(block);
        free(made);
        (void)input_error(f->in, "out of memory");
        return NULL;
    }
    block->rows = made;
    block->next = f->made;
    f->made = block;
    return made;
}

/* Makes the rows of a sparse accessor: those of its bufferView, or zeros, and then the rows that
 * `sparse` replaces. */
static bool replace_rows(gltf_file *f, gltf_accessor *a, const cJSON *sparse, rows *r) {
    rows index = {
        member(sparse, "indices"), "sparse indices of accessor", r->number, -1, 0, NULL, 0};
    rows value = {
        member(sparse, "values"), "sparse values of accessor", r->number, -1, r->bytes, NULL, 0};
    int64_t code = -1;
    scalar_type type = SCALAR_FLOAT;
    if (!gltf_integer(f, sparse, "count", a->count + 1, "sparse of accessor", r->number,
                      &index.count) ||
        !gltf_integer(f, index.object, "componentType", 1 << 16, index.of, r->number, &code)) {
        return false;
    }
    if (index.count < 0 || !component_type(code, &type) || type == SCALAR_FLOAT) {
        return input_error(f->in, "accessor %lld: sparse has no valid count and componentType",
                           (long long)r->number);
    }
    index.bytes = scalar_bytes(type);
    value.count = index.count;
    if (!find_rows(f, &index) || !find_rows(f, &value)) {
        return false;
    }
    if (index.at == NULL || value.at == NULL) {
        return input_error(f->in, "accessor %lld: sparse has no bufferView for indices or values",
                           (long long)r->number);
    }
    char *made = new_rows(f, r->number, a->count * r->bytes);
    for (int64_t k = 0; made != NULL && r->at != NULL && k < a->count; k++) {
        memcpy(made + k * r->bytes, r->at + k * r->stride, (size_t)r->bytes);
    }
    for (int64_t k = 0; made != NULL && k < index.count; k++) {
        const double row = scalar_decode(type, false, index.at + k * index.stride);
        if (!(row >= 0 && row < (double)a->count)) {
            return input_error(f->in, "sparse index %.0f is not a row of accessor %lld", row,
                               (long long)r->number);
        }
        memcpy(made + (int64_t)row * r->bytes, value.at + k * value.stride, (size_t)r->bytes);
    }
    r->at = made;
    r->stride = r->bytes;
    return made != NULL;
}

bool gltf_accessor_open(gltf_file *f, gltf_accessor *a, int64_t number) {
    if (number < 0 || number >= f->accessors.count) {
        return input_error(f->in, "there is no accessor %lld", (long long)number);
    }
    const cJSON *object = f->accessors.item[number], *sparse = member(object, "sparse");
    if (!read_shape(f, a, object, number)) {
        return false;
    }
    rows r = {object, "accessor", number, a->count, (int64_t)a->width * scalar_bytes(a->type),
              NULL,   0};
    if (!find_rows(f, &r) || (sparse != NULL && !replace_rows(f, a, sparse, &r))) {
        return false;
    }
    if (r.at == NULL) {
        return input_error(f->in, "accessor %lld has neither bufferView nor sparse",
                           (long long)number);
    }
    a->at = r.at;
    a->stride = r.stride;
    return true;
}

double gltf_value(const gltf_accessor *a, int64_t row, int component) {
    static const double scale[] = {127, 255, 32767, 65535, 1, 1, 1, 1, 1, 1}; /* by scalar_type */
    const double x =
        scalar_decode(a->type, false, a->at + row * a->stride + component * scalar_bytes(a->type));
    return a->normalized ? fmax(-1, x / scale[a->type]) : x;
}
