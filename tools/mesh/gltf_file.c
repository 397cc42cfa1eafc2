/* gltf_file.c: a glTF 2 file in memory: its JSON document and its buffers */
#include "gltf_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An item of a document takes 64 bytes in memory and as few as 2 in the file. */
static const int64_t text_limit = (int64_t)1 << 28;

static const cJSON *member(const cJSON *object, const char *name) {
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

bool gltf_integer(const gltf_file *f, const cJSON *object, const char *name, int64_t limit,
                  const char *of, int64_t number, int64_t *k) {
    const cJSON *item = member(object, name);
    *k = -1;
    if (item == NULL) {
        return true;
    }
    const double x = cJSON_IsNumber(item) ? item->valuedouble : -1;
    if (!(x >= 0 && x < (double)limit && x == floor(x))) {
        return input_error(f->in, "%s %lld: %s is not an integer below %lld", of, (long long)number,
                           name, (long long)limit);
    }
    *k = (int64_t)x;
    return true;
}

bool gltf_numbers(const gltf_file *f, const cJSON *object, const char *name, int count,
                  const char *of, int64_t number, double *values) {
    const cJSON *array = member(object, name);
    if (array == NULL) {
        return true;
    }
    const cJSON *item = array->child;
    int k = 0;
    for (; k < count && cJSON_IsNumber(item) && isfinite(item->valuedouble); k++) {
        values[k] = item->valuedouble;
        item = item->next;
    }
    return (cJSON_IsArray(array) && k == count && item == NULL) ||
           input_error(f->in, "%s %lld: %s is not an array of %d numbers", of, (long long)number,
                       name, count);
}

bool gltf_list_open(const gltf_file *f, gltf_list *list, const cJSON *object, const char *name) {
    const cJSON *array = member(object, name);
    list->name = name;
    list->count = 0;
    list->item = NULL;
    if (array == NULL) {
        return true;
    }
    if (!cJSON_IsArray(array)) {
        return input_error(f->in, "%s is not an array", name);
    }
    for (const cJSON *item = array->child; item != NULL; item = item->next) {
        list->count++;
        if (!cJSON_IsObject(item)) {
            return input_error(f->in, "%s: an element is not an object", name);
        }
    }
    list->item = (const cJSON **)malloc(((size_t)list->count + 1) * sizeof *list->item);
    if (list->item == NULL) {
        return input_error(f->in, "out of memory");
    }
    size_t k = 0;
    for (const cJSON *item = array->child; item != NULL; item = item->next) {
        list->item[k++] = item;
    }
    return true;
}

static int64_t word_at(const char *bytes) {
    return (int64_t)scalar_decode(SCALAR_UINT32, false, bytes);
}

/* Finds the chunks of a container: a header of 12 bytes, then chunks with a length and a type: the
 * document, then perhaps one binary chunk. */
static bool read_container(gltf_file *f, const char **text, int64_t *length) {
    const int64_t document = 0x4E4F534A, binary = 0x004E4942; /* "JSON", "BIN" */
    const char *at = f->in->at;
    int64_t left = f->in->end - at;
    if (left < 20 || word_at(at + 4) != 2) {
        return input_error(f->in, left < 20 ? "truncated in the header"
                                            : "a container of a version other than 2");
    }
    if (word_at(at + 8) > left || word_at(at + 16) != document) {
        return input_error(f->in, "truncated: %lld bytes of %lld, or no document", (long long)left,
                           (long long)word_at(at + 8));
    }
    left = word_at(at + 8) - 12;
    at += 12;
    for (int k = 0; left >= 8; k++) {
        const int64_t bytes = word_at(at);
        if (bytes > left - 8) {
            return input_error(f->in, "chunk %d ends beyond the file", k);
        }
        if (k == 0) {
            *text = at + 8;
            *length = bytes;
        } else if (word_at(at + 4) == binary && f->chunk == NULL) {
            f->chunk = at + 8;
            f->chunk_length = bytes;
        }
        at += 8 + bytes;
        left -= 8 + bytes;
    }
    return true;
}

/* Extensions that store meshes in another way are refused; those of materials do not matter. */
static bool check_extensions(const gltf_file *f) {
    static const char *const harmless[] = {
        "KHR_materials_", "KHR_texture_",          "KHR_lights_",    "EXT_texture_",
        "MSFT_texture_",  "KHR_mesh_quantization", "KHR_animation_", "KHR_xmp"};
    const cJSON *list = member(f->root, "extensionsRequired");
    for (const cJSON *e = list != NULL ? list->child : NULL; e != NULL; e = e->next) {
        const char *name = cJSON_IsString(e) ? e->valuestring : "?";
        bool known = false;
        for (size_t k = 0; k < sizeof harmless / sizeof harmless[0]; k++) {
            known = known || strncmp(name, harmless[k], strlen(harmless[k])) == 0;
        }
        if (!known) {
            return input_error(f->in,
                               "the extension %.60s, which the file requires, is not "
                               "supported",
                               name);
        }
    }
    return true;
}

static bool read_document(gltf_file *f) {
    const char *text = f->in->at;
    int64_t length = f->in->end - f->in->at;
    if (length >= 4 && memcmp(text, "glTF", 4) == 0 && !read_container(f, &text, &length)) {
        return false;
    }
    if (length > text_limit) {
        return input_error(f->in, "more than %lld MB of text", (long long)(text_limit >> 20));
    }
    const char *stop = NULL;
    f->root = cJSON_ParseWithLengthOpts(text, (size_t)length, &stop, false);
    if (!cJSON_IsObject(f->root)) {
        return input_error(f->in, "not a JSON document: byte %lld is wrong, or out of memory",
                           (long long)(stop != NULL ? stop - f->in->data : 0));
    }
    const cJSON *version = member(member(f->root, "asset"), "version");
    if (!cJSON_IsString(version) || strncmp(version->valuestring, "2.", 2) != 0) {
        return input_error(f->in, "not glTF 2: asset.version is '%.20s'",
                           cJSON_IsString(version) ? version->valuestring : "");
    }
    return check_extensions(f);
}

bool gltf_open(gltf_file *f, input *in) {
    memset(f, 0, sizeof *f);
    f->in = in;
    in->line = 0;
    if (!read_document(f) || !gltf_list_open(f, &f->buffers, f->root, "buffers") ||
        !gltf_list_open(f, &f->views, f->root, "bufferViews") ||
        !gltf_list_open(f, &f->accessors, f->root, "accessors") ||
        !gltf_list_open(f, &f->meshes, f->root, "meshes") ||
        !gltf_list_open(f, &f->nodes, f->root, "nodes") ||
        !gltf_list_open(f, &f->scenes, f->root, "scenes")) {
        return false;
    }
    f->buffer = (gltf_buffer *)calloc((size_t)f->buffers.count + 1, sizeof *f->buffer);
    return f->buffer != NULL || input_error(in, "out of memory");
}

void gltf_close(gltf_file *f) {
    gltf_list *lists[6] = {&f->buffers, &f->views, &f->accessors,
                           &f->meshes,  &f->nodes, &f->scenes};
    for (int64_t k = 0; f->buffer != NULL && k < f->buffers.count; k++) {
        free(f->buffer[k].decoded);
        input_close(&f->buffer[k].file);
    }
    for (int k = 0; k < 6; k++) {
        free((void *)lists[k]->item);
    }
    while (f->made != NULL) {
        gltf_block *block = f->made;
        f->made = block->next;
        free(block->rows);
        free(block);
    }
    free(f->buffer);
    cJSON_Delete(f->root);
    memset(f, 0, sizeof *f);
}

static int digit_of(char c) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c != '\0' ? strchr(digits, c) : NULL;
    return at != NULL ? (int)(at - digits) : -1;
}

