/* png_write.c: writes pictures as PNG files, through libpng */
#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture.h"

bool picture_write_png(const picture *p, const char *path, char *message, size_t message_size) {
    png_image image;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = (png_uint_32)p->width;
    image.height = (png_uint_32)p->height;
    image.format = PNG_FORMAT_RGB;
    bool ok = p->at != NULL && png_image_write_to_file(&image, path, 0, p->at, 3 * p->width, NULL);
    if (!ok && message != NULL && message_size > 0) {
        (void)snprintf(message, message_size, "%s: cannot be written: %s", path,
                       image.message[0] != '\0' ? image.message : "an empty picture");
    }
    png_image_free(&image);
    return ok;
}
