/* png_write.c: writes a picture as a PNG file with libpng */
#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"
#include "tools/io/output_file.h"

bool picture_write_png(const picture *p, const char *path, char *message, size_t message_size) {
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = (png_uint_32)p->width;
    image.height = (png_uint_32)p->height;
    image.format = PNG_FORMAT_RGB;
    FILE *file = output_open(path, message, message_size);
    if (file == NULL) {
        return false;
    }
    bool ok = p->at != NULL && png_image_write_to_stdio(&image, file, 0, p->at, 3 * p->width, NULL);
    if (!ok && message != NULL && message_size > 0) {
        (void)snprintf(message, message_size, "%s: could not be written completely: %s", path,
                       image.message[0] != '\0' ? image.message : "an empty picture");
    }
    png_image_free(&image);
    if (!ok) {
        output_discard(file);
        return false;
    }
    return output_close(file, message, message_size);
}