/* Decodes base64: four characters give three bytes. */
static bool decode_base64(gltf_file *f, gltf_buffer *buffer, const char *text) {
    size_t length = strlen(text), used = 0;
    unsigned bits = 0;
    int held = 0;
    buffer->decoded = (char *)malloc(length / 4 * 3 + 4);
    if (buffer->decoded == NULL) {
        return input_error(f->in, "out of memory");
    }
    for (; *text != '\0' && *text != '='; text++) {
        const int digit = digit_of(*text);
        if (digit < 0) {
            return input_error(f->in, "a data URI is not base64");
        }
        bits = (bits << 6 | (unsigned)digit) & 0xFFFFFFu;
        held += 6;
        if (held >= 8) {
            held -= 8;
            buffer->decoded[used++] = (char)(unsigned char)(bits >> held & 0xFFu);
        }
    }
    buffer->at = buffer->decoded;
    buffer->length = (int64_t)used;
    return true;
}

/* Decodes %20 and the like. Returns false if the result is not the name of a file in the folder of
 * the document or below it. */
static bool decode_name(char *name, size_t size, const char *uri) {
    size_t used = 0;
    for (; *uri != '\0' && used + 1 < size; uri++) {
        unsigned code = 0;
        char hex[3] = {0, 0, 0}, rest = 0;
        if (*uri == '%' && uri[1] != '\0' && uri[2] != '\0') {
            memcpy(hex, uri + 1, 2);
            if (sscanf(hex, "%2x%c", &code, &rest) != 1 || code == 0) {
                return false;
            }
            uri += 2;
        }
        name[used++] = code != 0 ? (char)(unsigned char)code : *uri;
    }
    name[used] = '\0';
    return *uri == '\0' && used > 0 && name[0] != '/' && strstr(name, "..") == NULL &&
           strchr(name, ':') == NULL && strchr(name, '\\') == NULL;
}

static bool load_file(gltf_file *f, gltf_buffer *buffer, const char *uri) {
    char path[4096], name[1024], message[300];
    const char *slash = strrchr(f->in->path, '/');
    const size_t folder = slash != NULL ? (size_t)(slash + 1 - f->in->path) : 0;
    if (!decode_name(name, sizeof name, uri) || folder + strlen(name) >= sizeof path) {
        return input_error(f->in, "the buffer '%.100s' is not a file in the same folder", uri);
    }
    memcpy(path, f->in->path, folder);
    memcpy(path + folder, name, strlen(name) + 1);
    if (!input_open(&buffer->file, path, message, sizeof message)) {
        return input_error(f->in, "buffer: %s", message);
    }
    buffer->at = buffer->file.data;
    buffer->length = buffer->file.end - buffer->file.data;
    return true;
}

bool gltf_load_buffer(gltf_file *f, int64_t number) {
    gltf_buffer *buffer = &f->buffer[number];
    const cJSON *object = f->buffers.item[number], *uri = member(object, "uri");
    int64_t declared = -1;
    bool ok = buffer->at != NULL;
    if (ok) {
        return true;
    }
    if (!gltf_integer(f, object, "byteLength", INT64_C(1) << 40, "buffer", number, &declared)) {
        return false;
    }
    if (uri == NULL && number == 0 && f->chunk != NULL) {
        buffer->at = f->chunk;
        buffer->length = f->chunk_length;
        ok = true;
    } else if (cJSON_IsString(uri) && strncmp(uri->valuestring, "data:", 5) == 0) {
        const char *comma = strstr(uri->valuestring, ";base64,");
        ok = comma != NULL
                 ? decode_base64(f, buffer, comma + 8)
                 : input_error(f->in, "buffer %lld: a data URI without base64", (long long)number);
    } else if (cJSON_IsString(uri)) {
        ok = load_file(f, buffer, uri->valuestring);
    } else {
        ok = input_error(f->in, "buffer %lld has no data", (long long)number);
    }
    f->loaded += buffer->length;
    if (ok && f->loaded > INT64_C(1) << 31) { /* as for any file (input.h) */
        return input_error(f->in, "the buffers have more than 2 GiB");
    }
    if (ok && buffer->length < declared) {
        return input_error(f->in, "buffer %lld: truncated, %lld bytes of %lld", (long long)number,
                           (long long)buffer->length, (long long)declared);
    }
    return ok;
}
